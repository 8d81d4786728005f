#pragma once

#include <functional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Procedural meshes in metres: outward unit normals, counter-clockwise front faces, uv0 over [0, 1] (textures are
/// scaled by TextureUse, not here), material 0. Round shapes stand on y = 0 around the y axis unless said otherwise.

/// Point of a profile that is turned around the y axis, from bottom to top on the outside. A sharp edge is two points
/// at one place with different normals.
struct ProfilePoint {
    float radius_m = 0.0F;
    float height_m = 0.0F;
    glm::vec2 normal = glm::vec2(1.0F, 0.0F);  ///< (outward, up), unit
};

/// Parallelogram with image corner (0, 0) at `top_left`; the front is the side from which `right` and `down` look so.
Mesh make_quad(const glm::vec3& top_left, const glm::vec3& right, const glm::vec3& down);

/// Axis-aligned box that stands on y = 0, each face with its own uv0 over [0, 1].
Mesh make_box(const glm::vec3& size_m);

/// Surface of revolution; u goes around, v from the top (0) to the bottom (1) by arc length.
Mesh make_lathe(std::span<const ProfilePoint> profile, int segments);

/// Centred at the origin.
Mesh make_sphere(float radius_m, int segments = 96);

/// Cylinder, or frustum of a cone when the radii differ, closed at both ends.
Mesh make_cylinder(float bottom_radius_m, float top_radius_m, float height_m, int segments = 64);

/// Round tube along a closed curve around the origin, given over [0, 1) and differentiable; u goes along the curve.
Mesh make_tube(const std::function<glm::vec3(float)>& curve, float radius_m, int segments, int sides);

/// Torus around the y axis, centred at the origin.
Mesh make_torus(float ring_radius_m, float tube_radius_m);

/// (p, q) torus knot around the y axis, centred at the origin.
Mesh make_torus_knot(int p, int q, float ring_radius_m, float tube_radius_m);

}  // namespace macula
