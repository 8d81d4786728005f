#include "server/render/texture_lookup.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "server/kernels/color.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec4;

/// Of 256 codes of 8 bits, linear and sRGB, and of the 4097 codes of sRGB that are multiples of 16.
struct DecodeTables {
    std::array<float, 256> linear8{};
    std::array<float, 256> srgb8{};
    std::array<float, 4097> srgb16{};

    DecodeTables() {
        for (std::size_t i = 0; i < linear8.size(); ++i) {
            linear8[i] = static_cast<float>(i) / 255.0F;
            srgb8[i] = kernels::linear_from_srgb(linear8[i]);
        }
        for (std::size_t i = 0; i < srgb16.size(); ++i)
            srgb16[i] = kernels::linear_from_srgb(static_cast<float>(i * 16) / 65535.0F);
    }
};

const float* decode_table(TexelType type, bool srgb) {
    static const DecodeTables tables;
    if (type == TexelType::u8) return srgb ? tables.srgb8.data() : tables.linear8.data();
    return type == TexelType::u16 && srgb ? tables.srgb16.data() : nullptr;
}

int kernel_wrap(TextureWrap wrap) {
    if (wrap == TextureWrap::clamp_to_edge) return kernels::kWrapClampToEdge;
    return wrap == TextureWrap::mirrored_repeat ? kernels::kWrapMirroredRepeat : kernels::kWrapRepeat;
}

template <class Value>
Value load(const std::uint8_t* at, int index) {
    Value value;
    std::memcpy(&value, at + static_cast<std::size_t>(index) * sizeof(Value), sizeof(Value));
    return value;
}

/// Value `index` of a texel, as colour or as alpha, which sRGB does not code.
template <TexelType type, bool alpha>
float value(const std::uint8_t* texel, int index, const float* decode) {
    if constexpr (type == TexelType::u8) {
        return alpha ? static_cast<float>(texel[index]) * (1.0F / 255.0F) : decode[texel[index]];
    } else if constexpr (type == TexelType::u16) {
        const auto code = load<std::uint16_t>(texel, index);
        if (alpha || decode == nullptr) return static_cast<float>(code) * (1.0F / 65535.0F);
        // Between 4097 points of sRGB's curve a line is off by 2e-8.
        const float* entry = decode + (code >> 4U);
        return entry[0] + (entry[1] - entry[0]) * static_cast<float>(code & 15U) * (1.0F / 16.0F);
    } else if constexpr (type == TexelType::f16) {
        // Exact for all finite values: the exponent is moved, then its offset is made up for.
        const std::uint32_t bits = load<std::uint16_t>(texel, index);
        const float magnitude = std::bit_cast<float>((bits & 0x7FFFU) << 13U) * 0x1p112F;
        return (bits & 0x8000U) != 0 ? -magnitude : magnitude;
    } else {
        return load<float>(texel, index);
    }
}

template <TexelType type, int channels>
vec4 texel_value(const std::uint8_t* texel, const float* decode) {
    const float red = value<type, false>(texel, 0, decode);
    if constexpr (channels == 1) return {red, red, red, 1.0F};
    if constexpr (channels == 2) return {red, red, red, value<type, true>(texel, 1, decode)};
    if constexpr (channels >= 3) {
        const float alpha = channels == 4 ? value<type, true>(texel, 3, decode) : 1.0F;
        return {red, value<type, false>(texel, 1, decode), value<type, false>(texel, 2, decode), alpha};
    }
}

template <TexelType type, int channels>
vec4 mix_four(const TextureView& t, const kernels::TexelFootprint& f) {
    constexpr std::size_t kBytes = channels * byte_count(type);
    const std::size_t row = static_cast<std::size_t>(t.lookup.size_px.x) * kBytes;
    const auto at = [&](int x, int y) {
        return texel_value<type, channels>(
            t.texels + static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x) * kBytes, t.decode);
    };
    if (t.lookup.nearest == 1) return at(f.x.x, f.y.x);
    return kernels::mix_texels(f, at(f.x.x, f.y.x), at(f.x.y, f.y.x), at(f.x.x, f.y.y), at(f.x.y, f.y.y));
}

template <TexelType type>
vec4 mix_four(const TextureView& t, const kernels::TexelFootprint& f) {
    switch (t.channels) {
        case 1:
            return mix_four<type, 1>(t, f);
        case 2:
            return mix_four<type, 2>(t, f);
        case 3:
            return mix_four<type, 3>(t, f);
        default:
            return mix_four<type, 4>(t, f);
    }
}

}  // namespace

TextureView view_texture(const TextureUse& use, const TextureImage& image) {
    TextureView view;
    view.lookup.uv_scale_rotation = use.uv_scale_rotation;
    view.lookup.uv_offset = use.uv_offset;
    view.lookup.size_px = {image.width_px, image.height_px};
    view.lookup.wrap = {kernel_wrap(use.wrap_u), kernel_wrap(use.wrap_v)};
    view.lookup.nearest = use.filter == TextureFilter::nearest ? 1 : 0;
    view.texels = image.texels.data();
    view.channels = image.channels;
    view.type = image.type;
    view.decode = decode_table(image.type, image.srgb);
    return view;
}

vec4 look_up(const TextureView& texture, vec2 uv) noexcept {
    const kernels::TexelFootprint footprint = kernels::texel_footprint(texture.lookup, uv);
    switch (texture.type) {
        case TexelType::u8:
            return mix_four<TexelType::u8>(texture, footprint);
        case TexelType::u16:
            return mix_four<TexelType::u16>(texture, footprint);
        case TexelType::f16:
            return mix_four<TexelType::f16>(texture, footprint);
        default:
            return mix_four<TexelType::f32>(texture, footprint);
    }
}

}  // namespace macula
