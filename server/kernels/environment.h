#pragma once

#include "protocol/gl/kernel_language.h"

// Light from far away all around: where a direction lies on a lat-long map, and the light that a matt surface receives
// as nine spherical harmonics.

KERNEL_BEGIN

const float kInverseTau = 0.159154943F;

/// Angle of (x, y) in -pi..pi, 0 along +x; 0 at the origin. Within 2e-6 rad: the arc tangent of 0..1 is a minimax
/// polynomial, which vectorises.
KERNEL float angle_of(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float t = min(ax, ay) / max(max(ax, ay), 1.0e-30F);
    float s = t * t;
    float arc =
        t * (0.999977219F +
             s * (-0.332622828F + s * (0.193540376F + s * (-0.116426482F + s * (0.0526473515F + s * -0.0117191357F)))));
    float octant = ay > ax ? 1.57079633F - arc : arc;
    float half_turn = x < 0.0F ? 3.14159265F - octant : octant;
    return y < 0.0F ? -half_turn : half_turn;
}

/// Coordinates of a direction (any length) on a lat-long map: u = 0 and 1 at +Z, 1/4 at -X, 1/2 at -Z; v = 0 at +Y.
/// `rotation` is the map's, counter-clockwise about +Y seen from above. u in [0, 1), v in [0, 1].
KERNEL vec2 lat_long_uv(vec3 direction, float rotation) {
    float u = (angle_of(-direction.x, direction.z) + rotation) * kInverseTau;
    float horizontal = sqrt(direction.x * direction.x + direction.z * direction.z);
    float v = angle_of(horizontal, direction.y) * (2.0F * kInverseTau);
    float wrapped = u - floor(u);
    return vec2(wrapped < 1.0F ? wrapped : 0.0F, clamp(v, 0.0F, 1.0F));
}

/// Irradiance of every normal as a polynomial of its components: the nine spherical harmonics up to order 2 that
/// Ramamoorthi and Hanrahan 2001 ("An Efficient Representation for Irradiance Environment Maps") keep, each with its
/// constants and the cosine's factor multiplied in.
struct IrradianceHarmonics {
    vec3 one;
    vec3 y;
    vec3 z;
    vec3 x;
    vec3 xy;
    vec3 yz;
    vec3 zz;  ///< of 3 z^2 - 1
    vec3 xz;
    vec3 xx_yy;  ///< of x^2 - y^2
};

/// Irradiance that arrives at a surface with the unit normal `n`. Of light from a single direction it is wrong by up to
/// 9.4 % of what faces that direction; of light from all around by some 1 %. Never negative.
KERNEL vec3 irradiance_of(KERNEL_IN(IrradianceHarmonics) h, vec3 n) {
    vec3 sum = h.one + h.y * n.y + h.z * n.z + h.x * n.x;
    sum = sum + h.xy * (n.x * n.y) + h.yz * (n.y * n.z) + h.xz * (n.x * n.z);
    sum = sum + h.zz * (3.0F * n.z * n.z - 1.0F) + h.xx_yy * (n.x * n.x - n.y * n.y);
    return max(sum, vec3(0.0F));
}

KERNEL_END
