#include "protocol/codec/depth_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace macula {
namespace {

// In this order max() gives 0 for a not-a-number.
std::uint8_t code_of_scaled(float scaled) {
    return static_cast<std::uint8_t>(std::lrint(std::min(std::max(0.0F, scaled), static_cast<float>(kMaxDepthCode))));
}

float scale(float near_m) {
    return near_m * static_cast<float>(kMaxDepthCode);
}

}  // namespace

std::uint8_t depth_code(float inverse_depth, float near_m) {
    return code_of_scaled(inverse_depth * scale(near_m));
}

float inverse_depth_of(std::uint8_t code, float near_m) {
    return static_cast<float>(code) / scale(near_m);
}

void nearest_depth_codes(const InverseDepthImage& full, float near_m, std::uint8_t* codes, std::ptrdiff_t stride) {
    const int width = full.width_px / kDepthBlock_px;
    const int height = full.height_px / kDepthBlock_px;
    const float to_code = scale(near_m);
    for (int y = 0; y < height; ++y) {
        std::array<const float*, kDepthBlock_px> rows{};
        for (int i = 0; i < kDepthBlock_px; ++i) rows[i] = full.row(y * kDepthBlock_px + i);
        std::uint8_t* out = codes + y * stride;
        for (int x = 0; x < width; ++x) {
            float nearest = 0.0F;
            for (const float* row : rows) {
                for (int i = 0; i < kDepthBlock_px; ++i) nearest = std::max(nearest, row[x * kDepthBlock_px + i]);
            }
            out[x] = code_of_scaled(nearest * to_code);
        }
    }
}

}  // namespace macula
