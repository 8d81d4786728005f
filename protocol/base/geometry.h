#pragma once

#include <array>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace macula {

/// Rigid transform: rotation before translation. A value named `world_from_head` takes points of head
/// space to world space. Right-handed, +X right, +Y up, -Z forward, metres (CONVENTIONS.md).
struct Pose {
    glm::quat orientation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);  ///< unit quaternion, (w, x, y, z) constructor
    glm::vec3 position_m = glm::vec3(0.0F);

    /// `a_from_b * b_from_c` is `a_from_c`.
    [[nodiscard]] Pose operator*(const Pose& b_from_c) const {
        return {orientation * b_from_c.orientation, orientation * b_from_c.position_m + position_m};
    }
    /// Takes a point to the destination space.
    [[nodiscard]] glm::vec3 point(const glm::vec3& p) const { return orientation * p + position_m; }
    /// Takes a direction to the destination space.
    [[nodiscard]] glm::vec3 direction(const glm::vec3& d) const { return orientation * d; }
    /// `b_from_a` of an `a_from_b`.
    [[nodiscard]] Pose inverse() const {
        const glm::quat q = glm::conjugate(orientation);
        return {q, -(q * position_m)};
    }
};

/// Edges of a planar frustum at unit distance, signed: left and bottom are negative for a usual eye.
struct Tangents {
    float left = -1.0F;
    float right = 1.0F;
    float bottom = -1.0F;
    float top = 1.0F;
};

/// What one eye's image is a picture of. Row 0 is the top row; pixel centres lie at +0.5.
struct EyeView {
    Pose world_from_eye;
    Tangents tangents;
    int width_px = 0;
    int height_px = 0;
};

/// Index of an eye in every per-eye array.
enum Eye : int { kLeftEye = 0, kRightEye = 1, kEyeCount = 2 };

template <class T>
using PerEye = std::array<T, kEyeCount>;

}  // namespace macula
