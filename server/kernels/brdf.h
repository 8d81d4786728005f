#pragma once

#include "server/kernels/fresnel.h"
#include "server/kernels/microfacet.h"

// The metallic-roughness reflectance of glTF 2.0, Appendix B, without its losses and gains: a GGX microfacet lobe with
// height-correlated Smith masking and Schlick's Fresnel term; a lobe for the light that bounces between microfacets
// (Kulla and Conty 2017, "Revisiting physically based shading at Imageworks"), which single scattering loses; and a
// Lambert base that receives what both leave. A white surface reflects all light, whatever its roughness, and light
// and view are interchangeable.

KERNEL_BEGIN

/// Specular reflectance of a dielectric at normal incidence (glTF 2.0 B.3.5).
const float kDielectricF0 = 0.04F;

/// A surface as seen from one direction: all that its reflectance needs to know except the light's direction. Made
/// once per hit, read once per light.
struct Surface {
    vec3 f0;    ///< specular reflectance at normal incidence
    float f90;  ///< and at grazing incidence
    AlbedoCurves curves;
    vec3 scatter;            ///< multiple-scattering lobe per loss(n.l), 1/sr
    vec3 base;               ///< Lambert base per entry(n.l), 1/sr
    vec3 entry;              ///< share of light that enters the base: x - y grazing(n.l) - z loss(n.l)
    vec3 specular_albedo;    ///< share of uniform light that the lobes send to the viewer
    vec3 base_albedo;        ///< and that the base sends
    vec3 mean_metal_albedo;  ///< specular_albedo of the metallic share alone, mean over views weighted by their cosines
};

/// Colour of the light that leaves the microfacets after more than one bounce, as a share of what single scattering
/// with a Fresnel term of one loses: the geometric series of Kulla and Conty 2017 over the mean Fresnel reflectance.
KERNEL vec3 multiple_scattering_color(vec3 f0, float f90, float mean_loss) {
    vec3 mean = f0 + (vec3(f90) - f0) * (1.0F / 21.0F);
    return mean * mean * (1.0F - mean_loss) / (vec3(1.0F) - mean * mean_loss);
}
KERNEL float multiple_scattering_share(float f0, float f90, float mean_loss) {
    float mean = f0 + (f90 - f0) * (1.0F / 21.0F);
    return mean * mean * (1.0F - mean_loss) / (1.0F - mean * mean_loss);
}

/// A metallic-roughness surface. `dielectric_f0` and `dielectric_f90` are those of its dielectric part
/// (KHR_materials_ior, KHR_materials_specular), `base_color` that of metal and base, `opacity` the share of light
/// entering the dielectric that stays in its base instead of being transmitted (KHR_materials_transmission: 1 -
/// transmission). `n_dot_v` is the cosine of the view; one that a bent normal turns away counts as grazing. Light
/// that enters a base under coloured specular is what the colour's largest component leaves, as the extension has it.
KERNEL Surface make_surface(vec3 base_color, float metallic, float roughness, vec3 dielectric_f0, float dielectric_f90,
                            float opacity, float n_dot_v) {
    float r = clamp(roughness, kMinRoughness, 1.0F);
    float dielectric = 1.0F - metallic;
    float strongest_f0 = max(dielectric_f0.x, max(dielectric_f0.y, dielectric_f0.z));
    Surface s;
    s.f0 = dielectric_f0 * dielectric + base_color * metallic;
    s.f90 = dielectric_f90 * dielectric + metallic;
    s.curves = make_albedo_curves(r);
    Albedos mean = mean_albedos(r);
    Albedos seen = albedos_at(s.curves, max(n_dot_v, 1.0e-4F));

    vec3 metal_color = multiple_scattering_color(base_color, 1.0F, mean.loss);
    vec3 color =
        multiple_scattering_color(dielectric_f0, dielectric_f90, mean.loss) * dielectric + metal_color * metallic;
    s.scatter = color * (seen.loss / (kPi * mean.loss));
    s.mean_metal_albedo =
        (base_color * (1.0F - mean.loss - mean.grazing) + vec3(mean.grazing) + metal_color * mean.loss) * metallic;
    s.specular_albedo = s.f0 * (1.0F - seen.loss - seen.grazing) + vec3(s.f90 * seen.grazing) + color * seen.loss;

    float share = multiple_scattering_share(strongest_f0, dielectric_f90, mean.loss);
    s.entry = vec3(1.0F - strongest_f0, dielectric_f90 - strongest_f0, share - strongest_f0);
    float seen_entry = max(s.entry.x - s.entry.y * seen.grazing - s.entry.z * seen.loss, 0.0F);
    float mean_entry = s.entry.x - s.entry.y * mean.grazing - s.entry.z * mean.loss;
    s.base_albedo = base_color * (dielectric * opacity * seen_entry);
    s.base = s.base_albedo * (1.0F / (kPi * max(mean_entry, 1.0e-4F)));
    return s;
}

/// A plain surface of glTF 2.0 (B.3.5): dielectrics reflect 4 %, metals their base colour.
KERNEL Surface make_surface(vec3 base_color, float metallic, float roughness, float n_dot_v) {
    return make_surface(base_color, metallic, roughness, vec3(kDielectricF0), 1.0F, 1.0F, n_dot_v);
}

/// Angles of one light at a surface.
struct Bounce {
    float n_dot_l;       ///< 0 where the light is behind
    float n_dot_v;       ///< at least 1e-4: a view that a bent normal turns away counts as grazing
    float n_dot_h;       ///< to the half vector
    float n_cross_h_sq;  ///< squared sine to the half vector
    float v_dot_h;
};

KERNEL Bounce bounce_angles(vec3 normal, vec3 view, vec3 light) {
    vec3 sum = light + view;
    vec3 h = sum * (1.0F / sqrt(max(dot(sum, sum), 1.0e-12F)));
    vec3 n_cross_h = cross(normal, h);
    Bounce result;
    result.n_dot_l = max(dot(normal, light), 0.0F);
    result.n_dot_v = max(dot(normal, view), 1.0e-4F);
    result.n_dot_h = max(dot(normal, h), 0.0F);
    result.n_cross_h_sq = dot(n_cross_h, n_cross_h);
    result.v_dot_h = dot(view, h);
    return result;
}

/// GGX lobe of single scattering with a Fresnel term of one, 1/sr.
KERNEL float ggx_lobe(Bounce b, float alpha) {
    return ggx_distribution(b.n_dot_h, b.n_cross_h_sq, alpha) *
           smith_visibility(max(b.n_dot_l, 1.0e-4F), b.n_dot_v, alpha);
}

/// Both lobes of the microfacets, 1/sr; `lit` are the surface's albedos at n.l.
KERNEL vec3 specular_lobes(KERNEL_IN(Surface) surface, Bounce b, Albedos lit) {
    vec3 f = surface.f0 + (vec3(surface.f90) - surface.f0) * schlick_weight(b.v_dot_h);
    return f * ggx_lobe(b, surface.curves.alpha) + surface.scatter * lit.loss;
}

/// Share of light that enters the base from the direction that `lit` is for.
KERNEL float base_entry(KERNEL_IN(Surface) surface, Albedos lit) {
    return max(surface.entry.x - surface.entry.y * lit.grazing - surface.entry.z * lit.loss, 0.0F);
}

/// Reflectance distribution times n.l, 1/sr: radiance towards `view`, for which the surface was made, per irradiance
/// that `light` brings to a surface that faces it. All vectors are unit and point away from the surface; 0 where
/// n.l <= 0.
KERNEL vec3 reflect_light(KERNEL_IN(Surface) surface, vec3 normal, vec3 view, vec3 light) {
    Bounce b = bounce_angles(normal, view, light);
    Albedos lit = albedos_at(surface.curves, b.n_dot_l);
    return (specular_lobes(surface, b, lit) + surface.base * base_entry(surface, lit)) * b.n_dot_l;
}

/// Share of uniform light from everywhere that the surface sends to the viewer.
KERNEL vec3 reflect_uniform_light(KERNEL_IN(Surface) surface) {
    return surface.specular_albedo + surface.base_albedo;
}

KERNEL_END
