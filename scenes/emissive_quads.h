#pragma once

#include <cstddef>
#include <optional>

#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Most rectangles that emissive quads become: each costs its shadow rays at every sample that it reaches.
inline constexpr std::size_t kMostEmissiveRectangles = 8;

/// A mesh of two triangles that make a parallelogram; mesh space.
struct MeshQuad {
    glm::vec3 center = glm::vec3(0.0F);
    glm::vec3 half_u = glm::vec3(0.0F);  ///< from the centre to the middle of an edge
    glm::vec3 half_v = glm::vec3(0.0F);  ///< and of the next; the front is along cross(half_u, half_v)
};

/// The parallelogram that a mesh is; nothing if it is something else.
std::optional<MeshQuad> mesh_quad(const Mesh& mesh);

/// Lets emissive quads light the scene: an instance of such a mesh whose material is opaque and emits becomes a
/// rectangle, its radiance the emission, of a texture the mean over the quad. Double-sided ones become two, one for
/// each side. Those of the greatest power are taken, kMostEmissiveRectangles in all; not those with less than a
/// hundredth of the greatest, nor those that bring less than 0.01 to a surface at a quarter of the scene's radius (pi
/// is the irradiance that makes a white surface display white). The others glow and light nothing. The rectangles come
/// after the scene's own lights and name their instance and its node.
void add_emissive_quads(Scene& scene);

}  // namespace macula
