#pragma once

#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Axis-aligned box, world space, metres; empty until a point is added.
struct Bounds {
    glm::vec3 low = glm::vec3(std::numeric_limits<float>::infinity());
    glm::vec3 high = glm::vec3(-std::numeric_limits<float>::infinity());

    void add(const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    [[nodiscard]] glm::vec3 middle() const { return 0.5F * (low + high); }
    [[nodiscard]] glm::vec3 size() const { return high - low; }
    [[nodiscard]] float radius() const { return 0.5F * glm::length(size()); }
};

/// Box around all instances, where they are at time 0. Exact, but where there are more than 2^26 placed vertices it is
/// made of the meshes' boxes.
Bounds world_bounds(const Scene& scene);

/// The pose with the head level: place and yaw stay, pitch and roll go. A session turns its viewer's head within the
/// start pose, and a horizon that does not agree with one's sense of balance makes one sick. Where the head looks
/// straight up or down, the way its top or chin points is taken for its yaw.
Pose level_head(const Pose& world_from_head);

/// Sets the start pose and the near depth. The head is level.
/// Camera: where the scene has one, the session starts at the first, levelled.
/// Room: otherwise it looks along -Z; if the box is at least 2 m in each direction and the point 1.6 m above the middle
/// of its floor is enclosed (of 26 directions at least 20 meet the front of a surface first), it starts at that point.
/// Object: otherwise it starts in front of it, on +Z at the height of its middle, where its bounding sphere fits into
/// 80 degrees. The near depth is a twentieth of the distance to the middle, in a room or at a camera of at least the
/// bounding sphere's radius, between 1 mm and 0.1 m.
void frame_start(Scene& scene, const Bounds& bounds);

}  // namespace macula
