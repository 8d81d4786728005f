#include "scenes/noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/common.hpp>

namespace macula {

float hash01(int x, int y, int seed) {
    auto h = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA77U ^
             static_cast<std::uint32_t>(seed) * 0xC2B2AE3DU;
    h = (h ^ (h >> 16U)) * 0x85EBCA6BU;
    h = (h ^ (h >> 13U)) * 0xC2B2AE35U;
    h ^= h >> 16U;
    return static_cast<float>(h >> 8U) / 16777216.0F;
}

float value_noise(float x, float y, int period, int seed) {
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    const auto wrap = [period](float f) { return ((static_cast<int>(f) % period) + period) % period; };
    const int x0 = wrap(fx);
    const int y0 = wrap(fy);
    const int x1 = (x0 + 1) % period;
    const int y1 = (y0 + 1) % period;
    const auto smooth = [](float t) { return t * t * (3.0F - 2.0F * t); };
    const float tx = smooth(x - fx);
    const float ty = smooth(y - fy);
    return glm::mix(glm::mix(hash01(x0, y0, seed), hash01(x1, y0, seed), tx),
                    glm::mix(hash01(x0, y1, seed), hash01(x1, y1, seed), tx), ty);
}

float fractal_noise(float u, float v, int cells, int seed) {
    float sum = 0.0F;
    float weight = 0.5F;
    for (int octave = 0; octave < 5; ++octave, cells *= 2, weight *= 0.5F)
        sum += weight * value_noise(u * static_cast<float>(cells), v * static_cast<float>(cells), cells, seed + octave);
    return sum;
}

NoiseField::NoiseField(int size, int cells_u, int cells_v, int octaves, int seed)
    : mask_(size - 1), size_(static_cast<float>(size)) {
    const auto count = static_cast<std::size_t>(size);
    value_.assign(count * count, 0.0F);
    float weight = 0.5F;
    for (int octave = 0; octave < octaves; ++octave, weight *= 0.5F, cells_u *= 2, cells_v *= 2) {
        // Each row mixes two rows of the lattice, which are interpolated along u once per cell row.
        const auto lattice_row = [&](int y) {
            std::vector<float> row(count);
            for (int x = 0; x < size; ++x) {
                const float cell = (static_cast<float>(x) + 0.5F) / size_ * static_cast<float>(cells_u);
                const int left = static_cast<int>(cell);
                const float t = cell - static_cast<float>(left);
                row[static_cast<std::size_t>(x)] =
                    glm::mix(hash01(left, y % cells_v, seed + octave),
                             hash01((left + 1) % cells_u, y % cells_v, seed + octave), t * t * (3.0F - 2.0F * t));
            }
            return row;
        };
        int above = 0;
        std::vector<float> upper = lattice_row(0);
        std::vector<float> lower = lattice_row(1);
        for (int y = 0; y < size; ++y) {
            const float cell = (static_cast<float>(y) + 0.5F) / size_ * static_cast<float>(cells_v);
            const int row = static_cast<int>(cell);
            if (row != above) {
                upper = row == above + 1 ? std::move(lower) : lattice_row(row);
                lower = lattice_row(row + 1);
                above = row;
            }
            const float t = cell - static_cast<float>(row);
            const float smooth = t * t * (3.0F - 2.0F * t);
            float* to = &value_[static_cast<std::size_t>(y) * count];
            for (std::size_t x = 0; x < count; ++x) to[x] += weight * glm::mix(upper[x], lower[x], smooth);
        }
    }
    const auto [low, high] = std::minmax_element(value_.begin(), value_.end());
    const float offset = *low;
    const float scale = 1.0F / std::max(*high - *low, 1e-6F);
    for (float& v : value_) v = (v - offset) * scale;
}

float NoiseField::at(float u, float v) const {
    const float x = u * size_ - 0.5F;
    const float y = v * size_ - 0.5F;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const int x0 = static_cast<int>(left) & mask_;
    const int y0 = (static_cast<int>(top) & mask_) * (mask_ + 1);
    const int x1 = (static_cast<int>(left) + 1) & mask_;
    const int y1 = ((static_cast<int>(top) + 1) & mask_) * (mask_ + 1);
    const auto texel = [this](int i) { return value_[static_cast<std::size_t>(i)]; };
    return glm::mix(glm::mix(texel(y0 + x0), texel(y0 + x1), x - left),
                    glm::mix(texel(y1 + x0), texel(y1 + x1), x - left), y - top);
}

}  // namespace macula
