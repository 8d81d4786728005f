#pragma once

#include "protocol/gl/kernel_language.h"

KERNEL_BEGIN

/// floor(dividend / divisor) in a float division, of which processors do many at once. Exact for a dividend below 2^18,
/// a divisor from 1 to 1024 and a quotient below 256, or a divisor up to 64 and a quotient below 4096: the quotient
/// of (dividend + 1/4) is at least 1/4 divisor from a whole number, six times as far as GLSL's 2.5 units in the last
/// place.
KERNEL uint divide_small(uint dividend, uint divisor) {
    return uint((float(int(dividend)) + 0.25F) / float(int(divisor)));
}

KERNEL_END
