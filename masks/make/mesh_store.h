#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "masks/make/mask.h"
#include "masks/make/recipe.h"
#include "masks/mesh/sample_mesh.h"
#include "protocol/base/error.h"

namespace macula {

/// The mask's sites and those that close its border (close_border()), ordered so that neighbours in the list are
/// neighbours in the plane (Morton order of 16x16 blocks, rows inside), triangulated.
SampleMesh triangulate_mask(const Mask& mask, const MaskProgress& progress = {});

/// $XDG_CACHE_HOME/macula/meshes or ~/.cache/macula/meshes. Errors: `option` where neither variable is set.
Expected<std::filesystem::path> default_mesh_cache();

/// Makes the mesh of a recipe, or reads it from the cache, where it lies under the recipe's hash; a file whose recipe
/// is another, or that is damaged, is made anew. A cache that cannot be written costs only the time.
/// Errors: those of make_mask(). From several threads and processes at once.
Expected<SampleMesh> obtain_mesh(const Recipe& recipe, const std::filesystem::path& cache,
                                 const MaskProgress& progress = {});

}  // namespace macula
