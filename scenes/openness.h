#pragma once

#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// How openness is found and what it does.
struct OpennessOptions {
    float cell_m = 0.2F;    ///< of the grid that surfaces are counted in
    float reach_m = 2.4F;   ///< surfaces further away do not count
    float darkest = 0.38F;  ///< factor where a vertex sees nothing but near surfaces
    int directions = 9;
    glm::vec3 low = glm::vec3(-1.0F);  ///< box of the grid, world space; vertices outside are left as they are
    glm::vec3 high = glm::vec3(1.0F);
};

/// Multiplies the vertex colours of meshes by how open space is around each vertex, which gives objects their contact
/// with the floor and depth to their corners where light from all around is unshadowed; it also stands for the dirt
/// that gathers there. Surface area is counted in a grid and attenuates rays like fog (as in Crassin et al. 2011,
/// "Interactive indirect illumination using voxel cone tracing"), so that bars and wires count by how much they cover.
/// A mesh with several instances gets the mean of the first two of them. Meshes whose material blends, transmits, is
/// unlit or shines neither darken nor count. Deterministic; works on all cores.
void darken_corners(Scene& scene, const OpennessOptions& options);

}  // namespace macula
