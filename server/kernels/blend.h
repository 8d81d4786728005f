#pragma once

#include "protocol/gl/kernel_language.h"

KERNEL_BEGIN

// How three samples make a pixel, for every reconstruction that has their weights at hand.

const uint kOpaqueBlack = 0xFF000000U;

// Where the nearest of three samples is more than this factor nearer than the farthest, they lie on different
// surfaces. So do a hit and a miss. Measured on a room with spheres and poles at 27 %, as the pixels whose inverse
// depth reprojects more than half a pixel wrong when the head steps 2 cm aside: .106 % at this ratio, .114 % at 1.05,
// .124 % at 1.5, .265 % where everything is interpolated; the mean error falls by a fifth.
const float kSurfaceRatio = 1.25F;

/// RGBA8 of three colours, per channel (sum of weight * colour + 1/2) in 1/256. The weights sum to 256. Two channels
/// share a multiplication.
KERNEL uint blend_color(uint color_a, uint color_b, uint color_c, uint weight_a, uint weight_b, uint weight_c) {
    const uint mask = 0x00FF00FFU;
    const uint half_each = 0x00800080U;
    uint even = (color_a & mask) * weight_a + (color_b & mask) * weight_b + (color_c & mask) * weight_c + half_each;
    uint odd = ((color_a >> 8) & mask) * weight_a + ((color_b >> 8) & mask) * weight_b +
               ((color_c >> 8) & mask) * weight_c + half_each;
    return ((even >> 8) & mask) | (odd & ~mask);
}

/// Inverse depth of three samples of which `a` has the largest weight; weights are in 1/256. Between surfaces it is
/// that of `a`: a value in between would be a surface that does not exist.
KERNEL float blend_inverse_depth(float depth_a, float depth_b, float depth_c, uint weight_b, uint weight_c) {
    float nearest = max(max(depth_a, depth_b), depth_c);
    float farthest = min(min(depth_a, depth_b), depth_c);
    KERNEL_PRECISE float blended =
        depth_a +
        (float(int(weight_b)) * (depth_b - depth_a) + float(int(weight_c)) * (depth_c - depth_a)) * 0.00390625F;
    return nearest <= kSurfaceRatio * farthest ? blended : depth_a;
}

KERNEL_END
