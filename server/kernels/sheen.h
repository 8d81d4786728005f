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
    s.s0 = k * (0.720881F + r * (-2.01028F + r * (4.1515F - r * 2.12067F)));
    s.s1 = k * (0.408354F + r * (6.42531F + r * (-12.2361F + r * 5.61347F)));
    s.s2 = k * (0.20062F + r * (-37.0569F + r * (57.851F - r * 22.6368F)));
    s.s3 = k * (4.09426F + r * (57.9194F + r * (-56.542F + r * 3.50827F)));
    s.s4 = k * (-6.268F + r * (-25.8627F + r * (-3.42675F + r * 25.4423F)));
    return s;
}

/// Directional albedo of the lobe for a sheen colour of one, 0..1. Integrated with 280 x 140 Gauss-Legendre nodes at
/// 41 roughnesses in .07..1 and 46 cosines in .003..1 and fitted as the microfacets' albedos are (microfacet.h), with
/// t = mu / (mu + .6 r): (1 - t)^2 P(t, r) (r + .3) / r, divided by the lobe's divisor. Largest error .0073 for
/// mu >= .02, .037 below.
KERNEL float sheen_albedo(KERNEL_IN(Sheen) s, float cosine) {
    float t = cosine / (cosine + 0.6F * s.roughness);
    float u = 1.0F - t;
    return clamp(u * u * (s.s0 + t * (s.s1 + t * (s.s2 + t * (s.s3 + t * s.s4)))), 0.0F, 1.0F);
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
