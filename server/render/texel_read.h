#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <glm/vec4.hpp>

#include "scenes/scene.h"

namespace macula {

/// Linear values of the 256 codes of u8, or of every 16th code of sRGB's u16 and one more; null for other types.
/// Lives as long as the program.
const float* decode_table(TexelType type, bool srgb);

/// Value `index` of a texel, as colour or as alpha, which sRGB does not code. Half floats are finite.
template <TexelType type, bool alpha>
inline float read_value(const std::uint8_t* texel, std::size_t index, const float* decode) {
    std::uint16_t code = 0;
    if constexpr (byte_count(type) == 2) std::memcpy(&code, texel + 2 * index, 2);
    if constexpr (type == TexelType::u8) {
        return alpha ? static_cast<float>(texel[index]) * (1.0F / 255.0F) : decode[texel[index]];
    } else if constexpr (type == TexelType::u16) {
        if (alpha || decode == nullptr) return static_cast<float>(code) * (1.0F / 65535.0F);
        // Between 4097 points of sRGB's curve a line is off by 2e-8.
        const float* entry = decode + (code >> 4U);
        return entry[0] + (entry[1] - entry[0]) * (static_cast<float>(code & 15U) * (1.0F / 16.0F));
    } else if constexpr (type == TexelType::f16) {
        // The exponent is moved to its place in a float; the product makes up for its other offset.
        const std::uint32_t bits = code;
        return std::bit_cast<float>((bits & 0x8000U) << 16U | (bits & 0x7FFFU) << 13U) * 0x1p112F;
    } else {
        float number = 0.0F;
        std::memcpy(&number, texel + 4 * index, 4);
        return number;
    }
}

/// RGBA of a texel, sRGB decoded: grey fills RGB, missing alpha is 1.
template <TexelType type, int channels>
inline glm::vec4 read_texel(const std::uint8_t* texel, const float* decode) {
    const float red = read_value<type, false>(texel, 0, decode);
    if constexpr (channels == 1) {
        return {red, red, red, 1.0F};
    } else if constexpr (channels == 2) {
        return {red, red, red, read_value<type, true>(texel, 1, decode)};
    } else {
        float alpha = 1.0F;
        if constexpr (channels == 4) alpha = read_value<type, true>(texel, 3, decode);
        return {red, read_value<type, false>(texel, 1, decode), read_value<type, false>(texel, 2, decode), alpha};
    }
}

/// Calls `use.template operator()<type, channels>()` for an image's format, and returns what it returns.
template <class Use>
inline auto with_texel_format(TexelType type, int channels, Use&& use) {
    const auto with_channels = [&]<TexelType kType>() {
        switch (channels) {
            case 1:
                return use.template operator()<kType, 1>();
            case 2:
                return use.template operator()<kType, 2>();
            case 3:
                return use.template operator()<kType, 3>();
            default:
                return use.template operator()<kType, 4>();
        }
    };
    switch (type) {
        case TexelType::u8:
            return with_channels.template operator()<TexelType::u8>();
        case TexelType::u16:
            return with_channels.template operator()<TexelType::u16>();
        case TexelType::f16:
            return with_channels.template operator()<TexelType::f16>();
        default:
            return with_channels.template operator()<TexelType::f32>();
    }
}

}  // namespace macula
