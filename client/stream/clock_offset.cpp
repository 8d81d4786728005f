#include "client/stream/clock_offset.h"

#include <algorithm>
#include <span>

namespace macula {

void ClockFilter::add(const Pong& pong, std::int64_t arrived_ns) {
    if (arrived_ns < pong.ping_sent_ns) return;
    const std::int64_t round_trip_ns = arrived_ns - pong.ping_sent_ns;
    const std::int64_t middle_ns = pong.ping_sent_ns + round_trip_ns / 2;
    exchanges_[count_++ % kExchanges] = {pong.answered_ns - middle_ns, round_trip_ns};
}

std::optional<ClockOffset> ClockFilter::best() const {
    if (count_ == 0) return std::nullopt;
    const std::span<const ClockOffset> kept(exchanges_.data(), std::min(count_, kExchanges));
    return *std::ranges::min_element(kept, {}, &ClockOffset::round_trip_ns);
}

}  // namespace macula
