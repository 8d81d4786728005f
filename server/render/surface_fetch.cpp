#include "server/render/surface_fetch.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Reads textures at a point, without a footprint. For holes and shadows.
class PointReader {
public:
    PointReader(const ShadingInstance& instance, const Corners& corners) : instance_(instance), corners_(corners) {}

    [[nodiscard]] vec4 operator()(const ShadingTexture& texture) {
        return look_up(texture.view, corners_.of(texture.uv));
    }
    [[nodiscard]] const ShadingInstance& instance() const { return instance_; }
    [[nodiscard]] const Corners& corners() const { return corners_; }

private:
    const ShadingInstance& instance_;
    const Corners& corners_;
};

/// Edges of the lanes' triangles in the world and in the texture coordinates of their first texture, and what follows.
struct FootprintLanes {
    LaneMask lanes = 0;
    Lanes3 edge1;
    Lanes3 edge2;
    Lanes<float> uv1_x;
    Lanes<float> uv1_y;
    Lanes<float> uv2_x;
    Lanes<float> uv2_y;
    Lanes<float> across_x;
    Lanes<float> across_y;
    Lanes<float> along_x;
    Lanes<float> along_y;

    [[nodiscard]] kernels::UvFootprint operator[](int lane) const {
        return {{across_x[lane], across_y[lane]}, {along_x[lane], along_y[lane]}};
    }
};

/// The uv coordinates that most textures of an instance use; null where it has no texture.
const vec2* first_uv(const ShadingInstance& instance) {
    if ((instance.features & kBaseColorTexture) != 0) return instance.base_color.uv;
    if ((instance.features & kMetallicRoughnessTexture) != 0) return instance.metallic_roughness.uv;
    if ((instance.features & kNormalTexture) != 0) return instance.normal_map.uv;
    return (instance.features & kEmissiveTexture) != 0 ? instance.emissive.uv : nullptr;
}

/// Where one lane was hit.
struct LanePlace {
    const ShadingInstance* instance;
    const InstancePlace* moved;  ///< null: the instance stands still
    Corners corners;

    [[nodiscard]] const glm::mat3& world_from_mesh() const {
        return moved == nullptr ? instance->world_from_mesh : moved->world_from_mesh;
    }
    [[nodiscard]] vec3 edge(unsigned from, unsigned to) const {
        return world_from_mesh() * (instance->position[to] - instance->position[from]);
    }
};

void gather_edges(const LanePlace& place, const vec2* uv, int lane, FootprintLanes& footprints) {
    const glm::uvec3& t = place.corners.index;
    footprints.lanes |= 1U << lane;
    footprints.edge1.set(lane, place.edge(t.x, t.y));
    footprints.edge2.set(lane, place.edge(t.x, t.z));
    const vec2 uv1 = uv[t.y] - uv[t.x];
    const vec2 uv2 = uv[t.z] - uv[t.x];
    footprints.uv1_x[lane] = uv1.x;
    footprints.uv1_y[lane] = uv1.y;
    footprints.uv2_x[lane] = uv2.x;
    footprints.uv2_y[lane] = uv2.y;
}

[[gnu::flatten]] void find_footprints(const HitPacket& hits, FootprintLanes& f) {
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const kernels::UvFootprint footprint =
            kernels::uv_footprint(hits.width_m[i], kernels::safe_normalize(hits.direction[i]), f.edge1[i], f.edge2[i],
                                  vec2(f.uv1_x[i], f.uv1_y[i]), vec2(f.uv2_x[i], f.uv2_y[i]));
        f.across_x[i] = footprint.across.x;
        f.across_y[i] = footprint.across.y;
        f.along_x[i] = footprint.along.x;
        f.along_y[i] = footprint.along.y;
    }
}

/// Reads textures under a ray's footprint.
class FootprintReader {
public:
    FootprintReader(const LanePlace& place, const HitPacket& hits, const FootprintLanes& footprints, int lane)
        : place_(place), hits_(hits), lane_(lane) {
        if (((footprints.lanes >> lane) & 1U) == 0) return;
        uv_ = first_uv(*place.instance);
        footprint_ = footprints[lane];
    }

    [[nodiscard]] vec4 operator()(const ShadingTexture& texture) {
        return look_up(texture.view, corners().of(texture.uv), footprint(texture.uv));
    }
    [[nodiscard]] NormalLookup normal(const ShadingTexture& texture) {
        return look_up_normal(texture.view, corners().of(texture.uv), footprint(texture.uv));
    }
    [[nodiscard]] const ShadingInstance& instance() const { return *place_.instance; }
    [[nodiscard]] const Corners& corners() const { return place_.corners; }

private:
    /// The packet's, or, of coordinates that few textures use, one of its own.
    [[nodiscard]] const kernels::UvFootprint& footprint(const vec2* uv) {
        if (uv == uv_) return footprint_;
        uv_ = uv;
        const glm::uvec3& t = corners().index;
        footprint_ =
            kernels::uv_footprint(hits_.width_m[lane_], kernels::safe_normalize(hits_.direction[lane_]),
                                  place_.edge(t.x, t.y), place_.edge(t.x, t.z), uv[t.y] - uv[t.x], uv[t.z] - uv[t.x]);
        return footprint_;
    }

    const LanePlace& place_;
    const HitPacket& hits_;
    int lane_;
    const vec2* uv_ = nullptr;
    kernels::UvFootprint footprint_{};
};

template <class Reader>
vec4 base_color(Reader& read) {
    const ShadingInstance& instance = read.instance();
    vec4 color = instance.material->base_color;
    if ((instance.features & kVertexColor) != 0) color *= read.corners().of(instance.color);
    if ((instance.features & kBaseColorTexture) != 0) color *= read(instance.base_color);
    return color;
}

template <class Reader>
float transmission_of(Reader& read) {
    const ShadingInstance& instance = read.instance();
    const bool textured = (instance.features & kTransmissionTexture) != 0;
    return instance.material->transmission * (textured ? read(instance.extension->transmission).x : 1.0F);
}

float coverage_of(const ShadingInstance& instance, float alpha) {
    return (instance.needs & kNeedBlending) != 0 ? glm::clamp(alpha, 0.0F, 1.0F) : 1.0F;
}

/// Tangent of a hit in world space.
vec4 tangent_at(const ShadingInstance& instance, const InstancePlace* place, const Corners& corners) {
    const vec4 tangent = corners.of(instance.tangent);
    if (place == nullptr) return tangent;
    return {kernels::safe_normalize(place->world_from_mesh * vec3(tangent)), tangent.w * place->handedness};
}

/// Where one lane's textures are read to.
class LaneFetch {
public:
    LaneFetch(const ShadingInstance& instance, const InstancePlace* place, FootprintReader& read, int lane,
              bool normal_roughness, SurfacePacket& surfaces)
        : instance_(instance),
          material_(*instance.material),
          place_(place),
          read_(read),
          lane_(lane),
          normal_roughness_(normal_roughness),
          surfaces_(surfaces) {}

    /// The rarer part of a plain material.
    void apply_textures() {
        if (has(kMetallicRoughnessTexture)) {
            const vec4 t = read_(instance_.metallic_roughness);
            surfaces_.roughness[lane_] *= t.y;
            surfaces_.metallic[lane_] *= t.z;
        }
        if (has(kEmissiveTexture)) {
            const vec4 t = read_(instance_.emissive);
            surfaces_.radiance.set(lane_, material_.emissive * vec3(t));
        }
        if (has(kNormalTexture)) {
            float roughness = surfaces_.roughness[lane_];
            surfaces_.normal.set(lane_, bend(instance_.normal_map, material_.normal_scale, roughness));
            surfaces_.roughness[lane_] = roughness;
        }
    }

    /// What extensions add. The normal is still the geometry's.
    void apply_extensions() {
        surfaces_.rich |= 1U << lane_;
        RichSurface& more = surfaces_.more[lane_];
        const ShadingExtension* extension = instance_.extension;
        float specular = material_.specular;
        vec3 color = material_.specular_color;
        if (has(kSpecularTexture)) specular *= read_(extension->specular).w;
        if (has(kSpecularColorTexture)) color *= vec3(read_(extension->specular_color));
        const float f0 = kernels::fresnel_f0(material_.ior);
        more.dielectric_f0 = glm::min(color * f0, vec3(1.0F)) * specular;
        more.dielectric_f90 = specular;
        if ((instance_.needs & kLayerNeeds) == 0) return;
        surfaces_.layered |= 1U << lane_;
        more.coat = material_.clearcoat;
        more.coat_roughness = material_.clearcoat_roughness;
        more.coat_normal = surfaces_.normal[lane_];
        more.sheen_color = material_.sheen_color;
        more.sheen_roughness = material_.sheen_roughness;
        more.coat_reflected = 0.0F;
        if (has(kClearcoatTexture)) more.coat *= read_(extension->clearcoat).x;
        if (has(kClearcoatRoughnessTexture)) more.coat_roughness *= read_(extension->clearcoat_roughness).y;
        if (has(kSheenColorTexture)) more.sheen_color *= vec3(read_(extension->sheen_color));
        if (has(kSheenRoughnessTexture)) more.sheen_roughness *= read_(extension->sheen_roughness).w;
        if (has(kClearcoatNormalTexture))
            more.coat_normal = bend(extension->clearcoat_normal, material_.clearcoat_normal_scale, more.coat_roughness);
    }

    /// What only lanes have from which paths branch.
    void apply_branching(float alpha) {
        surfaces_.branching |= 1U << lane_;
        surfaces_.coverage[lane_] = coverage_of(instance_, alpha);
        const bool transmits = (instance_.needs & (kNeedTransmission | kNeedRefraction)) != 0;
        surfaces_.transmission[lane_] = transmits ? transmission_of(read_) : 0.0F;
        surfaces_.reflected[lane_] = 0.0F;
    }

private:
    [[nodiscard]] bool has(Feature feature) const { return (instance_.features & feature) != 0; }

    /// Normal of a normal map over the lane's; the detail that the footprint averages widens the lobe.
    vec3 bend(const ShadingTexture& map, float scale, float& roughness) {
        const NormalLookup found = read_.normal(map);
        if (found.variance > 0.0F && normal_roughness_) {
            const float alpha = roughness * roughness;
            roughness = std::sqrt(std::min(std::sqrt(alpha * alpha + found.variance * scale * scale), 1.0F));
        }
        const vec3 normal = kernels::safe_normalize(surfaces_.normal[lane_]);
        const vec4 tangent = tangent_at(instance_, place_, read_.corners());
        return kernels::map_normal(normal, tangent, found.normal * 0.5F + 0.5F, scale);
    }

    const ShadingInstance& instance_;
    const Material& material_;
    const InstancePlace* place_;
    FootprintReader& read_;
    int lane_;
    bool normal_roughness_;
    SurfacePacket& surfaces_;
};

}  // namespace

vec4 base_color_at(const ShadingInstance& instance, const TriangleHit& hit) noexcept {
    const Corners corners{instance.triangle[hit.triangle], hit.u, hit.v};
    PointReader read(instance, corners);
    return base_color(read);
}

vec3 light_past(const ShadingInstance& instance, const TriangleHit& hit, float cosine) noexcept {
    const Corners corners{instance.triangle[hit.triangle], hit.u, hit.v};
    PointReader read(instance, corners);
    const vec4 color = base_color(read);
    const float coverage = coverage_of(instance, color.w);
    vec3 share(1.0F - coverage);
    if ((instance.needs & (kNeedTransmission | kNeedRefraction)) == 0) return share;
    float metallic = instance.material->metallic;
    if ((instance.features & kMetallicRoughnessTexture) != 0) metallic *= read(instance.metallic_roughness).z;
    const float reflectance = kernels::fresnel_dielectric(cosine, instance.material->ior);
    const bool thin = (instance.needs & kNeedTransmission) != 0;
    const float passes = thin ? kernels::pane_transmittance(reflectance) : 1.0F - reflectance;
    share += vec3(color) * (coverage * transmission_of(read) * (1.0F - metallic) * passes);
    return share;
}

void fetch_surfaces(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces) noexcept {
    constexpr std::uint32_t kTextured = kMetallicRoughnessTexture | kEmissiveTexture | kNormalTexture;
    constexpr std::uint32_t kRichNeeds = kNeedTransmission | kNeedRefraction | kNeedSpecular | kLayerNeeds;
    const ShadingInstance* instances = context.scene.instances().data();
    const bool animated = !context.pose.places.empty();
    std::array<LanePlace, kLaneCount> places;
    FootprintLanes footprints;
    LaneMask special = 0;  // lanes that are more than factors and vertex colours
    for_each_lane(hits.hit, [&](int lane) {
        const std::uint32_t index = hits.instance[lane];
        const ShadingInstance& instance = instances[index];
        const Material& material = *instance.material;
        LanePlace& place = places[static_cast<std::size_t>(lane)];
        place.instance = &instance;
        place.moved = animated && instance.moves ? &context.pose.places[index] : nullptr;
        place.corners = {instance.triangle[hits.triangle[lane]], hits.u[lane], hits.v[lane]};
        const vec3 normal = place.corners.of(instance.normal);
        surfaces.normal.set(lane, place.moved == nullptr ? normal : place.moved->normal_matrix * normal);
        surfaces.plane_extent_m[lane] =
            instance.plane_extent_m * (place.moved == nullptr ? 1.0F : place.moved->stretch);
        vec4 color = material.base_color;
        if ((instance.features & kVertexColor) != 0) color *= place.corners.of(instance.color);
        surfaces.base_color.set(lane, vec3(color));
        surfaces.metallic[lane] = material.metallic;
        surfaces.roughness[lane] = material.roughness;
        surfaces.radiance.set(lane, material.emissive);
        const std::uint32_t needs = instance.needs & context.needs;
        if ((instance.features & ~kVertexColor) == 0 && (needs & (kBranchingNeeds | kRichNeeds)) == 0) return;
        special |= 1U << lane;
        if (const vec2* uv = first_uv(instance)) gather_edges(place, uv, lane, footprints);
    });
    if (footprints.lanes != 0) find_footprints(hits, footprints);
    for_each_lane(special, [&](int lane) {
        const LanePlace& place = places[static_cast<std::size_t>(lane)];
        const ShadingInstance& instance = *place.instance;
        const std::uint32_t needs = instance.needs & context.needs;
        FootprintReader read(place, hits, footprints, lane);
        const vec4 color = base_color(read);
        surfaces.base_color.set(lane, vec3(color));
        LaneFetch fetch(instance, place.moved, read, lane, context.normal_roughness, surfaces);
        if ((instance.features & kUnlit) != 0) {
            surfaces.lit &= ~(1U << lane);
        } else {
            if ((needs & kRichNeeds) != 0) fetch.apply_extensions();
            if ((instance.features & kTextured) != 0) fetch.apply_textures();
        }
        if ((needs & kBranchingNeeds) != 0) fetch.apply_branching(color.w);
    });
}

}  // namespace macula
