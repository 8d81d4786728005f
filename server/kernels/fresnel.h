#pragma once

#include "server/kernels/powers.h"

// What an interface between two media reflects, what it lets through, and where to. An interface is described by
// `eta`, the index of refraction behind it over that before it.

KERNEL_BEGIN

/// Reflectance of a dielectric at normal incidence; `ior` is its index over that of air, or any `eta`.
KERNEL float fresnel_f0(float ior) {
    float r = (ior - 1.0F) / (ior + 1.0F);
    return r * r;
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

/// Unpolarised reflectance of a dielectric interface, exact (Cook and Torrance 1982, in terms of the cosine that
/// Snell's law gives times eta); 1 under total internal reflection. `cosine` is the angle of incidence's, 0..1.
KERNEL float fresnel_dielectric(float cosine, float eta) {
    float c = clamp(cosine, 0.0F, 1.0F);
    float g_sq = eta * eta - 1.0F + c * c;
    float g = sqrt(max(g_sq, 0.0F));
    float sum = g + c;
    float across = (eta * eta - 1.0F) / max(sum * sum, 1.0e-12F);  // (g - c) / (g + c) without its cancellation
    float along = (c * sum - 1.0F) / (c * (eta * eta - 1.0F) / max(sum, 1.0e-6F) + 1.0F);
    return min(0.5F * across * across * (1.0F + along * along) + (g_sq > 0.0F ? 0.0F : 1.0F), 1.0F);
}

/// A ray's way through an interface.
struct Refraction {
    vec3 direction;     ///< unit; behind the interface, or mirrored where `reflectance` is 1
    float reflectance;  ///< exact Fresnel; 1 under total internal reflection
};

/// Snell's law. `direction` is unit and goes with the light or ray towards the interface, `normal` is unit and on the
/// side that the ray comes from.
KERNEL Refraction refract_ray(vec3 direction, vec3 normal, float eta) {
    float cosine = clamp(-dot(direction, normal), 0.0F, 1.0F);
    float scale = 1.0F / eta;
    float cosine_behind_sq = 1.0F - scale * scale * (1.0F - cosine * cosine);
    bool passes = cosine_behind_sq > 0.0F;
    float along = passes ? scale : 1.0F;
    float turn_behind = scale * cosine - sqrt(max(cosine_behind_sq, 0.0F));
    float turn = passes ? turn_behind : 2.0F * cosine;
    vec3 chosen = direction * along + normal * turn;
    Refraction result;
    result.direction = chosen * (1.0F / sqrt(max(dot(chosen, chosen), 1.0e-30F)));
    float reflectance = fresnel_dielectric(cosine, eta);
    result.reflectance = passes ? reflectance : 1.0F;  // the two agree except for rounding at the critical angle
    return result;
}

/// Share of light that passes a clear pane with parallel faces, each of which reflects `reflectance`: the light that
/// goes to and fro inside is summed, (1 - R)^2 (1 + R^2 + R^4 + ...) = (1 - R) / (1 + R). The pane reflects the rest.
KERNEL float pane_transmittance(float reflectance) {
    return (1.0F - reflectance) / (1.0F + reflectance);
}

/// Absorption coefficient, 1/m, of a medium in which white light takes `color` after `distance_m`
/// (KHR_materials_volume). 0 where the distance is not positive or infinite: a clear medium. For loading, not per ray.
KERNEL vec3 absorption_per_m(vec3 color, float distance_m) {
    vec3 density = log(max(color, vec3(1.0e-6F))) * -1.0F;
    float scale = distance_m > 0.0F ? 1.0F / distance_m : 0.0F;
    return max(density, vec3(0.0F)) * scale;
}

/// Share of light left after `path_m` in a medium (Beer and Lambert's law).
KERNEL vec3 beer_transmittance(vec3 absorption, float path_m) {
    vec3 depth = absorption * path_m;
    return vec3(exp_near(-depth.x), exp_near(-depth.y), exp_near(-depth.z));
}

KERNEL_END
