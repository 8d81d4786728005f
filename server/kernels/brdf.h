#pragma once

#include "protocol/gl/kernel_language.h"

// The metallic-roughness reflectance of glTF 2.0, Appendix B: a Lambert base under a GGX microfacet layer with
// height-correlated Smith masking and Schlick's Fresnel term.

KERNEL_BEGIN

const float kPi = 3.14159265F;

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
    result.f0 = vec3(0.04F * (1.0F - metallic)) + base_color * metallic;
    result.alpha = r * r;
    return result;
}

/// GGX normal distribution (Walter et al. 2007, eq. 33), 1/sr. `n_cross_h_sq` is |n x h|^2 for the same h, which
/// stays exact at the peak where 1 - (n.h)^2 does not.
KERNEL float ggx_distribution(float n_dot_h, float n_cross_h_sq, float alpha) {
    float a = n_dot_h * alpha;
    float k = alpha / (n_cross_h_sq + a * a);
    return k * k * (1.0F / kPi);
}

/// Height-correlated Smith masking and shadowing over 4 (n.l) (n.v) (Heitz 2014, eq. 99; glTF 2.0 B.3.3).
KERNEL float smith_visibility(float n_dot_l, float n_dot_v, float alpha) {
    float a2 = alpha * alpha;
    float masking = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0F - a2) + a2);
    float shadowing = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0F - a2) + a2);
    return 0.5F / (masking + shadowing);
}

/// Fresnel reflectance by Schlick 1994.
KERNEL vec3 schlick_fresnel(vec3 f0, float v_dot_h) {
    float m = clamp(1.0F - v_dot_h, 0.0F, 1.0F);
    float m2 = m * m;
    float m5 = m2 * m2 * m;
    return f0 + (vec3(1.0F) - f0) * m5;
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
    vec3 base = (vec3(1.0F) - f) * surface.diffuse * (1.0F / kPi);
    return (base + f * (v * d)) * n_dot_l;
}

/// Share of uniform light from everywhere that the surface sends to the viewer: the Fresnel term is taken at normal
/// incidence, so that a white surface reflects all of it.
KERNEL vec3 reflect_uniform_light(Reflectance surface) {
    return surface.f0 + (vec3(1.0F) - surface.f0) * surface.diffuse;
}

KERNEL_END
