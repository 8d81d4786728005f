#pragma once

#include <cstdint>
#include <string>

#include "masks/sample_plan.h"
#include "protocol/base/error.h"

namespace macula {

/// How pixels between samples are filled.
enum class Reconstruction : std::uint8_t {
    tiles,      ///< precomputed triangles of each tile level
    table,      ///< precomputed barycentric weights of each pixel of a mesh
    raster,     ///< the mesh's triangles, rasterised (the paper)
    push_pull,  ///< pyramid of weighted averages (Gortler et al. 1996)
    cells,      ///< nearest sample
    nearest,    ///< the k nearest samples, weighted by distance (Fujita and Harada 2014)
    bilinear,   ///< between the samples of a grid plan
};

/// Parses "tiles", "table", "raster", "push-pull", "cells", "nearest", "bilinear". Errors: `option`.
Expected<Reconstruction> parse_reconstruction(const std::string& text);
/// The text that is parsed to it.
std::string to_string(Reconstruction reconstruction);

/// Whether a plan has what a reconstruction reads. Errors: `option`, saying what it lacks and what would fit.
Expected<void> check_fits(Reconstruction reconstruction, const SamplePlan& plan);

}  // namespace macula
