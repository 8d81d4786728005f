#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/base/image.h"

namespace macula {

// The depth plane of a frame: a quarter of the picture in each direction, one 8-bit code of inverse depth for each
// 4x4 block. DEPTH.md derives the errors and says why nearest, 8 bits and lossless.

inline constexpr int kDepthBlock_px = 4;
inline constexpr int kMaxDepthCode = 255;

/// Code of an inverse depth (1/m): round(inverse_depth * near_m * 255), limited to 0..255. What is nearer than near_m
/// is put at near_m; 0 (nothing hit) is exactly 0, and what is farther than 510 near_m becomes 0 too. Not-a-number
/// gives 0. near_m > 0.
std::uint8_t depth_code(float inverse_depth, float near_m);

/// Inverse depth (1/m) of a code; 0 for 0.
float inverse_depth_of(std::uint8_t code, float near_m);

/// Codes of the nearest surface in each 4x4 block, row-major with `stride` bytes a row: width / 4 by height / 4 codes.
/// Width and height are multiples of 4; near_m > 0.
void nearest_depth_codes(const InverseDepthImage& full, float near_m, std::uint8_t* codes, std::ptrdiff_t stride);

/// Largest error of inverse depth (1/m) by quantisation, for surfaces between near_m and infinity: half a step.
constexpr float depth_quantisation_error(float near_m) {
    return 0.5F / (static_cast<float>(kMaxDepthCode) * near_m);
}

/// Largest error of inverse depth (1/m) by keeping one value for a block inside one plane, whose inverse depth changes
/// by `gradient_x` and `gradient_y` (1/m per pixel): the way from one corner pixel of the block to the opposite one.
constexpr float depth_block_error(float gradient_x, float gradient_y) {
    const float x = gradient_x < 0.0F ? -gradient_x : gradient_x;
    const float y = gradient_y < 0.0F ? -gradient_y : gradient_y;
    return static_cast<float>(kDepthBlock_px - 1) * (x + y);
}

/// Error in pixels of where a point lands when it is reprojected to an eye that moved by `translation_m` across the
/// view direction, with an error of its inverse depth (1/m); `focal_px` is pixels per unit tangent. Exact for motion
/// in the image plane: a point at tangent X/Z moves by translation / Z.
constexpr float reprojection_error_px(float focal_px, float translation_m, float inverse_depth_error) {
    return focal_px * translation_m * inverse_depth_error;
}

}  // namespace macula
