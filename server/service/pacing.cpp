#include "server/service/pacing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "protocol/base/clock.h"

namespace macula {

glm::ivec2 phase_of_frame(std::uint64_t index) {
    // 1 / g and 1 / g^2 of the plastic number g, the root of g^3 = g + 1.
    constexpr double kAlphaX = 0.7548776662466927;
    constexpr double kAlphaY = 0.5698402909980532;
    constexpr std::uint64_t kCycle = 64;
    constexpr double kTorus_px = 64.0;
    const auto k = static_cast<double>(index % kCycle);
    const auto cell = [k](double alpha) { return static_cast<int>((k * alpha - std::floor(k * alpha)) * kTorus_px); };
    return {cell(kAlphaX), cell(kAlphaY)};
}

PacingState::PacingState(double refresh_hz, int max_in_flight)
    : period_ns_(static_cast<std::int64_t>(1e9 / refresh_hz)), max_in_flight_(max_in_flight) {}

int PacingState::in_flight() const {
    return static_cast<int>(begun_ - reported_);
}

void PacingState::begin(std::int64_t now_ns) {
    ++begun_;
    // Keeps the cadence when a frame begins a little late, and starts a new one after a pause.
    const bool in_cadence = now_ns - next_begin_ns_ < period_ns_;
    next_begin_ns_ = (in_cadence ? next_begin_ns_ : now_ns) + period_ns_;
}

void PacingState::reported(std::uint64_t frame_id) {
    reported_ = std::max(reported_, std::min(frame_id, encoded_));
}

void PacingState::give_up_reports() {
    if (begun_ == encoded_) reported_ = encoded_;
}

bool Pacer::wait_for_room() {
    std::unique_lock lock(mutex_);
    while (!closed_) {
        const std::int64_t wait_ns = state_.next_begin_ns() - now_ns();
        if (!state_.has_room()) {
            if (changed_.wait_for(lock, kReportLimit) == std::cv_status::timeout) state_.give_up_reports();
        } else if (wait_ns > 0) {
            changed_.wait_for(lock, std::chrono::nanoseconds(wait_ns));
        } else {
            return true;
        }
    }
    return false;
}

void Pacer::close() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    changed_.notify_all();
}

}  // namespace macula
