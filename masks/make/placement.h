#pragma once

#include <cstdint>
#include <vector>

#include "masks/make/density.h"
#include "masks/make/recipe.h"

namespace macula {

/// One byte for each pixel of a density map, row-major: 1 where it is sampled.
using Sites = std::vector<std::uint8_t>;

// Ways to place sites so that their density is the wished one. Where that is 1 all pixels are sites. The same seed
// gives the same sites.

/// Those whose rank in the tiled blue-noise tile (masks/rank_tile.h) lies below the density. The seed shifts the tile.
Sites place_by_rank(const DensityMap& density, std::uint32_t seed);

/// Error diffusion (Floyd and Steinberg 1976), serpentine, with a threshold that trembles (Ulichney 1987) by the seed.
Sites place_floyd_steinberg(const DensityMap& density, std::uint32_t seed);

/// Pixels in random order, each taken unless it lies within the radius of one that was taken before; the radius is that
/// which gives the density. Where more than half of the pixels are sites, those left out are placed so instead.
Sites place_poisson_disk(const DensityMap& density, std::uint32_t seed);

/// Each pixel with the density as its probability.
Sites place_white_noise(const DensityMap& density, std::uint32_t seed);

/// Lattices of density 1, 1/2, 1/4, ... 1/64, each a subset of the one before, square and diagonal by turns; the one
/// whose density is the nearest in log. The seed shifts them.
Sites place_quincunx(const DensityMap& density, std::uint32_t seed);

/// The placement of that name.
Sites place(Placement placement, const DensityMap& density, std::uint32_t seed);

/// Density of the sites that a placement gives where `density` is wished: the same but for the steps of the rank tile,
/// 1/256, and those of the lattices.
double placed_density(Placement placement, double density);

}  // namespace macula
