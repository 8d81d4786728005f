#pragma once

#include <chrono>
#include <cstdint>

namespace macula {

/// Nanoseconds of this machine's monotonic clock. Times of two machines are compared only through the
/// offset that Ping and Pong measure.
inline std::int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace macula
