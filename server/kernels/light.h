#pragma once

#include "protocol/gl/kernel_language.h"

KERNEL_BEGIN

/// A directional, point or spot light of KHR_lights_punctual, in one form for all three kinds.
struct Light {
    vec4 position;        ///< w = 1: world position; w = 0: unit direction towards a directional light
    vec3 direction;       ///< unit, along which a spot shines
    vec3 intensity;       ///< irradiance at w = 0, radiant intensity at w = 1
    float inverse_range;  ///< 1/m; 0: unlimited
    float spot_scale;     ///< 1 / (cos inner - cos outer); 0: no cone
    float spot_offset;    ///< -cos outer * scale; 1: no cone
    float radius;         ///< of a luminous sphere, m; of a sun, the sine of its angular radius; 0: a point
};

/// What a light, or one point of it, brings to a point.
struct LightSample {
    vec3 to_light;    ///< to the point of the light, or a unit vector towards a directional one
    vec3 direction;   ///< unit, towards the light
    vec3 irradiance;  ///< on a surface that faces the light, unshadowed
};

/// Distance and cone falloff of KHR_lights_punctual: max(min(1 - (d / range)^4, 1), 0) / d^2, and the square of the
/// clamped linear ramp between the cosines of the outer and the inner cone.
KERNEL LightSample sample_light(Light light, vec3 point) {
    LightSample result;
    result.to_light = vec3(light.position.x, light.position.y, light.position.z) - point * light.position.w;
    float distance_sq = max(dot(result.to_light, result.to_light), 1.0e-12F);
    result.direction = result.to_light * (1.0F / sqrt(distance_sq));
    float ratio_sq = distance_sq * light.inverse_range * light.inverse_range;
    float window = clamp(1.0F - ratio_sq * ratio_sq, 0.0F, 1.0F);
    float ramp = clamp(-dot(light.direction, result.direction) * light.spot_scale + light.spot_offset, 0.0F, 1.0F);
    float falloff = mix(1.0F, 1.0F / distance_sq, light.position.w);
    result.irradiance = light.intensity * (window * falloff * ramp * ramp);
    return result;
}

KERNEL_END
