#pragma once

#include <cstdint>

#include "protocol/message/message.h"

namespace macula {

/// Turns the display times of a client's Tracks into time of the scene: seconds on the server's clock since the server
/// started. All sessions of a server thus see the same moment of its animation, but for the one-way delays of their
/// connections, by which they see a later one.
///
/// The offset of the clocks is taken from the Tracks themselves: the least of (received - pose time) over the last 5 to
/// 10 s, since delays only ever add (RFC 5905). So scene time follows the client's display times exactly, without the
/// network's jitter, and what moves lies where the client's reprojection expects it. When the client's clock is set, in
/// either direction, scene time goes on. One thread at a time.
class SceneClock {
public:
    static constexpr std::int64_t kWindow_ns = 5'000'000'000;
    /// A display time that lies farther from the arrival of its Track than this is not believed.
    static constexpr std::int64_t kMaxAhead_ns = 1'000'000'000;

    /// `start_ns` is the scene's second 0 on this machine's clock.
    explicit SceneClock(std::int64_t start_ns) : start_ns_(start_ns) {}

    /// Scene time at which a frame made from this Track is shown. `received_ns` is this machine's time, not decreasing.
    double display_time_s(const Track& track, std::int64_t received_ns);

private:
    std::int64_t start_ns_;
    std::int64_t window_begin_ns_ = 0;
    std::int64_t offset_ns_ = 0;         ///< least of the present window
    std::int64_t offset_before_ns_ = 0;  ///< and of the one before
    std::int64_t pose_before_ns_ = 0;    ///< of the last Track
    bool started_ = false;
};

}  // namespace macula
