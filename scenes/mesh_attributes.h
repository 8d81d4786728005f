#pragma once

#include <cstddef>

#include "scenes/scene.h"

namespace macula {

/// Unit normals from the triangles around each vertex, weighted by the triangle's angle there (Thuermer and
/// Wuethrich 1998): independent of how flat faces are cut into triangles. Vertices without triangles get +Y.
void add_smooth_normals(Mesh& mesh);

/// Gives each triangle its own three vertices and its geometric normal, as glTF prescribes for missing normals.
void add_flat_normals(Mesh& mesh);

/// Tangents along +u of the given coordinates (one per vertex): the sum over the vertex's triangles, made orthogonal
/// to the normal; w is the side of the bitangent, so that bitangent = w * cross(normal, tangent). glTF names
/// MikkTSpace, which differs from this where mirrored charts share vertices and in the weighting. Where the coordinates
/// are degenerate any unit tangent is taken.
void add_tangents(Mesh& mesh, const std::vector<glm::vec2>& uv);

/// Removes triangles with two equal corners or no area. Returns how many there were.
std::size_t drop_degenerate_triangles(Mesh& mesh);

}  // namespace macula
