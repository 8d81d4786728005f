#pragma once

#include "server/kernels/brdf.h"
#include "server/kernels/sheen.h"

// What lies on a surface: sheen (KHR_materials_sheen) and on that a clear coat (KHR_materials_clearcoat). Surfaces
// without them never come here.
//
// A layer lets through what it does not reflect: T(mu) = 1 - albedo(mu). Lobes of the surface are scaled by the
// smaller of T(n.v) and T(n.l), as KHR_materials_sheen has it, which keeps light and view interchangeable and is exact
// for a mirror. Where a lobe is wide, light that left at a flatter angle is then missing; it goes into a lobe of its
// own as the light between microfacets does. The Lambert base is scaled by T(n.v) T(n.l) over the mean instead, which
// is exact.

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
    vec3 base_per_entry;       ///< the surface's base per T(n.l) entry(n.l), 1/sr
    float missing0;            ///< what a narrow coat takes from the surface's lobe, as a polynomial
    float missing1;
    float missing2;
    float missing3;
    vec3 return_per_missing;  ///< lobe that gives it back, per missing(n.l), 1/sr
    vec3 albedo;              ///< share of uniform light that everything sends to the viewer
};

/// Share of light that a coat of strength 1 lets through.
KERNEL float coat_entry_at(KERNEL_IN(Layers) layers, Albedos a) {
    return layers.coat_entry.x - layers.coat_entry.y * a.grazing - layers.coat_entry.z * a.loss;
}

/// Transmittances of layers in one direction.
struct LayerPassage {
    float coat;  ///< of the coat
    float all;   ///< of coat and sheen
};

KERNEL LayerPassage layer_passage(KERNEL_IN(Layers) layers, Albedos coat, float cosine) {
    LayerPassage result;
    result.coat = 1.0F - layers.coat * (1.0F - coat_entry_at(layers, coat));
    result.all = result.coat * (1.0F - layers.sheen_strength * sheen_albedo(layers.sheen, cosine));
    return result;
}

/// Share of light that a lobe of Fresnel term one reflects, but not into directions for which the coat lets as much
/// through as for this one. Polynomial fitted to integrals over 19 roughnesses and 23 cosines under a smooth coat,
/// with t = mu / (mu + .8 roughness); largest error .0051.
KERNEL float missing_under_coat(KERNEL_IN(Layers) layers, float roughness, float cosine) {
    float t = cosine / (cosine + 0.8F * roughness);
    float p = layers.missing0 + t * (layers.missing1 + t * (layers.missing2 + t * layers.missing3));
    return max(t * (1.0F - t) * p, 0.0F);
}

/// What `make_layers` takes the means of over the hemisphere: x is the share of light that enters the base through
/// the layers, y what is missing under the coat.
KERNEL vec2 layer_mean(KERNEL_IN(Layers) layers, KERNEL_IN(Surface) surface, float roughness, float cosine) {
    LayerPassage passage = layer_passage(layers, albedos_at(layers.coat_curves, cosine), cosine);
    float entry = base_entry(surface, albedos_at(surface.curves, cosine));
    return vec2(passage.all * entry, missing_under_coat(layers, roughness, cosine));
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
    result.missing0 = -0.0057946F + q * (-1.1201F + q * (4.4796F - q * 3.5243F));
    result.missing1 = 0.31473F + q * (4.1583F + q * (-30.309F + q * 27.713F));
    result.missing2 = -1.1375F + q * (6.8139F + q * (46.626F - q * 55.551F));
    result.missing3 = 1.0254F + q * (-11.724F + q * (-25.508F + q * 38.004F));

    // Gauss's rule of five nodes for integrals of f(mu) 2 mu over 0..1.
    vec2 means = layer_mean(result, surface, q, 0.09853509F) * 0.03149583F +
                 layer_mean(result, surface, q, 0.30453573F) * 0.14781774F +
                 layer_mean(result, surface, q, 0.56202519F) * 0.29277397F +
                 layer_mean(result, surface, q, 0.80198658F) * 0.33434928F +
                 layer_mean(result, surface, q, 0.96019014F) * 0.19356318F;
    result.base_per_entry = surface.base_albedo * (seen.all / (kPi * max(means.x, 1.0e-4F)));
    // A rougher coat's transmittance varies less with the angle: by this share, fitted at five roughnesses.
    float variation = coat * (1.0796F + r * (-1.6447F + r * (-0.1642F + r * 0.8232F)));
    vec3 color = surface.f0 + (vec3(surface.f90) - surface.f0) * (1.0F / 21.0F);
    result.return_per_missing =
        color * (variation * missing_under_coat(result, q, cosine) / (kPi * max(means.y, 1.0e-4F)));
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
    vec3 under = specular_lobes(surface, g, a) * min(layers.passes, lit.all) +
                 layers.base_per_entry * (base_entry(surface, a) * lit.all) +
                 layers.return_per_missing * missing_under_coat(layers, sqrt(surface.curves.alpha), g.n_dot_l);
    return vec3(coat_lobe * c.n_dot_l) + (layers.sheen_color * sheen_lobe + under) * g.n_dot_l;
}

KERNEL_END
