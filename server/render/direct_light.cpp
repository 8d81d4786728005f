#include "server/render/direct_light.h"

#include <bit>

#include "server/kernels/area_light.h"
#include "server/render/ray_filters.h"
#include "server/render/ray_packet.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;

/// Needs of surfaces that let shadow rays pass and change their light.
constexpr std::uint32_t kColoredShadows = kNeedBlending | kNeedTransmission | kNeedRefraction;

/// Shadow rays to points of a light with an extent end this share of the way before it: what lies there may be the
/// surface that shines.
constexpr float kBeforeLight = 0.999F;

class ShadowRays {
public:
    ShadowRays(const ShadingContext& context, RayTap* tap, TraceCounts& counts)
        : context_(context), tap_(tap), counts_(counts) {}

    /// Lanes of `light` in whose way nothing stands. What lets light pass takes its share of the light's radiance.
    LaneMask reaching(const SurfacePacket& surfaces, LightPacket& light, float far) const;

private:
    const ShadingContext& context_;
    RayTap* tap_;
    TraceCounts& counts_;
};

LaneMask free_lanes(const RTCRay16& rays) {
    LaneMask free = 0;  // Embree sets tfar of occluded rays to minus infinity
    for (int i = 0; i < kLaneCount; ++i) free |= static_cast<LaneMask>(rays.tfar[i] >= 0.0F) << i;
    return free;
}

/// Traces rays that may be coloured, and colours the light.
LaneMask trace_colored(RTCScene tree, const Lanes<int>& valid, RTCRay16& rays, float far, LightPacket& light) {
    LightQuery query;
    init_query(query.context);
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const vec3 direction = light.to_light[i];
        query.length_m[i] = std::sqrt(glm::dot(direction, direction));
        rays.id[i] = static_cast<unsigned>(i);
    }
    occluded_coherent(valid.value, tree, query.context, rays);
    const LaneMask free = free_lanes(rays) & light.lanes;
    for_each_lane(free & query.colored,
                  [&](int lane) { light.radiance.set(lane, light.radiance[lane] * light_through(query, lane, far)); });
    return free;
}

LaneMask ShadowRays::reaching(const SurfacePacket& surfaces, LightPacket& light, float far) const {
    RTCRay16 rays;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) set_ray(rays, i, surfaces.position[i], light.to_light[i], far);
    const Lanes<int> valid = valid_lanes(light.lanes);
    counts_.shadow += static_cast<unsigned>(std::popcount(light.lanes));
    if (tap_ != nullptr) tap_->packet(RayTap::Kind::shadow, valid.value, rays.org_x, rays.dir_x, rays.tfar);
    if ((context_.needs & kColoredShadows) != 0) return trace_colored(context_.pose.tree, valid, rays, far, light);
    occluded_coherent(valid.value, context_.pose.tree, rays);
    return free_lanes(rays) & light.lanes;
}

/// By how much each lane's samples are moved around the light.
LightPlaces place_offsets(const Lanes<std::uint32_t>& pixel) {
    LightPlaces offset;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const vec2 place =
            kernels::light_offset(static_cast<int>(pixel[i] & 0xFFFFU), static_cast<int>(pixel[i] >> 16U));
        offset.x[i] = place.x;
        offset.y[i] = place.y;
    }
    return offset;
}

class LightLoop {
public:
    LightLoop(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces, RayTap* tap,
              TraceCounts& counts)
        : context_(context), hits_(hits), surfaces_(surfaces), shadows_(context, tap, counts), counts_(counts) {}

    void add(const ShadingLight& light, const SurfaceLanes& lobes) {
        if (light.has_extent) {
            add_extended(light, lobes);
            return;
        }
        LightPacket lighting;
        shine(light, surfaces_, lobes, lighting);
        const bool local = light.light.position.w > 0.0F;
        finish(light, lighting, local ? 1.0F : kUnlimited, 1.0F);
    }

private:
    void add_extended(const ShadingLight& light, const SurfaceLanes& lobes) {
        const int side = context_.light_samples_side;
        const LightPlaces offset = place_offsets(hits_.pixel);
        const bool local = light.is_rectangle || light.light.position.w > 0.0F;
        for (int sample = 0; sample < side * side; ++sample) {
            LightPlaces places;
            MACULA_LANE_LOOP
            for (int i = 0; i < kLaneCount; ++i) {
                const vec2 place = kernels::stratified_place(sample, side, vec2(offset.x[i], offset.y[i]));
                places.x[i] = place.x;
                places.y[i] = place.y;
            }
            LightPacket lighting;
            shine(light, surfaces_, lobes, places, lighting);
            finish(light, lighting, local ? kBeforeLight : kUnlimited, 1.0F / static_cast<float>(side * side));
        }
    }

    void finish(const ShadingLight& light, LightPacket& lighting, float far, float scale) {
        if (light.casts_shadow) counts_.skipped_shadow += std::popcount(surfaces_.lit & ~lighting.lanes);
        if (lighting.lanes == 0) return;
        const LaneMask reached = light.casts_shadow ? shadows_.reaching(surfaces_, lighting, far) : lighting.lanes;
        add_light(lighting, reached, scale, surfaces_);
    }

    const ShadingContext& context_;
    const HitPacket& hits_;
    SurfacePacket& surfaces_;
    ShadowRays shadows_;
    TraceCounts& counts_;
};

}  // namespace

void add_lights(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces, RayTap* tap,
                TraceCounts& counts) noexcept {
    if (surfaces.lit == 0) return;
    LightLoop loop(context, hits, surfaces, tap, counts);
    const bool reflects = (surfaces.branching & surfaces.lit) != 0;
    for (const ShadingLight& light : context.pose.lights) {
        if (light.is_seen && reflects) {
            loop.add(light, without_reflected(surfaces));
        } else {
            loop.add(light, surfaces.surface);
        }
    }
}

}  // namespace macula
