#include "server/render/surface_fetch.h"

#include "server/kernels/fresnel.h"
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

float transmission_of(const ShadingInstance& instance, const Corners& corners) {
    float share = instance.material->transmission;
    if ((instance.features & kTransmissionTexture) != 0) share *= look_up(instance.extension->transmission, corners).x;
    return share;
}

/// The rarer part of a material, for lanes whose instance has more than a base colour.
void apply_textures(const ShadingInstance& instance, const InstancePlace* place, const Corners& corners, int lane,
                    SurfacePacket& surfaces) {
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
        vec4 tangent = corners.of(instance.tangent);
        if (place != nullptr)
            tangent =
                vec4(kernels::safe_normalize(place->world_from_mesh * vec3(tangent)), tangent.w * place->handedness);
        surfaces.normal.set(lane, kernels::map_normal(normal, tangent, vec3(t), material.normal_scale));
    }
}

/// What only lanes have from which rays go on.
void fetch_branching(const ShadingInstance& instance, const Corners& corners, float alpha, int lane,
                     SurfacePacket& surfaces) {
    surfaces.branching |= 1U << lane;
    surfaces.coverage[lane] = (instance.needs & kNeedBlending) != 0 ? glm::clamp(alpha, 0.0F, 1.0F) : 1.0F;
    const bool transmits = (instance.needs & (kNeedTransmission | kNeedRefraction)) != 0;
    surfaces.transmission[lane] = transmits ? transmission_of(instance, corners) : 0.0F;
    surfaces.reflected[lane] = 0.0F;
}

}  // namespace

vec4 base_color_at(const ShadingInstance& instance, const TriangleHit& hit) noexcept {
    return base_color(instance, {instance.triangle[hit.triangle], hit.u, hit.v});
}

vec3 light_past(const ShadingInstance& instance, const TriangleHit& hit, float cosine) noexcept {
    const Corners corners{instance.triangle[hit.triangle], hit.u, hit.v};
    const vec4 color = base_color(instance, corners);
    const float coverage = (instance.needs & kNeedBlending) != 0 ? glm::clamp(color.w, 0.0F, 1.0F) : 1.0F;
    vec3 share(1.0F - coverage);
    if ((instance.needs & (kNeedTransmission | kNeedRefraction)) == 0) return share;
    float metallic = instance.material->metallic;
    if ((instance.features & kMetallicRoughnessTexture) != 0)
        metallic *= look_up(instance.metallic_roughness, corners).z;
    const float reflectance = kernels::fresnel_dielectric(cosine, instance.material->ior);
    const bool thin = (instance.needs & kNeedTransmission) != 0;
    const float passes = thin ? kernels::pane_transmittance(reflectance) : 1.0F - reflectance;
    share += vec3(color) * (coverage * transmission_of(instance, corners) * (1.0F - metallic) * passes);
    return share;
}

void fetch_surfaces(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces) noexcept {
    const ShadingInstance* instances = context.scene.instances().data();
    const bool animated = !context.pose.places.empty();
    for_each_lane(hits.hit, [&](int lane) {
        const std::uint32_t index = hits.instance[lane];
        const ShadingInstance& instance = instances[index];
        const Material& material = *instance.material;
        const Corners corners{instance.triangle[hits.triangle[lane]], hits.u[lane], hits.v[lane]};
        const InstancePlace* place = animated && instance.moves ? &context.pose.places[index] : nullptr;
        const vec3 normal = corners.of(instance.normal);
        surfaces.normal.set(lane, place == nullptr ? normal : place->normal_matrix * normal);
        const vec4 color = base_color(instance, corners);
        surfaces.base_color.set(lane, vec3(color));
        surfaces.metallic[lane] = material.metallic;
        surfaces.roughness[lane] = material.roughness;
        surfaces.radiance.set(lane, material.emissive);
        constexpr std::uint32_t kRare = kMetallicRoughnessTexture | kEmissiveTexture | kNormalTexture | kUnlit;
        if ((instance.features & kRare) != 0) {
            if ((instance.features & kUnlit) != 0) {
                surfaces.lit &= ~(1U << lane);
            } else {
                apply_textures(instance, place, corners, lane, surfaces);
            }
        }
        if ((instance.needs & context.needs & kBranchingNeeds) != 0)
            fetch_branching(instance, corners, color.w, lane, surfaces);
    });
}

}  // namespace macula
