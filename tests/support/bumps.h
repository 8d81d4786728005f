#pragma once

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "scenes/noise.h"
#include "scenes/scene.h"

namespace macula::test {

/// Normal map of noise with `cells` lattice cells along an edge; it repeats.
inline TextureImage bumps(int size_px, int cells, float steepness) {
    TextureImage image;
    image.name = "bumps";
    image.width_px = image.height_px = size_px;
    image.channels = 3;
    const auto height = [&](int x, int y) {
        const float cells_per_px = static_cast<float>(cells) / static_cast<float>(size_px);
        return value_noise(static_cast<float>(x) * cells_per_px, static_cast<float>(y) * cells_per_px, cells, 17);
    };
    for (int y = 0; y < size_px; ++y)
        for (int x = 0; x < size_px; ++x) {
            const glm::vec2 slope(height(x + 1, y) - height(x - 1, y), height(x, y + 1) - height(x, y - 1));
            const glm::vec3 normal = glm::normalize(glm::vec3(slope * -steepness, 1.0F)) * 0.5F + 0.5F;
            for (int c = 0; c < 3; ++c)
                image.texels.push_back(static_cast<std::uint8_t>(std::lround(normal[c] * 255.0F)));
        }
    return image;
}

}  // namespace macula::test
