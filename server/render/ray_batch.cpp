#include "server/render/ray_batch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "server/kernels/camera.h"
#include "server/kernels/fresnel.h"
#include "server/render/direct_light.h"
#include "server/render/ray_packet.h"
#include "server/render/secondary_rays.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;

/// Needs for which rays know how wide their footprint is.
constexpr std::uint32_t kFootprintNeeds = kNeedTextures | kNeedNormalMaps | kNeedEnvironment | kBranchingNeeds;

/// Most rays that one hit sends on: past it, off its base, off its coat, through it.
constexpr std::size_t kChildren = 4;

/// Paths have at most this many rays in a row.
constexpr std::size_t kLongestPath = kLayerBound + 8;

LaneMask first_lanes(std::size_t count) {
    return (1U << count) - 1U;
}

/// Rays through the places of up to 16 addresses: `sample_px` in its pixel, or where the plan says, moved by what
/// sample_px is off the centre. Lanes without an address get rays too, which are not traced.
void aim(const Camera& camera, const SamplePlan& plan, const vec2& sample_px, std::span<const std::uint32_t> addresses,
         RTCRayHit16& rays, HitPacket& hits) {
    Lanes<float> x{};
    Lanes<float> y{};
    for (int i = 0; i < static_cast<int>(addresses.size()); ++i) {
        const SamplePosition p = plan.position[addresses[static_cast<std::size_t>(i)]];
        x[i] = static_cast<float>(p.x_px) + sample_px.x;
        y[i] = static_cast<float>(p.y_px) + sample_px.y;
    }
    if (!plan.place.empty()) {
        for (int i = 0; i < static_cast<int>(addresses.size()); ++i) {
            const PlaceInPixel place = plan.place[addresses[static_cast<std::size_t>(i)]];
            x[i] += static_cast<float>(place.x) / 256.0F - 0.5F;
            y[i] += static_cast<float>(place.y) / 256.0F - 0.5F;
        }
    }
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const vec3 direction =
            kernels::eye_ray_direction(camera.world_from_eye, camera.edges, camera.size_px, vec2(x[i], y[i]));
        hits.origin.set(i, camera.origin);
        hits.direction.set(i, direction);
        set_ray(rays, i, camera.origin, direction);
    }
}

void read_hits(const RTCRayHit16& rays, LaneMask traced, HitPacket& hits) {
    hits.traced = traced;
    hits.hit = 0;
    for (int i = 0; i < kLaneCount; ++i)
        hits.hit |= static_cast<LaneMask>(rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) << i;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        hits.distance[i] = rays.ray.tfar[i];
        hits.geometric_normal.x[i] = rays.hit.Ng_x[i];
        hits.geometric_normal.y[i] = rays.hit.Ng_y[i];
        hits.geometric_normal.z[i] = rays.hit.Ng_z[i];
        hits.u[i] = rays.hit.u[i];
        hits.v[i] = rays.hit.v[i];
        hits.instance[i] = rays.hit.geomID[i];
        hits.triangle[i] = rays.hit.primID[i];
    }
}

/// Embree reports the normals of moving instances in mesh space.
void turn_normals(const ShadingContext& context, HitPacket& hits) {
    if (context.pose.places.empty()) return;
    for_each_lane(hits.hit, [&](int lane) {
        const std::uint32_t instance = hits.instance[lane];
        if (!context.scene.instances()[instance].moves) return;
        hits.geometric_normal.set(lane, context.pose.places[instance].front_normal(hits.geometric_normal[lane]));
    });
}

float light_of(const vec3& radiance) {
    return radiance.x + radiance.y + radiance.z;
}

}  // namespace

Camera::Camera(const EyeView& view)
    : world_from_eye(glm::mat3_cast(view.world_from_eye.orientation)),
      origin(view.world_from_eye.position_m),
      edges(view.tangents.left, view.tangents.right, view.tangents.bottom, view.tangents.top),
      size_px(view.width_px, view.height_px),
      pixel_tangent(std::sqrt((edges.y - edges.x) * (edges.w - edges.z) / (size_px.x * size_px.y))) {}

BatchMemory::BatchMemory() : stack(kChildren * (kBatchSamples + kWaveRays * kLongestPath)), wave(kWaveRays) {}

void RayBatch::trace(std::size_t first) noexcept {
    const std::vector<std::uint32_t>& order = task_.plan->trace_order;
    const std::size_t count = std::min<std::size_t>(kBatchSamples, order.size() - first);
    const auto batch = std::span(order).subspan(first, count);
    const auto packet = [&](std::size_t slot) {
        return batch.subspan(slot, std::min<std::size_t>(kLaneCount, count - slot));
    };
    for (std::size_t slot = 0; slot < count; slot += kLaneCount) trace_eye_rays(slot, packet(slot));
    if ((frame_.shading.needs & kBranchingNeeds) == 0) return;
    while (!memory_.stack.empty()) {
        const std::span<SecondaryRay> wave(memory_.wave);
        trace_wave(wave.first(memory_.stack.pop(wave)));
    }
    for (std::size_t slot = 0; slot < count; slot += kLaneCount) store(packet(slot), slot);
}

void RayBatch::trace_eye_rays(std::size_t first_in_batch, std::span<const std::uint32_t> addresses) {
    const ShadingContext& shading = frame_.shading;
    const SamplePlan& plan = *task_.plan;
    RTCRayHit16 rays;
    HitPacket hits;
    aim(camera_, plan, task_.sample_px, addresses, rays, hits);
    const LaneMask traced = first_lanes(addresses.size());
    const Lanes<int> valid = valid_lanes(traced);
    counts_.primary += addresses.size();
    if (frame_.tap != nullptr)
        frame_.tap->packet(RayTap::Kind::primary, valid.value, rays.ray.org_x, rays.ray.dir_x, rays.ray.tfar);
    intersect_coherent(valid.value, shading.pose.tree, rays);
    read_hits(rays, traced, hits);
    turn_normals(shading, hits);

    if ((shading.needs & kFootprintNeeds) != 0) {
        Lanes<float> spacing{};
        for (int i = 0; i < static_cast<int>(addresses.size()); ++i)
            spacing[i] = plan.spacing_px(addresses[static_cast<std::size_t>(i)]);
        const float tangent = camera_.pixel_tangent * task_.footprint_scale;
        MACULA_LANE_LOOP
        for (int i = 0; i < kLaneCount; ++i) {
            const vec3 direction = hits.direction[i];
            hits.width_m[i] = spacing[i] * tangent * hits.distance[i];
            hits.spread[i] = spacing[i] * tangent / std::sqrt(glm::dot(direction, direction));
        }
    }
    if ((shading.needs & kNeedSoftShadows) != 0) {
        for (int i = 0; i < static_cast<int>(addresses.size()); ++i) {
            const SamplePosition p = plan.position[addresses[static_cast<std::size_t>(i)]];
            hits.pixel[i] = static_cast<std::uint16_t>(p.x_px) |
                            static_cast<std::uint32_t>(static_cast<std::uint16_t>(p.y_px)) << 16U;
        }
    }
    const bool branching = (shading.needs & kBranchingNeeds) != 0;
    hits.may_reflect = branching && frame_.bounces > 0 ? traced : 0U;
    if (branching) {
        MACULA_LANE_LOOP
        for (int i = 0; i < kLaneCount; ++i) hits.share[i] = 1.0F;
    }

    SurfacePacket surfaces;
    find_surfaces(shading, hits, surfaces);
    add_lights(shading, hits, surfaces, frame_.tap, counts_);

    Samples& samples = *task_.samples;
    for (int i = 0; i < static_cast<int>(addresses.size()); ++i) {
        const std::uint32_t address = addresses[static_cast<std::size_t>(i)];
        const bool hit = ((hits.hit >> i) & 1U) != 0;
        samples.inverse_depth_per_m[address] = hit ? 1.0F / hits.distance[i] : 0.0F;
        samples.object_id[address] = hit ? hits.instance[i] + 1U : 0U;
    }
    if (!branching) {
        store_color(addresses, surfaces.radiance);
        if (samples.keep_image_depth) {
            for (const std::uint32_t address : addresses)
                samples.image_inverse_depth_per_m[address] = samples.inverse_depth_per_m[address];
        }
        return;
    }

    if (surfaces.branching != 0) {
        std::array<RayPath, kLaneCount> path;
        for_each_lane(surfaces.branching, [&](int lane) {
            RayPath& p = path[static_cast<std::size_t>(lane)];
            p.spread = hits.spread[lane];
            p.slot = static_cast<std::uint32_t>(first_in_batch) + static_cast<std::uint32_t>(lane);
            p.bounces = static_cast<std::uint8_t>(frame_.bounces);
        });
        if ((shading.needs & kNeedAbsorption) != 0) absorb_before_eye(hits, path, surfaces.branching);
        send_rays(shading, hits, surfaces, path, surfaces.radiance, memory_.stack, counts_);
        for_each_lane(surfaces.branching, [&](int lane) {
            const vec3 share = path[static_cast<std::size_t>(lane)].throughput;
            surfaces.radiance.set(lane, surfaces.radiance[lane] * share);
        });
    }
    for (int i = 0; i < kLaneCount; ++i) {
        const std::size_t slot = first_in_batch + static_cast<std::size_t>(i);
        memory_.slots[slot] = {surfaces.radiance[i], light_of(surfaces.radiance[i]), 0.0F, 0.0F, 0.0F};
        const vec3 direction = hits.direction[i];
        memory_.metres_per_depth[slot] = std::sqrt(glm::dot(direction, direction));
        memory_.pixel[slot] = hits.pixel[i];
    }
}

/// An eye inside a volume sees it from behind.
void RayBatch::absorb_before_eye(const HitPacket& hits, std::span<RayPath, kLaneCount> path, LaneMask lanes) const {
    for_each_lane(lanes, [&](int lane) {
        const ShadingInstance& hit = frame_.shading.scene.instances()[hits.instance[lane]];
        const vec3 direction = hits.direction[lane];
        if ((hit.needs & kNeedAbsorption) == 0 || glm::dot(hits.geometric_normal[lane], direction) <= 0.0F) return;
        path[static_cast<std::size_t>(lane)].throughput =
            kernels::beer_transmittance(hit.absorption_per_m, hits.distance[lane] * glm::length(direction));
    });
}

void RayBatch::trace_wave(std::span<SecondaryRay> wave) {
    for (std::size_t first = 0; first < wave.size(); first += kLaneCount)
        trace_secondary(wave.subspan(first, std::min<std::size_t>(kLaneCount, wave.size() - first)));
}

void RayBatch::trace_secondary(std::span<SecondaryRay> batch) {
    const ShadingContext& shading = frame_.shading;
    RTCRayHit16 rays;
    HitPacket hits;
    const LaneMask traced = first_lanes(batch.size());
    for (int i = 0; i < kLaneCount; ++i) {
        const SecondaryRay& ray = batch[std::min(static_cast<std::size_t>(i), batch.size() - 1)];
        hits.origin.set(i, ray.origin);
        hits.direction.set(i, ray.direction);
        hits.pixel[i] = memory_.pixel[ray.path.slot];
        set_ray(rays, i, ray.origin, ray.direction);
    }
    const Lanes<int> valid = valid_lanes(traced);
    std::size_t reflections = 0;
    for (const SecondaryRay& ray : batch) reflections += ray.path.reflection ? 1 : 0;
    counts_.reflection += reflections;
    counts_.transmission += batch.size() - reflections;
    if (frame_.tap != nullptr) {
        const auto kind = 2 * reflections >= batch.size() ? RayTap::Kind::reflection : RayTap::Kind::transmission;
        frame_.tap->packet(kind, valid.value, rays.ray.org_x, rays.ray.dir_x, rays.ray.tfar);
    }
    intersect_coherent(valid.value, shading.pose.tree, rays);
    read_hits(rays, traced, hits);
    turn_normals(shading, hits);

    std::array<RayPath, kLaneCount> path;
    hits.may_reflect = 0;
    for (int i = 0; i < static_cast<int>(batch.size()); ++i) {
        RayPath& p = path[static_cast<std::size_t>(i)] = batch[static_cast<std::size_t>(i)].path;
        hits.spread[i] = p.spread;
        if (((hits.hit >> i) & 1U) == 0) continue;
        hits.width_m[i] = p.width_m + p.spread * hits.distance[i];
        // From within, a volume's own back face tells what the ray came through, also where it began there.
        const ShadingInstance& hit = shading.scene.instances()[hits.instance[i]];
        const bool leaves = glm::dot(hits.geometric_normal[i], hits.direction[i]) > 0.0F;
        const ShadingInstance* volume = leaves && (hit.needs & kNeedRefraction) != 0 ? &hit
                                        : p.volume > 0 ? &shading.scene.instances()[p.volume - 1]
                                                       : nullptr;
        if (volume != nullptr) p.throughput *= kernels::beer_transmittance(volume->absorption_per_m, hits.distance[i]);
        hits.share[i] = std::max({p.throughput.x, p.throughput.y, p.throughput.z});
        if (p.bounces > 0) hits.may_reflect |= 1U << i;
    }

    SurfacePacket surfaces;
    find_surfaces(shading, hits, surfaces);
    add_lights(shading, hits, surfaces, frame_.tap, counts_);
    if (surfaces.branching != 0) send_rays(shading, hits, surfaces, path, surfaces.radiance, memory_.stack, counts_);

    for (int i = 0; i < static_cast<int>(batch.size()); ++i) {
        const RayPath& p = path[static_cast<std::size_t>(i)];
        SampleSlot& slot = memory_.slots[p.slot];
        const vec3 brought = p.throughput * surfaces.radiance[i];
        slot.radiance += brought;
        const float light = light_of(brought);
        slot.other_light += light;
        if (light <= slot.strongest) continue;
        slot.strongest = light;
        slot.strongest_path_m = ((hits.hit >> i) & 1U) != 0 ? p.path_m + hits.distance[i] : 0.0F;
    }
}

void RayBatch::store(std::span<const std::uint32_t> addresses, std::size_t slot) {
    Lanes3 radiance;
    for (int i = 0; i < kLaneCount; ++i) radiance.set(i, memory_.slots[slot + static_cast<std::size_t>(i)].radiance);
    store_color(addresses, radiance);
    if (task_.samples->keep_image_depth) store_image_depth(addresses, slot);
}

void RayBatch::store_color(std::span<const std::uint32_t> addresses, const Lanes3& radiance) {
    Samples& samples = *task_.samples;
    Lanes<std::uint32_t> color;
    encode(radiance, frame_.shading.scene.scene().exposure, color);
    for (int i = 0; i < static_cast<int>(addresses.size()); ++i)
        samples.color[addresses[static_cast<std::size_t>(i)]] = color[i];
    if (!samples.keep_radiance) return;
    for (int i = 0; i < static_cast<int>(addresses.size()); ++i)
        samples.radiance[addresses[static_cast<std::size_t>(i)]] = radiance[i];
}

void RayBatch::store_image_depth(std::span<const std::uint32_t> addresses, std::size_t slot) {
    Samples& samples = *task_.samples;
    for (std::size_t i = 0; i < addresses.size(); ++i) {
        const SampleSlot& s = memory_.slots[slot + i];
        float inverse = samples.inverse_depth_per_m[addresses[i]];
        if (s.other_light > s.first_light)
            inverse = s.strongest_path_m > 0.0F ? memory_.metres_per_depth[slot + i] / s.strongest_path_m : 0.0F;
        samples.image_inverse_depth_per_m[addresses[i]] = inverse;
    }
}

}  // namespace macula
