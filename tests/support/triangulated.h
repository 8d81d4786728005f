#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "masks/mesh/sample_mesh.h"
#include "masks/mesh/triangulate.h"

namespace macula::testing {

/// The mesh of sites of a mask that looks at its middle.
inline SampleMesh triangulated(int width_px, int height_px, std::vector<SamplePosition> site, std::string recipe = {}) {
    SampleMesh mesh;
    mesh.width_px = width_px;
    mesh.height_px = height_px;
    mesh.gaze_px = {width_px / 2, height_px / 2};
    mesh.triangle = triangulate(site);
    mesh.site = std::move(site);
    mesh.recipe = std::move(recipe);
    return mesh;
}

/// The mask's corners, and each other pixel with the probability `density`.
inline std::vector<SamplePosition> scattered_sites(int width_px, int height_px, double density, std::mt19937& random) {
    std::bernoulli_distribution taken(density);
    std::vector<SamplePosition> site;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const bool corner = (x == 0 || x == width_px - 1) && (y == 0 || y == height_px - 1);
            if (corner || taken(random)) site.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
        }
    }
    return site;
}

}  // namespace macula::testing
