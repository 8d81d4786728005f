#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/message/message.h"

namespace macula {

/// How far the server's clock is ahead of ours, from Pings and their Pongs.
struct ClockOffset {
    std::int64_t offset_ns = 0;      ///< server time minus client time
    std::int64_t round_trip_ns = 0;  ///< of the exchange it comes from; the offset is wrong by at most half of it
};

/// NTP's formula (RFC 5905, section 8) with the server's two times as one, and its clock filter: of the last
/// exchanges the one with the shortest round trip is believed, because queues only ever add to it. One thread at
/// a time.
class ClockFilter {
public:
    static constexpr std::size_t kExchanges = 16;

    /// A Pong that came at `arrived_ns`, client clock. One that would have gone back in time is ignored.
    void add(const Pong& pong, std::int64_t arrived_ns);

    /// Nothing before the first exchange.
    [[nodiscard]] std::optional<ClockOffset> best() const;

private:
    std::array<ClockOffset, kExchanges> exchanges_{};
    std::size_t count_ = 0;
};

}  // namespace macula
