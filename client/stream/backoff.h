#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>

namespace macula {

/// How long to wait before the next attempt: doubling from `first` to `most`, each wait drawn between half of
/// that and all of it, so that clients that lost one server do not come back in step.
class Backoff {
public:
    Backoff(std::chrono::milliseconds first, std::chrono::milliseconds most, std::uint32_t seed)
        : first_(first), most_(most), step_(first), random_(seed) {}

    std::chrono::milliseconds next() {
        const auto half = step_.count() / 2;
        const auto wait = std::chrono::milliseconds(half + static_cast<std::int64_t>(random_()) % (half + 1));
        step_ = std::min(2 * step_, most_);
        return wait;
    }

    /// After a success.
    void reset() { step_ = first_; }

private:
    std::chrono::milliseconds first_;
    std::chrono::milliseconds most_;
    std::chrono::milliseconds step_;
    std::mt19937 random_;
};

}  // namespace macula
