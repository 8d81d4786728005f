#pragma once

#include <limits>

#include <glm/vec3.hpp>

#include "server/render/embree_calls.h"
#include "server/render/lanes.h"

namespace macula {

inline constexpr float kUnlimited = std::numeric_limits<float>::infinity();

/// Embree's way to say which lanes take part.
inline Lanes<int> valid_lanes(LaneMask lanes) {
    Lanes<int> valid;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) valid[i] = -static_cast<int>((lanes >> i) & 1U);
    return valid;
}

/// Writes one lane's ray, which ends at `far` lengths of its direction.
inline void set_ray(RTCRay16& rays, int lane, const glm::vec3& origin, const glm::vec3& direction, float far) {
    rays.org_x[lane] = origin.x;
    rays.org_y[lane] = origin.y;
    rays.org_z[lane] = origin.z;
    rays.dir_x[lane] = direction.x;
    rays.dir_y[lane] = direction.y;
    rays.dir_z[lane] = direction.z;
    rays.tnear[lane] = 0.0F;
    rays.tfar[lane] = far;
    rays.time[lane] = 0.0F;
    rays.mask[lane] = 0xFFFFFFFFU;
    rays.flags[lane] = 0;
}

/// Writes one lane of a packet that looks for the nearest hit.
inline void set_ray(RTCRayHit16& rays, int lane, const glm::vec3& origin, const glm::vec3& direction) {
    set_ray(rays.ray, lane, origin, direction, kUnlimited);
    rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
}

}  // namespace macula
