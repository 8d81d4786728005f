#include "server/render/packet_shading.h"

#include <algorithm>

#include "server/kernels/area_light.h"
#include "server/kernels/color.h"
#include "server/kernels/fresnel.h"
#include "server/kernels/shade.h"
#include "server/render/surface_fetch.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;

/// Where and how the surfaces lie.
void orient(const HitPacket& hits, SurfacePacket& surfaces) {
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const vec3 direction = hits.direction[i];
        const float length = std::sqrt(glm::dot(direction, direction));
        const vec3 view = direction * (-1.0F / length);
        const vec3 front = hits.geometric_normal[i];
        const float side = glm::dot(front, direction) > 0.0F ? -1.0F : 1.0F;
        const vec3 geometric_normal = kernels::safe_normalize(front * side);
        const vec3 position = hits.origin[i] + direction * hits.distance[i];
        surfaces.view.set(i, view);
        surfaces.geometric_normal.set(i, geometric_normal);
        surfaces.normal.set(i, kernels::safe_normalize(surfaces.normal[i] * side));
        const float path_m = std::max(hits.distance[i] * length, surfaces.plane_extent_m[i]);
        surfaces.position.set(i, kernels::leave_surface(position, geometric_normal, path_m));
    }
}

/// Surfaces of plain materials.
[[gnu::flatten]] void prepare_plain(SurfacePacket& surfaces) {
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const float n_dot_v = glm::dot(surfaces.normal[i], surfaces.view[i]);
        surfaces.surface.set(
            i, kernels::make_surface(surfaces.base_color[i], surfaces.metallic[i], surfaces.roughness[i], n_dot_v));
    }
}

/// Surfaces of lanes whose material has more than plain ones.
void prepare_rich(SurfacePacket& surfaces) {
    for_each_lane(surfaces.rich, [&](int lane) {
        RichSurface& more = surfaces.more[lane];
        const vec3 view = surfaces.view[lane];
        const bool branches = ((surfaces.branching >> lane) & 1U) != 0;
        const float opacity = branches ? 1.0F - surfaces.transmission[lane] : 1.0F;
        const float n_dot_v = glm::dot(surfaces.normal[lane], view);
        const kernels::Surface surface =
            kernels::make_surface(surfaces.base_color[lane], surfaces.metallic[lane], surfaces.roughness[lane],
                                  more.dielectric_f0, more.dielectric_f90, opacity, n_dot_v);
        surfaces.surface.set(lane, surface);
        if (((surfaces.layered >> lane) & 1U) == 0) return;
        const float side = glm::dot(more.coat_normal, view) < 0.0F ? -1.0F : 1.0F;
        more.coat_normal = more.coat_normal * side;
        more.layers = kernels::make_layers(surface, n_dot_v, more.coat, more.coat_roughness,
                                           glm::dot(more.coat_normal, view), more.sheen_color, more.sheen_roughness);
    });
}

/// Which share of their specular light rays bring.
void share_reflections(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces) {
    for_each_lane(surfaces.branching & surfaces.lit, [&](int lane) {
        const bool layered = ((surfaces.layered >> lane) & 1U) != 0;
        RichSurface& more = surfaces.more[lane];
        const float seen = hits.share[lane] * surfaces.coverage[lane];
        const bool may_reflect = ((hits.may_reflect >> lane) & 1U) != 0;
        if (layered && may_reflect)
            more.coat_reflected = glossy_share(more.coat_roughness) *
                                  traced_share((1.0F - more.layers.coat_passes) * seen, context.bounce_bound);
        if (surfaces.transmission[lane] > 0.0F) {
            surfaces.reflected[lane] = 1.0F;  // the exact split between reflection and refraction is that of the rays
        } else if (may_reflect) {
            const vec3 albedo = surfaces.surface.specular_albedo[lane] * (layered ? more.layers.passes : 1.0F);
            const float share = std::max({albedo.x, albedo.y, albedo.z}) * seen;
            surfaces.reflected[lane] =
                glossy_share(surfaces.roughness[lane]) * traced_share(share, context.bounce_bound);
        }
    });
}

/// Light that a glossy lobe of this albedo brings from all around.
vec3 glossy_light(const ShadingContext& context, const vec3& view, const vec3& normal, float roughness,
                  const vec3& albedo) {
    vec3 radiance = context.scene.scene().ambient_radiance;
    if (const EnvironmentMap* environment = context.scene.environment())
        radiance += environment->glossy_radiance(kernels::mirror_direction(view, normal), roughness);
    return radiance * albedo;
}

/// Light from all around at one lane, less what reflected rays bring.
vec3 surrounding_light_at(const ShadingContext& context, const SurfacePacket& surfaces, int lane) {
    const bool branches = ((surfaces.branching >> lane) & 1U) != 0;
    const bool layered = ((surfaces.layered >> lane) & 1U) != 0;
    const vec3 view = surfaces.view[lane];
    const vec3 normal = surfaces.normal[lane];
    vec3 specular = surfaces.surface.specular_albedo[lane];
    vec3 matt = surfaces.surface.base_albedo[lane];
    vec3 light(0.0F);
    if (layered) {
        const RichSurface& more = surfaces.more[lane];
        const vec3 coat(1.0F - more.layers.coat_passes);
        // Sheen reflects nearly as matt surfaces do.
        matt = more.layers.albedo - coat - specular * more.layers.passes;
        specular *= more.layers.passes;
        light +=
            glossy_light(context, view, more.coat_normal, more.coat_roughness, coat * (1.0F - more.coat_reflected));
    }
    if (branches) specular *= 1.0F - surfaces.reflected[lane];
    light += glossy_light(context, view, normal, surfaces.roughness[lane], specular);
    vec3 all_around = context.scene.scene().ambient_radiance;
    if (const EnvironmentMap* environment = context.scene.environment())
        all_around += environment->irradiance(normal) * (1.0F / kernels::kPi);
    return light + all_around * matt;
}

/// Light from all around, less what reflected rays bring.
void add_surrounding_light(const ShadingContext& context, SurfacePacket& surfaces) {
    const LaneMask special = context.scene.environment() != nullptr ? 0xFFFFU : (surfaces.branching | surfaces.layered);
    const vec3 ambient = context.scene.scene().ambient_radiance;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const vec3 albedo = surfaces.surface.base_albedo[i] + surfaces.surface.specular_albedo[i];
        const float plain = ((special >> i) & 1U) != 0 ? 0.0F : 1.0F;
        surfaces.radiance.set(i, surfaces.radiance[i] + ambient * albedo * plain);
    }
    for_each_lane(special & surfaces.lit, [&](int lane) {
        surfaces.radiance.set(lane, surfaces.radiance[lane] + surrounding_light_at(context, surfaces, lane));
    });
}

/// Irradiance and directions into radiance, for whichever kind of light.
template <class Sample>
[[gnu::flatten]] void evaluate(const SurfacePacket& surfaces, const SurfaceLanes& lobes, LightPacket& shine,
                               Sample&& sample_at) {
    Lanes<float> sum;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const kernels::LightSample sample = sample_at(i);
        const vec3 radiance =
            kernels::shade_light(lobes[i], surfaces.geometric_normal[i], surfaces.normal[i], surfaces.view[i], sample);
        shine.to_light.set(i, sample.to_light);
        shine.radiance.set(i, radiance);
        sum[i] = radiance.x + radiance.y + radiance.z;
    }
    for_each_lane(surfaces.layered & surfaces.lit, [&](int lane) {
        const RichSurface& more = surfaces.more[lane];
        const kernels::LightSample sample = sample_at(lane);
        const vec3 radiance =
            kernels::shade_light(lobes[lane], more.layers, surfaces.geometric_normal[lane], surfaces.normal[lane],
                                 more.coat_normal, surfaces.view[lane], sample);
        shine.radiance.set(lane, radiance);
        sum[lane] = radiance.x + radiance.y + radiance.z;
    });
    LaneMask lanes = 0;
    for (int i = 0; i < kLaneCount; ++i) lanes |= static_cast<LaneMask>(sum[i] > 0.0F) << i;
    shine.lanes = lanes & surfaces.lit;
}

}  // namespace

void SurfaceLanes::set(int lane, const kernels::Surface& s) {
    f0.set(lane, s.f0);
    f90[lane] = s.f90;
    const kernels::AlbedoCurves& c = s.curves;
    curves[0][lane] = c.alpha;
    curves[1][lane] = c.p0;
    curves[2][lane] = c.p1;
    curves[3][lane] = c.p2;
    curves[4][lane] = c.p3;
    curves[5][lane] = c.p4;
    curves[6][lane] = c.q0;
    curves[7][lane] = c.q1;
    curves[8][lane] = c.q2;
    curves[9][lane] = c.q3;
    curves[10][lane] = c.q4;
    scatter.set(lane, s.scatter);
    base.set(lane, s.base);
    entry.set(lane, s.entry);
    specular_albedo.set(lane, s.specular_albedo);
    base_albedo.set(lane, s.base_albedo);
}

kernels::Surface SurfaceLanes::operator[](int lane) const {
    kernels::Surface s{};
    s.f0 = f0[lane];
    s.f90 = f90[lane];
    s.curves = {curves[0][lane], curves[1][lane], curves[2][lane], curves[3][lane], curves[4][lane], curves[5][lane],
                curves[6][lane], curves[7][lane], curves[8][lane], curves[9][lane], curves[10][lane]};
    s.scatter = scatter[lane];
    s.base = base[lane];
    s.entry = entry[lane];
    s.specular_albedo = specular_albedo[lane];
    s.base_albedo = base_albedo[lane];
    return s;
}

void find_surfaces(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces) noexcept {
    // Lanes that missed compute too: with zeros, not with garbage that may be denormal.
    surfaces.branching = 0;
    surfaces.rich = 0;
    surfaces.layered = 0;
    surfaces.plane_extent_m = Lanes<float>{};
    surfaces.normal = Lanes3{};
    surfaces.base_color = Lanes3{};
    surfaces.metallic = Lanes<float>{};
    surfaces.roughness = Lanes<float>{};
    surfaces.radiance = Lanes3{};
    surfaces.lit = hits.hit;
    fetch_surfaces(context, hits, surfaces);
    orient(hits, surfaces);
    prepare_plain(surfaces);
    if (surfaces.rich != 0) prepare_rich(surfaces);
    if (surfaces.branching != 0) share_reflections(context, hits, surfaces);
    add_surrounding_light(context, surfaces);
    for_each_lane(hits.hit & ~surfaces.lit, [&](int lane) { surfaces.radiance.set(lane, surfaces.base_color[lane]); });
    for_each_lane(~hits.hit & hits.traced, [&](int lane) {
        const bool has_map = context.scene.environment() != nullptr;
        surfaces.radiance.set(lane,
                              background_light(context, hits.direction[lane], has_map ? hits.spread[lane] : 0.0F));
    });
}

void shine(const ShadingLight& light, const SurfacePacket& surfaces, const SurfaceLanes& lobes,
           LightPacket& shine) noexcept {
    evaluate(surfaces, lobes, shine, [&](int i) { return kernels::sample_light(light.light, surfaces.position[i]); });
}

void shine(const ShadingLight& light, const SurfacePacket& surfaces, const SurfaceLanes& lobes,
           const LightPlaces& places, LightPacket& shine) noexcept {
    if (light.is_rectangle) {
        evaluate(surfaces, lobes, shine, [&](int i) {
            return kernels::sample_light(light.rectangle, surfaces.position[i], vec2(places.x[i], places.y[i]));
        });
    } else {
        evaluate(surfaces, lobes, shine, [&](int i) {
            return kernels::sample_light(light.light, surfaces.position[i], vec2(places.x[i], places.y[i]));
        });
    }
}

SurfaceLanes without_reflected(const SurfacePacket& surfaces) noexcept {
    SurfaceLanes lobes = surfaces.surface;
    for_each_lane(surfaces.branching & surfaces.lit, [&](int lane) {
        const float rest = 1.0F - surfaces.reflected[lane];
        lobes.f0.set(lane, lobes.f0[lane] * rest);
        lobes.f90[lane] *= rest;
        lobes.scatter.set(lane, lobes.scatter[lane] * rest);
    });
    return lobes;
}

void add_light(const LightPacket& light, LaneMask reached, float scale, SurfacePacket& surfaces) noexcept {
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const bool add = ((reached >> i) & 1U) != 0;
        surfaces.radiance.x[i] += add ? scale * light.radiance.x[i] : 0.0F;
        surfaces.radiance.y[i] += add ? scale * light.radiance.y[i] : 0.0F;
        surfaces.radiance.z[i] += add ? scale * light.radiance.z[i] : 0.0F;
    }
}

void encode(const Lanes3& radiance, float exposure, Lanes<std::uint32_t>& color) noexcept {
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) color[i] = kernels::srgb8_from_linear(radiance[i] * exposure);
}

vec3 background_light(const ShadingContext& context, const vec3& direction, float spread) noexcept {
    const EnvironmentMap* environment = context.scene.environment();
    return environment != nullptr ? environment->radiance(direction, spread)
                                  : context.scene.scene().background_radiance;
}

vec3 surrounding_light(const ShadingContext& context, const vec3& direction, float spread) noexcept {
    vec3 radiance = context.scene.scene().ambient_radiance;
    if (const EnvironmentMap* environment = context.scene.environment())
        radiance += environment->radiance(direction, spread);
    return radiance;
}

}  // namespace macula
