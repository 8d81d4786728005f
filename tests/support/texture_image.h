#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>

#include "scenes/scene.h"

namespace macula::test {

/// An image whose texel (x, y) stores the first `channels` of `color(x, y)`, RGBA; of grey ones red and alpha.
inline TextureImage make_image(int width_px, int height_px, int channels, TexelType type,
                               const std::function<glm::vec4(int x, int y)>& color, bool srgb = false) {
    TextureImage image{"test image", width_px, height_px, channels, type, srgb, {}};
    const auto append = [&image](const auto& value) {
        const std::size_t at = image.texels.size();
        image.texels.resize(at + sizeof(value));
        std::memcpy(&image.texels[at], &value, sizeof(value));
    };
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x)
            for (int c = 0; c < channels; ++c) {
                const float value = color(x, y)[channels == 2 && c == 1 ? 3 : c];
                if (type == TexelType::u8) append(static_cast<std::uint8_t>(value * 255.0F + 0.5F));
                if (type == TexelType::u16) append(static_cast<std::uint16_t>(value * 65535.0F + 0.5F));
                if (type == TexelType::f16) append(std::uint16_t{glm::packHalf1x16(value)});
                if (type == TexelType::f32) append(value);
            }
    return image;
}

}  // namespace macula::test
