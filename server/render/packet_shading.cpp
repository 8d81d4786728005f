#include "server/render/packet_shading.h"

#include "server/kernels/color.h"
#include "server/kernels/shade.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;

/// A hit's corner indices and barycentric coordinates.
struct Corners {
    glm::uvec3 index;
    float u;
    float v;

    template <class T>
    [[nodiscard]] T of(const T* attribute) const {
        return kernels::interpolate(attribute[index.x], attribute[index.y], attribute[index.z], u, v);
    }
};

vec4 look_up(const ShadingTexture& texture, const Corners& corners) {
    return look_up(texture.view, corners.of(texture.uv));
}

vec4 base_color(const ShadingInstance& instance, const Corners& corners) {
    vec4 color = instance.material->base_color;
    if ((instance.features & kVertexColor) != 0) color *= corners.of(instance.color);
    if ((instance.features & kBaseColorTexture) != 0) color *= look_up(instance.base_color, corners);
    return color;
}

/// The rarer part of a material, for lanes whose instance has more than a base colour.
void apply_textures(const ShadingInstance& instance, const Corners& corners, int lane, SurfacePacket& surfaces) {
    const Material& material = *instance.material;
    if ((instance.features & kMetallicRoughnessTexture) != 0) {
        const vec4 t = look_up(instance.metallic_roughness, corners);
        surfaces.roughness[lane] *= t.y;
        surfaces.metallic[lane] *= t.z;
    }
    if ((instance.features & kEmissiveTexture) != 0) {
        const vec4 t = look_up(instance.emissive, corners);
        surfaces.radiance.set(lane, material.emissive * vec3(t));
    }
    if ((instance.features & kNormalTexture) != 0) {
        const vec3 normal = kernels::safe_normalize(surfaces.normal[lane]);
        const vec4 t = look_up(instance.normal_map, corners);
        surfaces.normal.set(lane,
                            kernels::map_normal(normal, corners.of(instance.tangent), vec3(t), material.normal_scale));
    }
}

/// Reads what is scattered in memory: attributes, factors and textures. `radiance` holds emission afterwards.
void fetch(const ShadingScene& scene, const HitPacket& hits, SurfacePacket& surfaces) {
    const ShadingInstance* instances = scene.instances().data();
    for_each_lane(hits.hit, [&](int lane) {
        const ShadingInstance& instance = instances[hits.instance[lane]];
        const Material& material = *instance.material;
        const Corners corners{instance.triangle[hits.triangle[lane]], hits.u[lane], hits.v[lane]};
        surfaces.normal.set(lane, corners.of(instance.normal));
        surfaces.base_color.set(lane, vec3(base_color(instance, corners)));
        surfaces.metallic[lane] = material.metallic;
        surfaces.roughness[lane] = material.roughness;
        surfaces.radiance.set(lane, material.emissive);
        constexpr std::uint32_t kRare = kMetallicRoughnessTexture | kEmissiveTexture | kNormalTexture | kUnlit;
        if ((instance.features & kRare) == 0) return;
        if ((instance.features & kUnlit) != 0) {
            surfaces.lit &= ~(1U << lane);
        } else {
            apply_textures(instance, corners, lane, surfaces);
        }
    });
}

}  // namespace

vec4 base_color_at(const ShadingInstance& instance, std::uint32_t triangle, float u, float v) noexcept {
    return base_color(instance, {instance.triangle[triangle], u, v});
}

void find_surfaces(const ShadingScene& scene, const HitPacket& hits, SurfacePacket& surfaces) noexcept {
    surfaces = SurfacePacket{};  // lanes that missed compute too: with zeros, not with garbage that may be denormal
    surfaces.lit = hits.hit;
    fetch(scene, hits, surfaces);

    const vec3 ambient = scene.scene().ambient_radiance;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const vec3 direction = hits.direction[i];
        const float length = std::sqrt(glm::dot(direction, direction));
        const vec3 view = direction * (-1.0F / length);
        const vec3 front = hits.geometric_normal[i];
        const float side = glm::dot(front, direction) > 0.0F ? -1.0F : 1.0F;
        const vec3 geometric_normal = kernels::safe_normalize(front * side);
        const vec3 position = hits.origin + direction * hits.distance[i];
        surfaces.view.set(i, view);
        surfaces.geometric_normal.set(i, geometric_normal);
        surfaces.normal.set(i, kernels::safe_normalize(surfaces.normal[i] * side));
        surfaces.position.set(i, kernels::leave_surface(position, geometric_normal, hits.distance[i] * length));
        const kernels::Reflectance reflectance =
            kernels::make_reflectance(surfaces.base_color[i], surfaces.metallic[i], surfaces.roughness[i]);
        surfaces.radiance.set(i, surfaces.radiance[i] + ambient * kernels::reflect_uniform_light(reflectance));
    }
    for_each_lane(hits.hit & ~surfaces.lit, [&](int lane) { surfaces.radiance.set(lane, surfaces.base_color[lane]); });
    for_each_lane(~hits.hit & 0xFFFFU,
                  [&](int lane) { surfaces.radiance.set(lane, scene.scene().background_radiance); });
}

void shine(const kernels::Light& light, const SurfacePacket& surfaces, LightPacket& shine) noexcept {
    Lanes<float> sum;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const kernels::LightSample sample = kernels::sample_light(light, surfaces.position[i]);
        const kernels::Reflectance reflectance =
            kernels::make_reflectance(surfaces.base_color[i], surfaces.metallic[i], surfaces.roughness[i]);
        const vec3 radiance = kernels::shade_light(reflectance, surfaces.geometric_normal[i], surfaces.normal[i],
                                                   surfaces.view[i], sample);
        shine.to_light.set(i, sample.to_light);
        shine.radiance.set(i, radiance);
        sum[i] = radiance.x + radiance.y + radiance.z;
    }
    LaneMask lanes = 0;
    for (int i = 0; i < kLaneCount; ++i) lanes |= static_cast<LaneMask>(sum[i] > 0.0F) << i;
    shine.lanes = lanes & surfaces.lit;
}

void add_light(const LightPacket& light, LaneMask reached, SurfacePacket& surfaces) noexcept {
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const bool add = ((reached >> i) & 1U) != 0;
        surfaces.radiance.x[i] += add ? light.radiance.x[i] : 0.0F;
        surfaces.radiance.y[i] += add ? light.radiance.y[i] : 0.0F;
        surfaces.radiance.z[i] += add ? light.radiance.z[i] : 0.0F;
    }
}

void encode(const SurfacePacket& surfaces, float exposure, Lanes<std::uint32_t>& color) noexcept {
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) color[i] = kernels::srgb8_from_linear(surfaces.radiance[i] * exposure);
}

}  // namespace macula
