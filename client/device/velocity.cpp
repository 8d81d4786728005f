#include "client/device/velocity.h"

#include <cmath>

namespace macula {
namespace {

/// Axis times angle of a rotation, the short way round.
glm::vec3 rotation_vector(glm::quat q) {
    if (q.w < 0.0F) q = -q;
    const glm::vec3 v(q.x, q.y, q.z);
    const float sine = glm::length(v);
    if (sine < 1e-9F) return 2.0F * v;
    return v * (2.0F * std::atan2(sine, q.w) / sine);
}

}  // namespace

HeadVelocity VelocityEstimator::update(const DeviceSample& sample) {
    if (sample.discontinuity || (!window_.empty() && sample.time_ns <= window_.back().time_ns)) window_.clear();
    window_.push_back({sample.time_ns, sample.start_from_head});
    // The oldest entry is the newest one that is at least a window old.
    while (window_.size() > 2 && sample.time_ns - window_[1].time_ns >= kWindow_ns) window_.pop_front();
    const Entry& oldest = window_.front();
    const Entry& newest = window_.back();
    if (oldest.time_ns == newest.time_ns) return {};
    const float seconds = static_cast<float>(newest.time_ns - oldest.time_ns) * 1e-9F;
    const glm::quat change = newest.start_from_head.orientation * glm::conjugate(oldest.start_from_head.orientation);
    return {(newest.start_from_head.position_m - oldest.start_from_head.position_m) / seconds,
            rotation_vector(change) / seconds};
}

}  // namespace macula
