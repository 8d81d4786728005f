#pragma once

#include "protocol/gl/kernel_language.h"

KERNEL_BEGIN

/// sRGB coding (IEC 61966-2-1) of a linear value, which is clamped to 0..1. The power 1/2.4 is a minimax polynomial
/// in the fourth root, which vectorises: its error is below .009/255.
KERNEL float srgb_from_linear(float linear_value) {
    float x = clamp(linear_value, 0.0F, 1.0F);
    float t = sqrt(sqrt(x));
    float curve = -0.064611537F + t * (0.19613586F + t * (1.1226816F + t * (-0.33550157F + t * 0.081329981F)));
    return x <= 0.0031308F ? 12.92F * x : curve;
}

/// Linear value of an sRGB-coded one in 0..1. Exact; for tables and tests.
KERNEL float linear_from_srgb(float coded) {
    return coded <= 0.04045F ? coded / 12.92F : pow((coded + 0.055F) / 1.055F, 2.4F);
}

/// Eight bits of a value in 0..1, rounded to nearest.
KERNEL uint byte_from_unit(float value) {
    return uint(int(floor(value * 255.0F + 0.5F)));
}

/// sRGB-coded RGBA8 of linear display radiance (1 is white): R in the lowest byte, A = 255.
KERNEL uint srgb8_from_linear(vec3 radiance) {
    uint r = byte_from_unit(srgb_from_linear(radiance.x));
    uint g = byte_from_unit(srgb_from_linear(radiance.y));
    uint b = byte_from_unit(srgb_from_linear(radiance.z));
    return r | (g << 8) | (b << 16) | 0xFF000000U;
}

KERNEL_END
