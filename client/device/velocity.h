#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "client/device/source.h"

namespace macula {

/// Velocities of the head in start space.
struct HeadVelocity {
    glm::vec3 linear_m_s = glm::vec3(0.0F);
    glm::vec3 angular_rad_s = glm::vec3(0.0F);  ///< axis times rate
};

/// Estimates the head's velocities from the past only: the change over the last kWindow_ns, so the estimate is
/// that of half a window ago. Starts anew at a discontinuity.
class VelocityEstimator {
public:
    static constexpr std::int64_t kWindow_ns = 20'000'000;

    HeadVelocity update(const DeviceSample& sample);

private:
    struct Entry {
        std::int64_t time_ns;
        Pose start_from_head;
    };
    std::deque<Entry> window_;
};

}  // namespace macula
