#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "protocol/base/image.h"

namespace macula {

inline Rgba8 rgba(float r, float g, float b) {
    const auto byte = [](float v) { return static_cast<Rgba8>(std::clamp(v, 0.0F, 1.0F) * 255.0F + 0.5F); };
    return byte(r) | byte(g) << 8 | byte(b) << 16 | 0xff000000U;
}

/// A scrambled number of two: the same on every machine.
inline std::uint32_t hash(std::uint32_t x, std::uint32_t y) {
    std::uint32_t h = x * 0x9e3779b1U ^ (y + 0x7f4a7c15U) * 0x85ebca77U;
    h ^= h >> 15;
    h *= 0x2c1b3c6dU;
    return h ^ h >> 13;
}

/// Slow waves of brightness and colour, moved by `shift_px`.
inline ColorImage smooth_picture(int width, int height, int shift_px = 0) {
    ColorImage picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto u = static_cast<float>(x + shift_px) * 0.02F;
            const auto v = static_cast<float>(y) * 0.02F;
            picture.at(x, y) =
                rgba(0.5F + 0.3F * std::sin(u), 0.5F + 0.3F * std::cos(v), 0.5F + 0.2F * std::sin(u + v));
        }
    }
    return picture;
}

/// Dark strokes of letter-like size on light paper, moved by `shift_px`.
inline ColorImage text_picture(int width, int height, int shift_px = 0) {
    ColorImage picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int column = x + shift_px;
            const bool line = y % 16 < 10;
            const bool stroke =
                hash(static_cast<std::uint32_t>(column / 2), static_cast<std::uint32_t>(y / 2)) % 3 == 0;
            picture.at(x, y) = line && stroke ? rgba(0.1F, 0.1F, 0.1F) : rgba(0.9F, 0.9F, 0.85F);
        }
    }
    return picture;
}

/// Grey noise that is new in each picture: the worst case for a rate limit.
inline ColorImage noise_picture(int width, int height, std::uint32_t seed = 0) {
    ColorImage picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::uint32_t grey =
                hash(static_cast<std::uint32_t>(x) + 4099U * seed, static_cast<std::uint32_t>(y)) >> 24;
            picture.at(x, y) = grey | grey << 8 | grey << 16 | 0xff000000U;
        }
    }
    return picture;
}

/// Peak signal-to-noise ratio over R, G and B, in dB; 99 for equal pictures.
inline double psnr_db(const ColorImage& a, const ColorImage& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        for (int shift = 0; shift < 24; shift += 8) {
            const double d =
                static_cast<double>(a.texels[i] >> shift & 255U) - static_cast<double>(b.texels[i] >> shift & 255U);
            sum += d * d;
        }
    }
    if (sum == 0.0) return 99.0;
    return 10.0 * std::log10(255.0 * 255.0 * 3.0 * static_cast<double>(a.texels.size()) / sum);
}

/// Inverse depth (1/m) of a room with spheres and thin posts in front of its walls, both eyes side by side, each with
/// the tangents -1.25..1.25; `step` moves the head 4 mm and turns nothing. The nearest surface is about .9 m away.
inline InverseDepthImage room_depth(int width, int height, int step = 0) {
    InverseDepthImage picture(width, height);
    const int eye_width = width / 2;
    for (int y = 0; y < height; ++y) {
        const float ty = 1.25F - (static_cast<float>(y) + 0.5F) / static_cast<float>(height) * 2.5F;
        for (int x = 0; x < width; ++x) {
            const float tx = (static_cast<float>(x % eye_width) + 0.5F) / static_cast<float>(eye_width) * 2.5F - 1.25F;
            const float eye_x = (x < eye_width ? -0.032F : 0.032F) + 0.004F * static_cast<float>(step);
            // Inside a convex room the inverse depth is the largest over its planes: 4 m ahead, 3 m aside, 1.6 m down.
            float inverse = std::max({0.25F, tx / (3.0F - eye_x), -tx / (3.0F + eye_x), ty / 1.4F, -ty / 1.6F});
            for (int k = 0; k < 24; ++k) {
                const float cx = -2.5F + 0.1F * static_cast<float>(k * 37 % 50) - eye_x;
                const float cy = -1.3F + 0.1F * static_cast<float>(k * 53 % 24);
                const float cz = 1.2F + 0.1F * static_cast<float>(k * 29 % 28);
                const float radius = 0.08F + 0.05F * static_cast<float>(k % 5);
                const float a = tx * tx + ty * ty + 1.0F;
                const float b = tx * cx + ty * cy + cz;
                const float discriminant = b * b - a * (cx * cx + cy * cy + cz * cz - radius * radius);
                if (discriminant > 0.0F) inverse = std::max(inverse, a / (b - std::sqrt(discriminant)));
            }
            for (int k = 0; k < 40; ++k) {
                const float z = 2.0F + 0.2F * static_cast<float>(k % 7);
                if (std::abs(eye_x + z * tx + 2.9F - 0.15F * static_cast<float>(k)) < 0.008F && z * ty < 0.6F) {
                    inverse = std::max(inverse, 1.0F / z);
                }
            }
            picture.at(x, y) = inverse;
        }
    }
    return picture;
}

}  // namespace macula
