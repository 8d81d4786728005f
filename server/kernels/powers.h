#pragma once

#include "protocol/gl/kernel_language.h"

// Powers that vectorise: a call of the library's in a loop over lanes is sixteen calls.

KERNEL_BEGIN

/// Logarithm to base 2 of a positive normal number. The mantissa is brought to 2/3..4/3, where a minimax polynomial
/// gives log2(1 + z) / z, so that the relative error stays below 1.2e-6 even around 1 (about .6e-6 of it rounding).
KERNEL float log2_near(float x) {
    uint bits = floatBitsToUint(x);
    uint shifted = bits - 0x3F2AAAABU;  // 2/3
    uint exponent = shifted & 0xFF800000U;
    float z = uintBitsToFloat(bits - exponent) - 1.0F;
    float p = 1.44269456F +
              z * (-0.72137989F +
                   z * (0.48100567F + z * (-0.35838877F + z * (0.2846182F + z * (-0.27999809F + z * 0.25264535F)))));
    int whole = int(exponent) / 8388608;  // 2^23: exact
    return float(whole) + z * p;
}

/// 2 to the power of x, relative error below 3e-7; 2^-126 for less than -126, 2^126 for more than 126. The polynomial
/// is minimax in the fraction.
KERNEL float exp2_near(float x) {
    float c = clamp(x, -126.0F, 126.0F);
    float whole = floor(c);
    float f = c - whole;
    float p =
        0.99999993F + f * (0.69315307F + f * (0.24015362F + f * (0.05582632F + f * (0.00898934F + f * 0.00187758F))));
    return uintBitsToFloat(uint(int(whole) + 127) << 23) * p;
}

/// x to the power of y for a positive normal x.
KERNEL float pow_near(float x, float y) {
    return exp2_near(y * log2_near(x));
}

/// e to the power of x.
KERNEL float exp_near(float x) {
    return exp2_near(x * 1.44269504F);
}

KERNEL_END
