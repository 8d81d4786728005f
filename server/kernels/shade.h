#pragma once

#include "server/kernels/layers.h"
#include "server/kernels/light.h"

KERNEL_BEGIN

/// Value at the barycentric coordinates (u, v) of a triangle whose first corner has weight 1 - u - v.
KERNEL vec3 interpolate(vec3 a, vec3 b, vec3 c, float u, float v) {
    return a * (1.0F - u - v) + b * u + c * v;
}
KERNEL vec2 interpolate(vec2 a, vec2 b, vec2 c, float u, float v) {
    return a * (1.0F - u - v) + b * u + c * v;
}
KERNEL vec4 interpolate(vec4 a, vec4 b, vec4 c, float u, float v) {
    return a * (1.0F - u - v) + b * u + c * v;
}

/// Unit vector along v, which may be zero or tiny: then the result is short instead of undefined.
KERNEL vec3 safe_normalize(vec3 v) {
    return v * (1.0F / sqrt(max(dot(v, v), 1.0e-30F)));
}

/// Shading normal of a tangent-space normal map (glTF 2.0, 3.9.3): `texel` is the raw 0..1 value, whose green axis
/// points along the bitangent cross(normal, tangent) * tangent.w.
KERNEL vec3 map_normal(vec3 normal, vec4 tangent, vec3 texel, float scale) {
    vec3 t = vec3(tangent.x, tangent.y, tangent.z);
    vec3 bitangent = cross(normal, t) * tangent.w;
    vec3 m = texel * 2.0F - vec3(1.0F);
    return safe_normalize(t * (m.x * scale) + bitangent * (m.y * scale) + normal * m.z);
}

/// Where a ray that leaves a hit starts, so that it cannot meet the surface it leaves. A hit position is wrong by
/// a few units in the last place of its coordinates and of the `path`, the metres that the eye's ray went; the step
/// along the geometric normal covers twice that. `geometric_normal` is unit and on the side of the viewer.
KERNEL vec3 leave_surface(vec3 position, vec3 geometric_normal, float path) {
    vec3 magnitude = abs(position);
    float largest = max(max(magnitude.x, magnitude.y), max(magnitude.z, path));
    return position + geometric_normal * (largest * 4.8e-7F);
}

/// Radiance towards `view`, for which the surface was made, that one light causes, unshadowed. Light that the flat
/// surface turns away from does not count even where the interpolated normal would see it: the surface itself shadows
/// it.
KERNEL vec3 shade_light(KERNEL_IN(Surface) surface, vec3 geometric_normal, vec3 normal, vec3 view, LightSample light) {
    vec3 reflected = reflect_light(surface, normal, view, light.direction) * light.irradiance;
    return dot(geometric_normal, light.direction) > 0.0F ? reflected : vec3(0.0F);
}

/// The same of a surface under layers.
KERNEL vec3 shade_light(KERNEL_IN(Surface) surface, KERNEL_IN(Layers) layers, vec3 geometric_normal, vec3 normal,
                        vec3 coat_normal, vec3 view, LightSample light) {
    vec3 reflected = reflect_light(surface, layers, normal, coat_normal, view, light.direction) * light.irradiance;
    return dot(geometric_normal, light.direction) > 0.0F ? reflected : vec3(0.0F);
}

KERNEL_END
