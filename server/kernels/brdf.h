#pragma once

#include "protocol/gl/kernel_language.h"

// The metallic-roughness reflectance of glTF 2.0, Appendix B: a GGX microfacet layer with height-correlated Smith
// masking and Schlick's Fresnel term, and under it a Lambert base. The base receives what the layer lets in and out
// (Shirley et al. 1997, "A practitioners' assessment of light reflection models", eq. 6): glTF's own example mix
// takes the loss at the half vector, and reflects up to 13 % more than arrives.

KERNEL_BEGIN

const float kPi = 3.14159265F;

/// Specular reflectance of a dielectric at normal incidence (glTF 2.0 B.3.5).
const float kDielectricF0 = 0.04F;

/// Perceptual roughness below which highlights of point lights would be lost between samples and to rounding.
const float kMinRoughness = 0.045F;

/// What the reflectance needs to know about a surface.
struct Reflectance {
    vec3 diffuse;  ///< albedo of the base
    vec3 f0;       ///< specular reflectance at normal incidence
    float alpha;   ///< GGX width: perceptual roughness squared
};

/// glTF 2.0 B.3.5: dielectrics reflect 4 %, metals their base colour and have no base.
KERNEL Reflectance make_reflectance(vec3 base_color, float metallic, float roughness) {
    float r = max(roughness, kMinRoughness);
    Reflectance result;
    result.diffuse = base_color * (1.0F - metallic);
    result.f0 = vec3(kDielectricF0 * (1.0F - metallic)) + base_color * metallic;
    result.alpha = r * r;
    return result;
}

/// GGX normal distribution (Walter et al. 2007, eq. 33), 1/sr. `n_cross_h_sq` is |n x h|^2 for the same h, which
/// stays exact at the peak where 1 - (n.h)^2 does not.
KERNEL float ggx_distribution(float n_dot_h, float n_cross_h_sq, float alpha) {
    float a = n_dot_h * alpha;
    float k = alpha / max(n_cross_h_sq + a * a, 1.0e-9F);
    return k * k * (1.0F / kPi);
}

/// Height-correlated Smith masking and shadowing over 4 (n.l) (n.v) (Heitz 2014, eq. 99; glTF 2.0 B.3.3).
KERNEL float smith_visibility(float n_dot_l, float n_dot_v, float alpha) {
    float a2 = alpha * alpha;
    float masking = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0F - a2) + a2);
    float shadowing = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0F - a2) + a2);
    return 0.5F / (masking + shadowing);
}

/// How far from normal incidence a cosine is, as Schlick 1994 approximates Fresnel's equations: (1 - cos)^5.
KERNEL float schlick_weight(float cosine) {
    float m = clamp(1.0F - cosine, 0.0F, 1.0F);
    float m2 = m * m;
    return m2 * m2 * m;
}

/// Fresnel reflectance by Schlick 1994.
KERNEL vec3 schlick_fresnel(vec3 f0, float cosine) {
    return f0 + (vec3(1.0F) - f0) * schlick_weight(cosine);
}

/// Lambert's base under a dielectric layer, 1/sr: it reflects what the layer does not, 1 - fresnel(n.v), of a white
/// surface. 21/20 makes up for the mean of the light's weight.
KERNEL float layered_base(float n_dot_l, float n_dot_v) {
    return (1.0F - kDielectricF0) * 1.05F / kPi * (1.0F - schlick_weight(n_dot_l)) * (1.0F - schlick_weight(n_dot_v));
}

/// Reflectance distribution times n.l, 1/sr: radiance towards `view` per irradiance that `light` brings to a
/// surface that faces it. All vectors are unit and point away from the surface; 0 where n.l <= 0. A view that a
/// bent normal turns away from counts as grazing.
KERNEL vec3 reflect_light(Reflectance surface, vec3 normal, vec3 view, vec3 light) {
    float n_dot_l = max(dot(normal, light), 0.0F);
    float n_dot_v = max(dot(normal, view), 1.0e-4F);
    vec3 sum = light + view;
    vec3 h = sum * (1.0F / sqrt(max(dot(sum, sum), 1.0e-12F)));
    vec3 n_cross_h = cross(normal, h);
    float d = ggx_distribution(max(dot(normal, h), 0.0F), dot(n_cross_h, n_cross_h), surface.alpha);
    float v = smith_visibility(max(n_dot_l, 1.0e-4F), n_dot_v, surface.alpha);
    vec3 f = schlick_fresnel(surface.f0, dot(view, h));
    return (surface.diffuse * layered_base(n_dot_l, n_dot_v) + f * (v * d)) * n_dot_l;
}

/// Share of uniform light from everywhere that the surface sends to the viewer: the Fresnel term is taken at normal
/// incidence, so that a white surface reflects all of it.
KERNEL vec3 reflect_uniform_light(Reflectance surface) {
    return surface.f0 + surface.diffuse * (1.0F - kDielectricF0);
}

KERNEL_END
