#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/sample_plan.h"

namespace macula {

/// A sampling mask as the published system has it: sites drawn once around the point that is looked at, and their
/// Delaunay triangulation. Larger than the window, over which it is moved with the gaze. A value; built by
/// triangulate() (masks/mesh/triangulate.h) or read from a file (masks/mesh/mesh_file.h).
struct SampleMesh {
    /// Indices of three sites, counter-clockwise as seen with y down: cross(b - a, c - a) < 0.
    using Triangle = std::array<std::uint32_t, 3>;

    int width_px = 0;  ///< of the mask
    int height_px = 0;
    glm::ivec2 gaze_px = glm::ivec2(0);  ///< pixel of the mask that lies at the gaze
    std::vector<SamplePosition> site;    ///< pixels of the mask, each once
    std::vector<Triangle> triangle;      ///< cover the whole mask: its four corner pixels are sites
    std::string recipe;                  ///< JSON: how it was made (masks/make/recipe.h); empty: unknown
};

/// What is wrong with a mesh, in words that follow its name; empty if nothing is. Right is: sides of 2 to 16384 pixels
/// with the gaze in them; sites distinct pixels of the mask, each a corner; triangles with corners that exist, in
/// Triangle's orientation, that cover the rectangle between the centres of the mask's corner pixels exactly once. That
/// they are Delaunay is not checked: nothing breaks where they are not.
std::string mesh_defect(const SampleMesh& mesh);

}  // namespace macula
