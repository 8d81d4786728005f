#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "masks/mesh/mesh_table.h"
#include "masks/mesh/sample_mesh.h"
#include "masks/mesh/triangulate.h"

namespace macula::test {

/// The Delaunay mesh of the pixels for which `sampled(x, y)` holds, and of every `border_px`-th pixel of the mask's
/// edge, corners included, without which triangles along the edge would be long.
template <class Sampled>
SampleMesh make_mesh(int width_px, int height_px, glm::ivec2 gaze_px, Sampled&& sampled, int border_px = 8) {
    SampleMesh mesh;
    mesh.width_px = width_px;
    mesh.height_px = height_px;
    mesh.gaze_px = gaze_px;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const bool x_end = x == 0 || x == width_px - 1;
            const bool y_end = y == 0 || y == height_px - 1;
            const bool border = (x_end && (y_end || y % border_px == 0)) || (y_end && x % border_px == 0);
            if (border || sampled(x, y))
                mesh.site.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
        }
    }
    mesh.triangle = triangulate(mesh.site);
    return mesh;
}

/// A mask that is full around its gaze and falls off to `least` of the pixels: density (core / distance)^2.
inline SampleMesh foveal_mesh(std::mt19937& random, int width_px, int height_px, glm::ivec2 gaze_px, float core_px,
                              float least) {
    std::uniform_real_distribution<float> chance(0.0F, 1.0F);
    return make_mesh(width_px, height_px, gaze_px, [&](int x, int y) {
        const float distance = glm::length(glm::vec2(x - gaze_px.x, y - gaze_px.y));
        return chance(random) < std::max(least, core_px * core_px / std::max(distance * distance, 1.0F));
    });
}

/// Whether the table holds a site at a pixel of the mask.
inline bool is_site(const MeshTable& table, int x_px, int y_px) {
    const MeshPixel& p =
        table.pixels()[static_cast<std::size_t>(y_px) * static_cast<std::size_t>(table.mesh().width_px) +
                       static_cast<std::size_t>(x_px)];
    return p.ax == 0 && p.ay == 0;
}

}  // namespace macula::test
