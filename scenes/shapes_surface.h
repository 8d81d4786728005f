#pragma once

#include <functional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Curved procedural meshes in metres; like scenes/shapes.h, but texture coordinates are what is said here.

/// Surface through `at(u, v)` over [0, 1]^2 with columns x rows cells; the front is the side from which u runs to the
/// right and v runs up. Smooth normals from the differences of the grid; `closed_u` says that u = 0 and 1 meet. uv0 is
/// (u, 1 - v). Cells without area, as around a pole, are left out.
Mesh make_surface(int columns, int rows, bool closed_u, const std::function<glm::vec3(float u, float v)>& at);

/// Surface of revolution about +Y through points (radius, height) from bottom to top on the outside. Neighbouring
/// pieces that meet at less than 35 degrees are smooth, the others have an edge. u goes around, v down by arc length.
Mesh make_turned(std::span<const glm::vec2> profile, int segments);

/// The same, for points that are written where they are used.
inline Mesh make_turned(std::initializer_list<glm::vec2> profile, int segments) {
    return make_turned(std::span(profile.begin(), profile.size()), segments);
}

/// Round pipe along a polyline, with mitred corners and, unless its ends meet, closed ends. u goes along in metres,
/// v around once. Adjacent points differ; at least two, of a closed path three.
Mesh make_pipe(std::span<const glm::vec3> path, float radius_m, int sides, bool closed = false);

inline Mesh make_pipe(std::initializer_list<glm::vec3> path, float radius_m, int sides, bool closed = false) {
    return make_pipe(std::span(path.begin(), path.size()), radius_m, sides, closed);
}

/// Path whose corners are arcs of up to `radius_m`, `steps` pieces each.
std::vector<glm::vec3> round_corners(std::span<const glm::vec3> path, float radius_m, int steps);

inline std::vector<glm::vec3> round_corners(std::initializer_list<glm::vec3> path, float radius_m, int steps) {
    return round_corners(std::span(path.begin(), path.size()), radius_m, steps);
}

/// Wire that hangs between two points `sag_m` below their line, as a parabola.
std::vector<glm::vec3> hanging_path(const glm::vec3& from, const glm::vec3& to, float sag_m, int pieces);

/// Closed mesh between the closed outlines `lower` and `upper`, convex, in the same order, counter-clockwise seen from
/// the end of `upper`: flat sides and ends. uv0 is in metres: around and along on the sides.
Mesh make_prism(std::span<const glm::vec3> lower, std::span<const glm::vec3> upper);

}  // namespace macula
