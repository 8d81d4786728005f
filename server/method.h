#pragma once

#include <string>

#include "masks/law.h"
#include "protocol/base/error.h"
#include "server/render/reconstruction.h"

namespace macula {

/// Ways to choose the pixels that get a ray.
enum class SamplerKind : std::uint8_t {
    tiles,      ///< a prefix of a blue-noise rank tile in each screen tile
    mesh,       ///< a triangulated mask that is moved with the gaze (the paper)
    uniform,    ///< a coarser grid over the whole window, wherever the eye looks
    layers,     ///< three nested grids (Guenter et al. 2012)
    log_polar,  ///< circles around the gaze (Meng et al. 2018)
};

/// How frames are made: which pixels get a ray, and how the others are filled. One text names it, so that a client can
/// ask for it, a chart can list it, and anybody can run it again:
///
///     [SAMPLER:]PRESET[/RECONSTRUCTION]        27    mesh:paper-27    mesh-16:27/raster    layers:27    tiles:54/cells
///
/// SAMPLER is tiles (if it is left out), mesh, mesh-N (moved in steps of N pixels), uniform, layers or log-polar;
/// PRESET is what parse_sampling() reads, or for meshes `file`: the one that the server was started with.
/// RECONSTRUCTION is the sampler's own if it is left out: tiles, table for meshes, bilinear for the others.
struct Method {
    SamplerKind sampler = SamplerKind::tiles;
    int mesh_step_px = 1;
    bool mesh_file = false;  ///< PRESET is `file`; `preset` does not count
    SamplingPreset preset;
    Reconstruction reconstruction = Reconstruction::tiles;
    std::string name;  ///< with everything that was left out
};

/// Errors: `option`, for an unknown part and for parts that do not go together, saying why and what does.
Expected<Method> parse_method(const std::string& text);

}  // namespace macula
