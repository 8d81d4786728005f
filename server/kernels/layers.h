#pragma once

#include "server/kernels/brdf.h"
#include "server/kernels/sheen.h"

// What lies on a surface: sheen (KHR_materials_sheen) and on that a clear coat (KHR_materials_clearcoat). Surfaces
// without them never come here.
//
// A layer lets through what it does not reflect: T(mu) = 1 - albedo(mu). Lobes of the surface are scaled by the
// smaller of T(n.v) and T(n.l), as KHR_materials_sheen has it, which keeps light and view interchangeable and is exact
// for a mirror. Where a lobe is wide, light that left at a flatter angle is then missing. It was reflected back down:
// over metal it goes into a lobe of its own as the light between microfacets does, over a dielectric into the base.
// The base takes what is left, as in brdf.h: R(n.v) R(n.l) over the mean of R, R = T entry + missing (1 - entry), and
// what the sheen misses under a coat.
//
// White material under white layers then sends back, over all roughnesses and n.v >= .02 (layers_kernel_test): coated
// dielectrics .993 to 1.008, coated metal .992 to 1.014 (more than 1.01 only where a coat of roughness .2 lies on metal
// of roughness .15 seen at n.v = .08), dielectrics under sheen .983 to 1.009, metal under sheen .976 to 1.013, coated
// dielectrics with sheen .978 to 1.017.

KERNEL_BEGIN

const float kCoatF0 = 0.04F;  // ior 1.5, fixed by KHR_materials_clearcoat

/// Layers over a surface, as seen from one direction.
struct Layers {
    AlbedoCurves coat_curves;
    float coat;          ///< strength, 0..1
    float coat_scatter;  ///< multiple-scattering lobe of the coat per loss(n.l), 1/sr
    vec3 coat_entry;     ///< like Surface.entry, of a coat of strength 1
    float coat_passes;   ///< T of the coat for the view
    Sheen sheen;
    vec3 sheen_color;
    float sheen_strength;      ///< largest component of the colour
    float sheen_masking_view;  ///< Smith's Lambda of the view
    float passes;              ///< T of coat and sheen for the view
    vec3 base_per_left;        ///< the base per R(n.l), 1/sr
    vec4 missing;              ///< what wide lobes of the surface miss, see `missing_at`
    vec4 sheen_missing;        ///< and what the sheen misses under the coat
    vec3 return_per_missing;   ///< lobe that gives it back, per missing(n.l), 1/sr
    vec3 albedo;               ///< share of uniform light that everything sends to the viewer
};

/// Share of light that a coat of strength 1 lets through.
KERNEL float coat_entry_at(KERNEL_IN(Layers) layers, Albedos a) {
    return max(layers.coat_entry.x - layers.coat_entry.y * a.grazing - layers.coat_entry.z * a.loss, 0.0F);
}

/// Transmittances of layers in one direction.
struct LayerPassage {
    float coat;   ///< of the coat
    float all;    ///< of coat and sheen
    float sheen;  ///< share that the strongest component of the sheen reflects where nothing covers it
};

KERNEL LayerPassage layer_passage(KERNEL_IN(Layers) layers, Albedos coat, float cosine) {
    LayerPassage result;
    result.coat = 1.0F - layers.coat * (1.0F - coat_entry_at(layers, coat));
    result.sheen = layers.sheen_strength * sheen_albedo(layers.sheen, cosine);
    result.all = result.coat * (1.0F - result.sheen);
    return result;
}

/// Share of light that a microfacet lobe with a Fresnel term of one misses because layers let less through in some of
/// its directions than in the view's: the integral of lobe * max(T(view) - T(light), 0). A polynomial in t of degree 3
/// times t (1 - t), t = mu / (mu + .8 roughness), whose coefficients the two functions below give for a coat and for
/// white sheen; fitted to integrals as those in microfacet.h. `roughness` is the surface's.
KERNEL float missing_at(vec4 missing, float roughness, float cosine) {
    float t = cosine / (cosine + 0.8F * roughness);
    float p = missing.x + t * (missing.y + t * (missing.z + t * missing.w));
    return max(t * (1.0F - t) * p, 0.0F);
}

/// Of a coat of strength 1. Fitted under a smooth coat at 19 roughnesses and 23 cosines, where at most .053 is missing;
/// largest error .0037. A rougher coat's transmittance varies less with the angle, by a factor fitted at five
/// roughnesses.
KERNEL vec4 missing_under_coat(float roughness, float coat_roughness) {
    float q = roughness;
    float r = coat_roughness;
    float variation = 1.0796F + r * (-1.6447F + r * (-0.1642F + r * 0.8232F));
    return vec4(0.260617F + q * (-4.44926F + q * (17.4877F + q * (-23.2839F + q * 9.93001F))),
                -1.86168F + q * (35.8149F + q * (-158.914F + q * (227.724F - q * 102.242F))),
                3.42449F + q * (-62.762F + q * (334.425F + q * (-516.004F + q * 241.363F))),
                -2.0183F + q * (35.733F + q * (-226.264F + q * (369.894F - q * 178.579F)))) *
           variation;
}

/// Of sheen whose colour is 1. Fitted at 11 roughnesses of the surface, 10 of the sheen and 19 cosines, where at most
/// .135 is missing; largest error .0146. Nine tenths of it are returned, so that the error makes no light.
KERNEL vec4 missing_under_sheen(float roughness, float sheen_roughness) {
    float q = roughness;
    float s = sheen_roughness;
    vec4 constant = vec4(0.474F, -1.6009F, 2.8664F, -1.9854F) + vec4(-3.3591F, 14.243F, -21.688F, 11.162F) * s +
                    vec4(2.9218F, -12.454F, 18.535F, -9.0486F) * (s * s);
    vec4 linear = vec4(-2.3248F, 12.281F, -21.147F, 11.259F) + vec4(15.651F, -86.289F, 163.67F, -96.67F) * s +
                  vec4(-11.843F, 60.376F, -109.57F, 60.688F) * (s * s);
    vec4 square = vec4(2.3121F, -13.485F, 23.602F, -13.236F) + vec4(-14.207F, 85.495F, -167.23F, 106.54F) * s +
                  vec4(9.8718F, -51.872F, 87.688F, -42.734F) * (s * s);
    return (constant + linear * q + square * (q * q)) * 0.9F;
}

/// R: the share of light that a dielectric's base gets, from what its layers let through, what of that enters the base
/// at once, and what wide lobes miss. Sheen is as wide as a microfacet lobe of roughness 1.
KERNEL float left_to_base(KERNEL_IN(Layers) layers, LayerPassage passage, float entry, float missing, float cosine) {
    return passage.all * entry + missing * (1.0F - entry) +
           passage.sheen * missing_at(layers.sheen_missing, 1.0F, cosine);
}

/// What `make_layers` takes the means of over the hemisphere: x is the share of light that enters the base through
/// the layers, y what is missing under the coat.
KERNEL vec2 layer_mean(KERNEL_IN(Layers) layers, KERNEL_IN(Surface) surface, float roughness, float cosine) {
    LayerPassage passage = layer_passage(layers, albedos_at(layers.coat_curves, cosine), cosine);
    float missing = missing_at(layers.missing, roughness, cosine);
    float entry = base_entry(surface, albedos_at(surface.curves, cosine));
    return vec2(left_to_base(layers, passage, entry, missing, cosine), missing);
}

/// Coat and sheen over a surface, both as seen from the same direction: `n_dot_v` is its cosine to the surface's
/// normal, `coat_n_dot_v` that to the coat's. Roughnesses are perceptual.
KERNEL Layers make_layers(KERNEL_IN(Surface) surface, float n_dot_v, float coat, float coat_roughness,
                          float coat_n_dot_v, vec3 sheen_color, float sheen_roughness) {
    Layers result;
    float r = clamp(coat_roughness, kMinRoughness, 1.0F);
    Albedos mean = mean_albedos(r);
    float share = multiple_scattering_share(kCoatF0, 1.0F, mean.loss);
    result.coat = coat;
    result.coat_curves = make_albedo_curves(r);
    result.coat_entry = vec3(1.0F - kCoatF0, 1.0F - kCoatF0, share - kCoatF0);
    result.sheen = make_sheen(sheen_roughness);
    result.sheen_color = sheen_color;
    result.sheen_strength = max(sheen_color.x, max(sheen_color.y, sheen_color.z));

    float cosine = max(n_dot_v, 1.0e-4F);
    Albedos coat_seen = albedos_at(result.coat_curves, max(coat_n_dot_v, 1.0e-4F));
    LayerPassage seen = layer_passage(result, coat_seen, cosine);
    result.coat_passes = seen.coat;
    result.passes = seen.all;
    result.coat_scatter = coat * share * coat_seen.loss / (kPi * mean.loss);
    result.sheen_masking_view = sheen_masking(result.sheen, cosine);

    float q = sqrt(surface.curves.alpha);
    result.missing =
        missing_under_coat(q, r) * coat + missing_under_sheen(q, result.sheen.roughness) * result.sheen_strength;

    result.sheen_missing = missing_under_coat(1.0F, r) * coat;

    // Gauss's rule of five nodes for integrals of f(mu) 2 mu over 0..1.
    vec2 means = layer_mean(result, surface, q, 0.09853509F) * 0.03149583F +
                 layer_mean(result, surface, q, 0.30453573F) * 0.14781774F +
                 layer_mean(result, surface, q, 0.56202519F) * 0.29277397F +
                 layer_mean(result, surface, q, 0.80198658F) * 0.33434928F +
                 layer_mean(result, surface, q, 0.96019014F) * 0.19356318F;
    float missing = missing_at(result.missing, q, cosine);
    float entry = base_entry(surface, albedos_at(surface.curves, cosine));
    result.base_per_left = surface.base_albedo * (left_to_base(result, seen, entry, missing, cosine) /
                                                  (max(entry, 1.0e-4F) * kPi * max(means.x, 1.0e-4F)));
    result.return_per_missing = surface.mean_metal_albedo * (missing / (kPi * max(means.y, 1.0e-4F)));
    result.albedo = vec3(1.0F - seen.coat) + sheen_color * (seen.coat * sheen_albedo(result.sheen, cosine)) +
                    reflect_uniform_light(surface) * seen.all;
    return result;
}

/// `reflect_light` of a surface under layers. The coat has a normal of its own.
KERNEL vec3 reflect_light(KERNEL_IN(Surface) surface, KERNEL_IN(Layers) layers, vec3 normal, vec3 coat_normal,
                          vec3 view, vec3 light) {
    Bounce g = bounce_angles(normal, view, light);
    Bounce c = bounce_angles(coat_normal, view, light);
    Albedos coat_lit = albedos_at(layers.coat_curves, c.n_dot_l);
    LayerPassage lit = layer_passage(layers, coat_lit, g.n_dot_l);
    float coat_lobe =
        layers.coat * (kCoatF0 + (1.0F - kCoatF0) * schlick_weight(c.v_dot_h)) * ggx_lobe(c, layers.coat_curves.alpha) +
        layers.coat_scatter * coat_lit.loss;
    float sheen_lobe =
        reflect_sheen(layers.sheen, max(g.n_dot_l, 1.0e-4F), g.n_dot_v, g.n_cross_h_sq, layers.sheen_masking_view) *
        min(layers.coat_passes, lit.coat);
    Albedos a = albedos_at(surface.curves, g.n_dot_l);
    float missing = missing_at(layers.missing, sqrt(surface.curves.alpha), g.n_dot_l);
    vec3 under = specular_lobes(surface, g, a) * min(layers.passes, lit.all) +
                 layers.base_per_left * left_to_base(layers, lit, base_entry(surface, a), missing, g.n_dot_l) +
                 layers.return_per_missing * missing;
    return vec3(coat_lobe * c.n_dot_l) + (layers.sheen_color * sheen_lobe + under) * g.n_dot_l;
}

KERNEL_END
