#include "server/service/prediction.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace macula {

namespace {

/// Rotation by `rotation_rad`: unit axis times angle.
glm::quat exponential(const glm::vec3& rotation_rad) {
    const float angle_rad = glm::length(rotation_rad);
    // Below this the axis is noise, and sin(angle / 2) / angle is 1/2 to the last bit.
    const float sine_over_angle = angle_rad > 1e-4F ? std::sin(0.5F * angle_rad) / angle_rad : 0.5F;
    const glm::vec3 xyz = sine_over_angle * rotation_rad;
    return glm::normalize(glm::quat(std::cos(0.5F * angle_rad), xyz.x, xyz.y, xyz.z));
}

}  // namespace

Pose predict_head(const Track& track) {
    // The difference of two times from the network may overflow; the comparison comes first.
    std::int64_t ahead_ns = 0;
    if (track.display_time_ns > track.pose_time_ns) {
        const auto difference_ns =
            static_cast<std::uint64_t>(track.display_time_ns) - static_cast<std::uint64_t>(track.pose_time_ns);
        ahead_ns = static_cast<std::int64_t>(std::min(difference_ns, static_cast<std::uint64_t>(kMaxPrediction_ns)));
    }
    const float ahead_s = static_cast<float>(ahead_ns) * 1e-9F;
    return {glm::normalize(exponential(track.angular_velocity_rad_s * ahead_s) * track.start_from_head.orientation),
            track.start_from_head.position_m + track.linear_velocity_m_s * ahead_s};
}

PerEye<EyeView> eye_views(const Display& display, const Pose& world_from_head) {
    PerEye<EyeView> views;
    for (int eye = 0; eye < kEyeCount; ++eye) {
        const EyeDisplay& geometry = display.eyes[static_cast<std::size_t>(eye)];
        views[static_cast<std::size_t>(eye)] = {world_from_head * geometry.head_from_eye, geometry.tangents,
                                                display.eye_width_px, display.eye_height_px};
    }
    return views;
}

glm::vec3 GazeHold::update(const GazeSample& sample, std::int64_t time_ns) {
    if (sample.confidence >= kLostBelow) {
        last_good_ = sample.direction;
        last_good_ns_ = time_ns;
    } else if (time_ns < last_good_ns_) {
        last_good_ns_ = time_ns;  // the clock was set back: how long the eye has been lost is counted anew
    } else if (static_cast<std::uint64_t>(time_ns) - static_cast<std::uint64_t>(last_good_ns_) >
               static_cast<std::uint64_t>(kMaxHold_ns)) {
        last_good_ = glm::vec3(0.0F, 0.0F, -1.0F);
    }
    return last_good_;
}

}  // namespace macula
