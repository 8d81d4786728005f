#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/pattern_surface.h"

namespace macula {

/// Which images of a surface are made.
enum PaintedMaps : unsigned { kPaintColor = 1, kPaintAlpha = 2, kPaintRoughness = 4, kPaintNormal = 8 };

/// An image of bytes that are still to be written.
inline TextureImage blank_image(std::string name, int width_px, int height_px, int channels, bool srgb) {
    TextureImage image;
    image.name = std::move(name);
    image.width_px = width_px;
    image.height_px = height_px;
    image.channels = channels;
    image.srgb = srgb;
    image.texels.resize(image.texel_count() * image.texel_bytes());
    return image;
}

inline std::uint8_t unit_byte(float value) {
    return static_cast<std::uint8_t>(std::lround(glm::clamp(value, 0.0F, 1.0F) * 255.0F));
}

/// Square images whose texels are `texel(u, v)`, a SurfaceTexel, at their centres. Normals point along -dh/du and,
/// since v runs down and the bitangent up, +dh/dv (glTF: green is up).
template <class Texel>
SurfaceMaps paint_surface(const std::string& name, int size_px, unsigned maps, Texel texel) {
    const auto size = static_cast<std::size_t>(size_px);
    const std::size_t channels = (maps & kPaintAlpha) != 0 ? 4 : 3;
    SurfaceMaps result;
    result.color = blank_image(name, size_px, size_px, static_cast<int>(channels), true);
    if ((maps & kPaintRoughness) != 0)
        result.roughness_metallic = blank_image(name + " roughness", size_px, size_px, 3, false);
    std::vector<float> height((maps & kPaintNormal) != 0 ? size * size : 0);
    const float step = 1.0F / static_cast<float>(size_px);
    for (std::size_t y = 0; y < size; ++y)
        for (std::size_t x = 0; x < size; ++x) {
            const SurfaceTexel t = texel((static_cast<float>(x) + 0.5F) * step, (static_cast<float>(y) + 0.5F) * step);
            const std::size_t at = y * size + x;
            std::uint8_t* color = &result.color.texels[channels * at];
            for (int c = 0; c < 3; ++c) color[c] = unit_byte(t.color[c]);
            if (channels == 4) color[3] = unit_byte(t.alpha);
            if ((maps & kPaintRoughness) != 0) {
                std::uint8_t* rough = &result.roughness_metallic.texels[3 * at];
                rough[0] = 255;
                rough[1] = unit_byte(t.roughness);
                rough[2] = unit_byte(t.metallic);
            }
            if ((maps & kPaintNormal) != 0) height[at] = t.height;
        }
    if ((maps & kPaintNormal) == 0) return result;
    result.normal = blank_image(name + " normals", size_px, size_px, 3, false);
    const float per_slope = 0.5F * static_cast<float>(size_px);
    for (std::size_t y = 0; y < size; ++y)
        for (std::size_t x = 0; x < size; ++x) {
            const auto h = [&](std::size_t column, std::size_t row) {
                return height[(row % size) * size + column % size];
            };
            const glm::vec3 normal = glm::normalize(glm::vec3((h(x + size - 1, y) - h(x + 1, y)) * per_slope,
                                                              (h(x, y + 1) - h(x, y + size - 1)) * per_slope, 1.0F));
            std::uint8_t* to = &result.normal.texels[3 * (y * size + x)];
            for (int c = 0; c < 3; ++c) to[c] = unit_byte(0.5F * normal[c] + 0.5F);
        }
    return result;
}

/// 0 below `from`, 1 above `to`, smooth between.
inline float ramp(float from, float to, float x) {
    const float t = glm::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// Fraction of a number: its place in a repeating cell.
inline float cell(float x) {
    return x - std::floor(x);
}

/// 1 in the middle of a line of half width `half` around 0, 0 outside, `soft` wide edges.
inline float line(float distance, float half, float soft) {
    return 1.0F - ramp(half - soft, half + soft, std::abs(distance));
}

}  // namespace macula
