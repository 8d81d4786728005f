// Speed of tracing with shading and shadows, as a share of the speed at which Embree alone traces the very same
// primary and shadow rays in packets of 16. The rays are recorded first; then both are timed alternately in one run,
// and the best time of each counts.

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <benchmark/benchmark.h>
#include <glm/gtc/quaternion.hpp>

#include "masks/display.h"
#include "masks/rank_tile.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/base/clock.h"
#include "scenes/load.h"
#include "server/kernels/camera.h"
#include "server/render/embree_calls.h"
#include "server/render/packet_shading.h"
#include "server/render/tracer.h"

namespace macula {
namespace {

/// What trace() needs for both eyes of a display at the scene's start, gaze on the optical axes.
struct Frame {
    PerEye<EyeView> views;
    PerEye<SamplePlan> plans;
    PerEye<Samples> samples;

    /// `share` of the buffer's pixels, hidden ones included, is traced; 1: every visible pixel.
    Frame(const Scene& scene, const Display& display, std::shared_ptr<const TileTables> tables, double share) {
        for (const Eye eye : {kLeftEye, kRightEye}) {
            views[eye] = {scene.world_from_start * display.eyes[eye].head_from_eye, display.eyes[eye].tangents,
                          display.eye_width_px, display.eye_height_px};
            std::optional<AcuityLaw> law;
            if (share < 1.0) law = solve_law(display, eye, share);
            TileSampler(display, eye, law, tables).plan({}, plans[eye]);
        }
    }

    std::array<TraceTask, 2> tasks() {
        return {TraceTask{views.data(), plans.data(), samples.data()}, TraceTask{&views[1], &plans[1], &samples[1]}};
    }
    [[nodiscard]] std::size_t rays() const { return plans[0].trace_order.size() + plans[1].trace_order.size(); }
};

/// The scene's triangles in Embree, without filters.
RTCScene bare_scene(RTCDevice device, const Scene& scene) {
    RTCScene result = rtcNewScene(device);
    rtcSetSceneFlags(result, RTC_SCENE_FLAG_ROBUST);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* position = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.position_m.size()));
        for (const glm::vec3& p : mesh.position_m) *position++ = instance.world_from_mesh * glm::vec4(p, 1.0F);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangle.data(), 0,
                                   sizeof(glm::uvec3), mesh.triangle.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(result, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(result);
    return result;
}

struct ShadowRays {
    Lanes3 origin;
    Lanes3 direction;
    Lanes<int> valid;
    float far = 0.0F;
};

/// The rays of one packet: a range of all shadow packets belongs to it.
struct RecordedPacket {
    glm::vec3 origin;
    Lanes3 direction;
    std::size_t shadows_begin;
    std::size_t shadows_end;
};

class BareEmbree {
public:
    explicit BareEmbree(const Scene& scene) : device_(rtcNewDevice(nullptr)), scene_(bare_scene(device_, scene)) {}
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;
    ~BareEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// Records what the tracer would trace, with the tracer's own shading code.
    void record(const ShadingScene& scene, const Frame& frame);
    /// Traces all that was recorded; returns the sum of hits, so that nothing can be left out.
    [[nodiscard]] std::uint64_t trace() const;
    [[nodiscard]] std::uint64_t shadow_rays() const { return shadow_rays_; }

private:
    void intersect(const RecordedPacket& packet, RTCRayHit16& rays) const;

    RTCDevice device_;
    RTCScene scene_;
    std::vector<RecordedPacket> packets_;
    std::vector<ShadowRays> shadows_;
    std::uint64_t shadow_rays_ = 0;
};

void fill(RTCRay16& ray, int i, const glm::vec3& origin, const glm::vec3& direction, float far) {
    ray.org_x[i] = origin.x;
    ray.org_y[i] = origin.y;
    ray.org_z[i] = origin.z;
    ray.dir_x[i] = direction.x;
    ray.dir_y[i] = direction.y;
    ray.dir_z[i] = direction.z;
    ray.tnear[i] = 0.0F;
    ray.tfar[i] = far;
    ray.time[i] = 0.0F;
    ray.mask[i] = 0xFFFFFFFFU;
    ray.flags[i] = 0;
}

void BareEmbree::intersect(const RecordedPacket& packet, RTCRayHit16& rays) const {
    alignas(64) static constexpr std::array<int, 16> kAll = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                             -1, -1, -1, -1, -1, -1, -1, -1};
    for (int i = 0; i < kLaneCount; ++i) {
        fill(rays.ray, i, packet.origin, packet.direction[i], std::numeric_limits<float>::infinity());
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect_coherent(kAll.data(), scene_, rays);
}

void BareEmbree::record(const ShadingScene& scene, const Frame& frame) {
    for (const Eye eye : {kLeftEye, kRightEye}) {
        const EyeView& view = frame.views[eye];
        const SamplePlan& plan = frame.plans[eye];
        const glm::mat3 axes = glm::mat3_cast(view.world_from_eye.orientation);
        const glm::vec4 edges(view.tangents.left, view.tangents.right, view.tangents.bottom, view.tangents.top);
        for (std::size_t first = 0; first + kLaneCount <= plan.trace_order.size(); first += kLaneCount) {
            RecordedPacket packet{view.world_from_eye.position_m, {}, shadows_.size(), shadows_.size()};
            for (int i = 0; i < kLaneCount; ++i) {
                const SamplePosition p = plan.position[plan.trace_order[first + static_cast<std::size_t>(i)]];
                packet.direction.set(i,
                                     kernels::eye_ray_direction(axes, edges, glm::vec2(view.width_px, view.height_px),
                                                                glm::vec2(p.x_px, p.y_px) + 0.5F));
            }
            RTCRayHit16 rays;
            intersect(packet, rays);
            HitPacket hits;
            hits.origin = packet.origin;
            hits.direction = packet.direction;
            for (int i = 0; i < kLaneCount; ++i) {
                hits.hit |= static_cast<LaneMask>(rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) << i;
                hits.distance[i] = rays.ray.tfar[i];
                hits.geometric_normal.set(i, {rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]});
                hits.u[i] = rays.hit.u[i];
                hits.v[i] = rays.hit.v[i];
                hits.instance[i] = rays.hit.geomID[i];
                hits.triangle[i] = rays.hit.primID[i];
            }
            SurfacePacket surfaces;
            find_surfaces(scene, hits, surfaces);
            for (const ShadingLight& light : scene.lights()) {
                LightPacket lighting;
                shine(light.light, surfaces, lighting);
                if (!light.casts_shadow || lighting.lanes == 0) continue;
                ShadowRays shadow{surfaces.position, lighting.to_light, {}, 1.0F};
                if (light.light.position.w == 0.0F) shadow.far = std::numeric_limits<float>::infinity();
                for (int i = 0; i < kLaneCount; ++i) shadow.valid[i] = ((lighting.lanes >> i) & 1U) != 0 ? -1 : 0;
                shadow_rays_ += static_cast<std::uint64_t>(std::popcount(lighting.lanes));
                shadows_.push_back(shadow);
            }
            packet.shadows_end = shadows_.size();
            packets_.push_back(packet);
        }
    }
}

std::uint64_t BareEmbree::trace() const {
    std::atomic<std::uint64_t> total = 0;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets_.size(), 64), [&](const auto& range) {
        std::uint64_t sum = 0;
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
            RTCRayHit16 rays;
            intersect(packets_[k], rays);
            for (int i = 0; i < kLaneCount; ++i) sum += rays.hit.primID[i];
            for (std::size_t s = packets_[k].shadows_begin; s < packets_[k].shadows_end; ++s) {
                const ShadowRays& shadow = shadows_[s];
                RTCRay16 ray;
                for (int i = 0; i < kLaneCount; ++i) fill(ray, i, shadow.origin[i], shadow.direction[i], shadow.far);
                occluded_coherent(shadow.valid.value, scene_, ray);
                for (int i = 0; i < kLaneCount; ++i) sum += ray.tfar[i] < 0.0F ? 1U : 0U;
            }
        }
        total += sum;
    });
    return total;
}

/// Wall and processor time since construction. On a machine with other work only the latter is steady.
class Stopwatch {
public:
    [[nodiscard]] double wall_s() const { return static_cast<double>(now_ns() - begin_ns_) * 1e-9; }
    [[nodiscard]] double cpu_s() const { return static_cast<double>(std::clock() - begin_cpu_) / CLOCKS_PER_SEC; }

private:
    std::int64_t begin_ns_ = now_ns();
    std::clock_t begin_cpu_ = std::clock();
};

/// The least of several times.
struct Best {
    double wall_s = std::numeric_limits<double>::infinity();
    double cpu_s = std::numeric_limits<double>::infinity();

    void add(const Stopwatch& watch) {
        wall_s = std::min(wall_s, watch.wall_s());
        cpu_s = std::min(cpu_s, watch.cpu_s());
    }
};

/// One stereo frame, `range(0)` per cent of the pixels.
void trace_against_bare(benchmark::State& state) {
    const auto loaded = load_scene("bunny-box");
    const auto display = load_display("vive");
    auto tracer = loaded ? make_embree_tracer(loaded->scene) : tl::unexpected(loaded.error());
    if (!display || !tracer) return state.SkipWithError("scene, display or tracer failed to load");
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    Frame frame(*loaded->scene, *display, tables, static_cast<double>(state.range(0)) / 100.0);
    BareEmbree bare(*loaded->scene);
    bare.record(ShadingScene(loaded->scene), frame);

    const auto tasks = frame.tasks();
    Best ours;
    Best alone;
    for (auto _ : state) {
        const Stopwatch ours_watch;
        (*tracer)->trace(tasks);
        ours.add(ours_watch);
        const Stopwatch bare_watch;
        benchmark::DoNotOptimize(bare.trace());
        alone.add(bare_watch);
    }
    const auto rays = static_cast<double>(frame.rays());
    state.counters["trace_ms"] = ours.wall_s * 1e3;
    state.counters["bare_ms"] = alone.wall_s * 1e3;
    state.counters["share_of_bare_speed"] = alone.wall_s / ours.wall_s;
    state.counters["by_cpu_time"] = alone.cpu_s / ours.cpu_s;
    state.counters["cpu_ns_per_primary_ray"] = ours.cpu_s * 1e9 / rays;
    state.counters["Mrays"] = rays * 1e-6;
    state.counters["shadow_rays_per_primary"] = static_cast<double>(bare.shadow_rays()) / rays;
}
BENCHMARK(trace_against_bare)
    ->Arg(100)
    ->Arg(54)
    ->Arg(41)
    ->Arg(27)
    ->Arg(18)
    ->Iterations(12)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
