#pragma once

#include <memory>

#include "masks/display.h"
#include "masks/sample_plan.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/base/error.h"
#include "server/mesh_shelf.h"
#include "server/method.h"

namespace macula {

/// The sampler of a method for one eye of a display. Tables and shelf are shared; may be called from several threads.
/// `tiles` counts where the method samples by tiles.
/// Errors: `option` for what the display or the options cannot give; those of MeshShelf.
Expected<std::unique_ptr<Sampler>> make_sampler(const Method& method, const Display& display, Eye eye,
                                                const std::shared_ptr<const TileTables>& tables, MeshShelf& meshes,
                                                const TileSamplerOptions& tiles = {});

}  // namespace macula
