#pragma once

#include <cstdint>
#include <cstring>

#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>

#include "scenes/scene.h"

namespace macula {

/// The number that a stored value stands for: codes of integers become 0 to 1.
inline float stored_value(const std::uint8_t* value, TexelType type) {
    if (type == TexelType::u8) return static_cast<float>(*value) * (1.0F / 255.0F);
    if (type == TexelType::f32) {
        float number = 0.0F;
        std::memcpy(&number, value, sizeof(number));
        return number;
    }
    std::uint16_t code = 0;
    std::memcpy(&code, value, sizeof(code));
    return type == TexelType::u16 ? static_cast<float>(code) * (1.0F / 65535.0F) : glm::unpackHalf1x16(code);
}

/// RGBA of the texel with this index, as stored (sRGB stays coded): grey fills RGB, missing alpha is 1.
inline glm::vec4 stored_texel(const TextureImage& image, std::size_t index) {
    const std::uint8_t* values = image.texels.data() + index * image.texel_bytes();
    const auto value = [&](int channel) {
        return stored_value(values + static_cast<std::size_t>(channel) * byte_count(image.type), image.type);
    };
    if (image.channels < 3) {
        const float grey = value(0);
        return {grey, grey, grey, image.channels == 2 ? value(1) : 1.0F};
    }
    return {value(0), value(1), value(2), image.channels == 4 ? value(3) : 1.0F};
}

}  // namespace macula
