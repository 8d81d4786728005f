#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "client/stream/client_session.h"

namespace macula {

/// The stages of a frame's way, in order: what --stats and the summary report.
enum class Stage : int {
    uplink,  ///< Track read from the devices -> received by the server (needs the clock offset)
    wait,    ///< Track received -> frame begun
    plan,
    trace,
    reconstruct,
    encode,    ///< includes any wait for the encoder
    send,      ///< encoded -> handed to the network
    downlink,  ///< handed to the network -> received (needs the clock offset)
    decode,
    hold,           ///< decoded -> taken by the presenter
    accumulate,     ///< temporal anti-aliasing
    reproject,      ///< late reprojection
    display,        ///< writing to the displays
    gaze_to_frame,  ///< gaze measured -> frame displayed: the whole way
};
inline constexpr std::size_t kStageCount = 14;
inline constexpr std::array<const char*, kStageCount> kStageNames = {
    "uplink",   "wait",   "plan", "trace",      "reconstruct", "encode",  "send",
    "downlink", "decode", "hold", "accumulate", "reproject",   "display", "gaze_to_frame"};

/// Times of a frame in the presenter, client clock.
struct PresentTimes {
    std::int64_t taken_ns = 0;
    std::int64_t accumulated_ns = 0;
    std::int64_t reprojected_ns = 0;
    std::int64_t displayed_ns = 0;
    std::int64_t written_ns = 0;  ///< the displays are done
};

/// Collects what happened to every frame shown. One thread at a time.
class Report {
public:
    /// `frame_pixels`: pixels of both eyes. With a path, each frame becomes a row of that CSV file.
    /// Errors: `output`.
    static Expected<Report> open(const std::string& stats_path, std::uint64_t frame_pixels);

    void add(const ReceivedFrame& frame, const PresentTimes& times, const std::optional<ClockOffset>& clock,
             const ClientSessionCounters& counters);

    /// The end of the session for a person.
    [[nodiscard]] std::string summary(const ClientSessionCounters& counters) const;

    /// The same as lines of name=value, for scripts.
    [[nodiscard]] std::string summary_values(const ClientSessionCounters& counters) const;

    /// Errors: `output` if any row did not reach the file.
    Expected<void> close();

    [[nodiscard]] std::uint64_t frames() const { return frames_; }
    /// Smoothed time from a head pose to the picture made from it; what Track::display_time_ns adds.
    [[nodiscard]] std::int64_t pipeline_ns() const { return pipeline_ns_; }

private:
    explicit Report(std::uint64_t frame_pixels) : frame_pixels_(frame_pixels) {}

    [[nodiscard]] double seconds() const;
    [[nodiscard]] double frames_per_second() const;
    [[nodiscard]] double megabits_per_second() const;
    [[nodiscard]] double traced_share() const;
    /// Of the frames that have the stage; 0 without any. `quantile` in 0..1, result in milliseconds.
    [[nodiscard]] double stage_ms(std::size_t stage, double quantile) const;

    std::string path_;
    std::ofstream file_;
    std::uint64_t frame_pixels_;
    std::uint64_t frames_ = 0;
    std::uint64_t traced_ = 0;
    std::uint64_t bytes_ = 0;
    std::int64_t first_ns_ = 0;
    std::int64_t last_ns_ = 0;
    std::int64_t pipeline_ns_ = 50'000'000;
    std::array<std::vector<float>, kStageCount> stages_ms_;
};

}  // namespace macula
