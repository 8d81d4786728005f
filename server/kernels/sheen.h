#pragma once

#include "server/kernels/microfacet.h"
#include "server/kernels/powers.h"

// The sheen of KHR_materials_sheen: fibres that stand up from the surface (Estevez and Kulla 2017, "Production
// friendly microfacet sheen BRDF"), the distribution called Charlie with the masking that the paper fits.
//
// As published it reflects more than arrives where roughness is small and the view grazes: 1.05 at roughness .2 and
// 2.0 at .07, both at n.v = .02. Here the lobe is divided by 0.22 + 0.19 / roughness where that exceeds 1, which
// keeps its albedo under 1 for n.v >= .01.

KERNEL_BEGIN

/// Roughness below which sheen would be a line at the horizon; its distribution's peak is then 33/sr.
const float kMinSheenRoughness = 0.07F;

/// A sheen lobe of one roughness.
struct Sheen {
    float exponent;  ///< of the squared sine: half of 1 / alpha
    float scale;     ///< of the distribution, 1/sr
    float a;         ///< constants of the masking function's fit
    float b;
    float c;
    float d;
    float e;
    float roughness;
    float s0;  ///< albedo as a polynomial, see `sheen_albedo`
    float s1;
    float s2;
    float s3;
    float s4;
    float s5;
    float s6;
};

/// `sheen_roughness` is perceptual, 0..1.
KERNEL Sheen make_sheen(float sheen_roughness) {
    float r = clamp(sheen_roughness, kMinSheenRoughness, 1.0F);
    float alpha = r * r;
    float rest = (1.0F - alpha) * (1.0F - alpha);
    Sheen s;
    s.roughness = r;
    s.exponent = 0.5F / alpha;
    float excess = max(1.0F, 0.22F + 0.19F / r);
    s.scale = (2.0F + 1.0F / alpha) / (2.0F * kPi * excess);
    s.a = mix(21.5473F, 25.3245F, rest);
    s.b = mix(3.82987F, 3.32435F, rest);
    s.c = mix(0.19823F, 0.16801F, rest);
    s.d = mix(-1.97760F, -1.27393F, rest);
    s.e = mix(-4.32054F, -4.85967F, rest);
    float k = (r + 0.3F) / (r * excess);
    s.s0 = k * (0.7560179F + r * (-2.099206F + r * (4.163897F - r * 2.09492F)));
    s.s1 = k * (-0.6365695F + r * (10.12856F + r * (-14.144F + r * 6.110948F)));
    s.s2 = k * (10.93515F + r * (-77.43612F + r * (78.22187F - r * 30.45675F)));
    s.s3 = k * (-32.62601F + r * (203.0429F + r * (-22.49605F - r * 26.62174F)));
    s.s4 = k * (47.75995F + r * (-237.732F + r * (-456.8999F + r * 298.2846F)));
    s.s5 = k * (-23.3376F + r * (79.04287F + r * (950.955F - r * 532.5741F)));
    s.s6 = k * (-5.351894F + r * (34.62309F + r * (-583.0328F + r * 305.6185F)));
    return s;
}

/// Directional albedo of the lobe for a sheen colour of one, 0..1. Integrated with 280 x 140 Gauss-Legendre nodes at
/// 41 roughnesses in .07..1 and 46 cosines in .003..1 and fitted as the microfacets' albedos are (microfacet.h), with
/// t = mu / (mu + r / 2): (1 - t)^2 P(t, r) (r + .3) / r, divided by the lobe's divisor; P is of degree 6 in t and 3 in
/// r. Largest error .0065 for mu >= .02, between those points, too, .023 below.
KERNEL float sheen_albedo(KERNEL_IN(Sheen) s, float cosine) {
    float t = cosine / (cosine + 0.5F * s.roughness);
    float u = 1.0F - t;
    float p = s.s0 + t * (s.s1 + t * (s.s2 + t * (s.s3 + t * (s.s4 + t * (s.s5 + t * s.s6)))));
    return clamp(u * u * p, 0.0F, 1.0F);
}

/// Exponent of the masking function's fit at a cosine (Estevez and Kulla 2017, eq. 3).
KERNEL float sheen_masking_exponent(KERNEL_IN(Sheen) s, float cosine) {
    return s.a / (1.0F + s.b * pow_near(max(cosine, 1.0e-6F), s.c)) + s.d * cosine + s.e;
}

/// Smith's Lambda of the fibres, symmetric about the cosine .5 in its logarithm.
KERNEL float sheen_masking(KERNEL_IN(Sheen) s, float cosine) {
    bool steep = cosine >= 0.5F;
    float near = sheen_masking_exponent(s, steep ? 1.0F - cosine : cosine);
    float middle = sheen_masking_exponent(s, 0.5F);
    return exp_near(steep ? 2.0F * middle - near : near);
}

/// Reflectance distribution, 1/sr, for a sheen colour of one. `masking_view` is `sheen_masking` of n.v.
KERNEL float reflect_sheen(KERNEL_IN(Sheen) s, float n_dot_l, float n_dot_v, float n_cross_h_sq, float masking_view) {
    float d = s.scale * pow_near(clamp(n_cross_h_sq, 1.0e-12F, 1.0F), s.exponent);
    float g = 1.0F + masking_view + sheen_masking(s, n_dot_l);
    return d / (g * 4.0F * n_dot_l * n_dot_v);
}

KERNEL_END
