#pragma once

#include "server/kernels/brdf.h"

// What one ray needs to stand for a lobe. The radiance that it finds, averaged over the lobe's width, is weighted
// by the surface's `specular_albedo` (the split sum of Karis 2013 with the light between microfacets added): in a
// uniform environment the result is exact.

KERNEL_BEGIN

/// Direction of a mirror's reflection; `view` is unit and towards the viewer.
KERNEL vec3 mirror_direction(vec3 view, vec3 normal) {
    return normal * (2.0F * dot(normal, view)) - view;
}

/// Mean direction of the light that a GGX lobe sends to the viewer, unit: between mirror direction and normal, because
/// masking hides what grazes (fit of Lagarde and de Rousiers 2014, "Moving Frostbite to PBR", 4.9.3).
KERNEL vec3 dominant_direction(vec3 normal, vec3 mirrored, float alpha) {
    float smoothness = clamp(1.0F - alpha, 0.0F, 1.0F);
    vec3 direction = mix(normal, mirrored, smoothness * (sqrt(smoothness) + alpha));
    return direction * (1.0F / sqrt(max(dot(direction, direction), 1.0e-12F)));
}

/// Tangent of the half angle of the cone that stands for a lobe. Half of a GGX lobe's normals, weighted by their
/// cosine, lie within atan(alpha) of the surface's (their share within an angle a is tan^2 a / (alpha^2 + tan^2 a)),
/// and what a normal that leans by a reflects leans by 2 a: tan 2a = 2 alpha / (1 - alpha^2). At most 8, 83 degrees.
KERNEL float lobe_half_width_tan(float alpha) {
    return min(2.0F * alpha / max(1.0F - alpha * alpha, 1.0e-6F), 8.0F);
}

KERNEL_END
