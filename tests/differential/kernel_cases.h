#pragma once

#include "server/kernels/area_light.h"
#include "server/kernels/camera.h"
#include "server/kernels/color.h"
#include "server/kernels/shade.h"
#include "server/kernels/texture.h"

// What kernels_gl_test runs in C++ and in GLSL: every kernel of the tracer, on inputs made from random numbers.

KERNEL_BEGIN

/// Random numbers in 0..1.
struct KernelCase {
    vec4 a;
    vec4 b;
    vec4 c;
    vec4 d;
    vec4 e;
    vec4 f;
};

struct KernelResult {
    vec4 ray;      ///< direction; sRGB coding of a.x
    vec4 light;    ///< irradiance; distance to the light
    vec4 shading;  ///< radiance that the light causes; its green in uniform light
    vec4 surface;  ///< radiance that one point of it causes by a prepared surface; its green in uniform light
    vec4 layered;  ///< the same under coat and sheen
    vec4 soft;     ///< of one point of the light: irradiance, distance
    vec4 rect;     ///< of one point of a rectangle: irradiance, distance
    vec4 refract;  ///< direction behind an interface, and its reflectance
    vec4 normal;   ///< of a normal map; lift off the surface in units of its coordinates
    vec4 texel;    ///< bilinear and nearest lookups of an endless image
    vec4 display;  ///< codes of the three channels and alpha
};

KERNEL vec3 random_direction(float u, float v) {
    float z = 2.0F * u - 1.0F;
    float r = sqrt(max(1.0F - z * z, 0.0F));
    return vec3(r * cos(6.2831853F * v), r * sin(6.2831853F * v), z);
}

/// Texels whose value is continuous where the image repeats.
KERNEL vec4 test_texel(int x, int y) {
    return vec4(float(x * x), float(7 * y), float(x * y), 1.0F);
}

KERNEL vec4 test_lookup(Texture t, vec2 uv) {
    TexelFootprint p = texel_footprint(t, uv);
    return mix_texels(p, test_texel(p.x.x, p.y.x), test_texel(p.x.y, p.y.x), test_texel(p.x.x, p.y.y),
                      test_texel(p.x.y, p.y.y));
}

KERNEL KernelResult run_case(KernelCase k) {
    KernelResult result;
    mat3 axes = mat3(random_direction(k.a.x, k.a.y), random_direction(k.a.z, k.a.w), random_direction(k.b.x, k.b.y));
    vec3 ray = eye_ray_direction(axes, vec4(-1.4F, 1.25F, -1.48F, 1.46F), vec2(1512.0F, 1680.0F),
                                 vec2(k.b.z * 1512.0F, k.b.w * 1680.0F));
    result.ray = vec4(ray.x, ray.y, ray.z, srgb_from_linear(k.a.x));

    Light light;
    bool local = k.c.x > 0.3F;
    vec3 towards = random_direction(k.c.y, k.c.z);
    vec3 place = towards * (local ? 0.3F + 5.0F * k.c.w : 1.0F);
    light.position = vec4(place.x, place.y, place.z, local ? 1.0F : 0.0F);
    light.direction = random_direction(k.d.x, k.d.y);
    light.intensity = vec3(1.0F + k.d.z, 2.0F, 3.0F * k.d.w);
    light.inverse_range = k.d.z > 0.5F && local ? 0.2F : 0.0F;
    bool spot = k.d.w > 0.5F && local;
    light.spot_scale = spot ? 1.0F : 0.0F;
    light.spot_offset = spot ? 0.2F : 1.0F;
    LightSample s = sample_light(light, vec3(0.1F * k.a.x, 0.1F * k.a.y, 0.1F * k.a.z));
    result.light = vec4(s.irradiance.x, s.irradiance.y, s.irradiance.z, length(s.to_light));

    vec3 normal = random_direction(k.e.x, k.e.y);
    vec3 view = random_direction(k.e.z, k.e.w);
    view = dot(view, normal) < 0.0F ? view * -1.0F : view;
    Surface surface = make_surface(vec3(k.f.x, k.f.y, k.f.z), k.f.w, 0.2F + 0.8F * k.c.w, dot(normal, view));
    vec3 radiance = shade_light(surface, normal, normal, view, s);
    result.shading = vec4(radiance.x, radiance.y, radiance.z, reflect_uniform_light(surface).y);

    light.radius = local ? 0.2F * k.e.x : 0.1F * k.e.x;
    vec3 origin = vec3(0.1F * k.a.x, 0.1F * k.a.y, 0.1F * k.a.z);
    LightSample soft = sample_light(light, origin, vec2(k.b.x, k.b.y));
    result.soft = vec4(soft.irradiance.x, soft.irradiance.y, soft.irradiance.z, length(soft.to_light));
    Surface prepared = make_surface(vec3(k.f.x, k.f.y, k.f.z), k.f.w, 0.2F + 0.8F * k.c.w, vec3(0.08F * k.a.x), k.a.y,
                                    k.a.z, dot(normal, view));
    radiance = shade_light(prepared, normal, normal, view, soft);
    result.surface = vec4(radiance.x, radiance.y, radiance.z, reflect_uniform_light(prepared).y);

    vec3 coat_normal = safe_normalize(normal + random_direction(k.d.x, k.e.y) * 0.1F);
    Layers layers = make_layers(prepared, dot(normal, view), k.d.x, k.d.y, dot(coat_normal, view),
                                vec3(k.d.z, k.d.w, k.e.x), k.e.y);
    radiance = shade_light(prepared, layers, normal, normal, coat_normal, view, soft);
    result.layered = vec4(radiance.x, radiance.y, radiance.z, layers.albedo.y);

    RectangleLight lamp;
    lamp.center = towards * 2.0F;
    lamp.half_u = random_direction(k.d.x, k.d.y) * 0.5F;
    lamp.half_v = cross(lamp.half_u, random_direction(k.d.z, k.d.w));
    lamp.radiance = light.intensity;
    LightSample r = sample_light(
        lamp, origin, stratified_place(int(3.99F * k.c.x), 2, light_offset(int(9.0F * k.b.z), int(9.0F * k.b.w))));
    result.rect = vec4(r.irradiance.x, r.irradiance.y, r.irradiance.z, length(r.to_light));

    Refraction bent = refract_ray(view * -1.0F, normal, k.c.x > 0.5F ? 1.0F + k.a.x : 1.0F / (1.0F + k.a.x));
    result.refract = vec4(bent.direction.x, bent.direction.y, bent.direction.z, bent.reflectance);

    vec3 tangent = safe_normalize(cross(normal, random_direction(k.a.x, k.b.y)));
    vec3 bumped = map_normal(normal, vec4(tangent.x, tangent.y, tangent.z, k.a.w > 0.5F ? 1.0F : -1.0F),
                             vec3(k.f.x, k.f.y, 0.5F + 0.5F * k.f.z), 0.8F);
    vec3 lifted = leave_surface(vec3(100.0F * k.b.x), normal, 50.0F * k.b.y);
    result.normal = vec4(bumped.x, bumped.y, bumped.z, length(lifted - vec3(100.0F * k.b.x)));

    Texture t;
    t.uv_scale_rotation = vec4(1.5F, -0.5F, 0.25F, 2.0F);
    t.uv_offset = vec2(k.c.y, k.c.z);
    t.size_px = ivec2(3 + int(20.0F * k.d.x), 2 + int(9.0F * k.d.y));
    t.wrap = ivec2(int(2.99F * k.e.x), int(2.99F * k.e.y));
    t.nearest = 0;
    vec4 bilinear = test_lookup(t, vec2(8.0F * k.f.x - 4.0F, 8.0F * k.f.y - 4.0F));
    // Nearest lookups jump between texels, so that they are compared at texels' centres.
    t.uv_scale_rotation = vec4(1.0F, 0.0F, 0.0F, 1.0F);
    t.uv_offset = vec2(0.0F);
    t.nearest = 1;
    vec2 centre =
        vec2((floor(40.0F * k.f.z) - 19.5F) / float(t.size_px.x), (floor(40.0F * k.f.w) - 19.5F) / float(t.size_px.y));
    vec4 nearest = test_lookup(t, centre);
    result.texel = vec4(bilinear.x, bilinear.y, nearest.x, nearest.y);

    uint code = srgb8_from_linear(vec3(k.a.y, 1.5F * k.a.z - 0.2F, k.a.w * k.a.w * k.a.w));
    result.display =
        vec4(float(code & 255U), float((code >> 8U) & 255U), float((code >> 16U) & 255U), float(code >> 24U));
    return result;
}

KERNEL_END
