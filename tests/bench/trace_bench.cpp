// Speed of tracing with shading, textures and shadows, as a share of the speed at which Embree alone traces the very
// same primary, shadow and secondary rays in the same packets of 16. The rays are recorded as the tracer traces them;
// then both are timed alternately in one run, and the best time of each counts.
//
// usage: trace_bench [--scene NAME] [--bounces N] [--bounce-bound X] [options of Google Benchmark]

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "masks/display.h"
#include "masks/rank_tile.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/base/clock.h"
#include "scenes/load.h"
#include "scenes/needs.h"
#include "server/render/embree_calls.h"
#include "server/render/lanes.h"
#include "server/render/tracer.h"

namespace macula {
namespace {

/// What the command line asks for.
struct Arguments {
    std::string scene = "bunny-box";
    TracerOptions options;
};

Arguments& arguments() {
    static Arguments value;
    return value;
}

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

struct RecordedPacket {
    RayTap::Kind kind;
    Lanes<int> valid;
    Lanes3 origin;
    Lanes3 direction;
    Lanes<float> far;
};

/// Keeps every packet, in the order in which a thread traced them.
class Recorder final : public RayTap {
public:
    void packet(Kind kind, const int* valid, const float* origin, const float* direction, const float* far) override {
        if (!recording.load(std::memory_order_relaxed)) return;
        RecordedPacket& packet = packets_.local().emplace_back();
        packet.kind = kind;
        std::copy_n(valid, kLaneCount, packet.valid.value);
        const auto copy = [](const float* from, Lanes3& to) {
            std::copy_n(from, kLaneCount, to.x.value);
            std::copy_n(from + kLaneCount, kLaneCount, to.y.value);
            std::copy_n(from + 2 * static_cast<std::ptrdiff_t>(kLaneCount), kLaneCount, to.z.value);
        };
        copy(origin, packet.origin);
        copy(direction, packet.direction);
        std::copy_n(far, kLaneCount, packet.far.value);
    }
    [[nodiscard]] std::vector<RecordedPacket> take() {
        std::vector<RecordedPacket> all;
        for (auto& packets : packets_) {
            all.insert(all.end(), packets.begin(), packets.end());
            packets = {};
        }
        return all;
    }

    std::atomic<bool> recording = false;

private:
    tbb::enumerable_thread_specific<std::vector<RecordedPacket>> packets_;
};

/// Traces recorded packets with nothing but Embree.
class BareEmbree {
public:
    BareEmbree(const Scene& scene, std::vector<RecordedPacket> packets)
        : device_(rtcNewDevice(nullptr)), scene_(bare_scene(device_, scene)), packets_(std::move(packets)) {}
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;
    ~BareEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// Returns the sum of hits, so that nothing can be left out.
    [[nodiscard]] std::uint64_t trace() const {
        std::atomic<std::uint64_t> total = 0;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets_.size(), 192), [&](const auto& range) {
            std::uint64_t sum = 0;
            for (std::size_t k = range.begin(); k < range.end(); ++k) sum += trace(packets_[k]);
            total += sum;
        });
        return total;
    }

private:
    static void fill(RTCRay16& ray, const RecordedPacket& packet) {
        for (int i = 0; i < kLaneCount; ++i) {
            ray.org_x[i] = packet.origin.x[i];
            ray.org_y[i] = packet.origin.y[i];
            ray.org_z[i] = packet.origin.z[i];
            ray.dir_x[i] = packet.direction.x[i];
            ray.dir_y[i] = packet.direction.y[i];
            ray.dir_z[i] = packet.direction.z[i];
            ray.tnear[i] = 0.0F;
            ray.tfar[i] = packet.far[i];
            ray.time[i] = 0.0F;
            ray.mask[i] = 0xFFFFFFFFU;
            ray.flags[i] = 0;
        }
    }
    [[nodiscard]] std::uint64_t trace(const RecordedPacket& packet) const {
        std::uint64_t sum = 0;
        if (packet.kind == RayTap::Kind::shadow) {
            RTCRay16 ray;
            fill(ray, packet);
            occluded_coherent(packet.valid.value, scene_, ray);
            for (int i = 0; i < kLaneCount; ++i) sum += ray.tfar[i] < 0.0F ? 1U : 0U;
        } else {
            RTCRayHit16 rays;
            fill(rays.ray, packet);
            for (int i = 0; i < kLaneCount; ++i) rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            intersect_coherent(packet.valid.value, scene_, rays);
            for (int i = 0; i < kLaneCount; ++i) sum += rays.hit.primID[i];
        }
        return sum;
    }

    RTCDevice device_;
    RTCScene scene_;
    std::vector<RecordedPacket> packets_;
};

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

/// A display, the scene of the command line, and a frame of `percent` of the pixels.
std::optional<Frame> load_frame(benchmark::State& state, std::shared_ptr<const Scene>& scene, std::int64_t percent) {
    static std::optional<LoadedScene> kept;  // large scenes take seconds to load
    if (!kept) {
        auto loaded = load_scene(arguments().scene);
        if (loaded) kept = std::move(*loaded);
    }
    const auto display = load_display("vive");
    if (!kept || !display) {
        state.SkipWithError("scene or display failed to load");
        return std::nullopt;
    }
    scene = kept->scene;
    static const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    return std::optional<Frame>(std::in_place, *scene, *display, tables, static_cast<double>(percent) / 100.0);
}

/// One stereo frame, `range(0)` per cent of the pixels.
void trace_against_bare(benchmark::State& state) {
    std::shared_ptr<const Scene> scene;
    auto frame = load_frame(state, scene, state.range(0));
    if (!frame) return;
    Recorder recorder;
    const auto tapped = make_embree_tracer(scene, arguments().options, &recorder);
    const auto tracer = make_embree_tracer(scene, arguments().options);
    if (!tapped || !tracer) return state.SkipWithError("the tracer failed");
    const auto tasks = frame->tasks();
    recorder.recording = true;
    const TraceCounts counts = (*tapped)->trace(tasks);
    const BareEmbree bare(*scene, recorder.take());

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
    const auto rays = static_cast<double>(counts.primary);
    state.counters["trace_ms"] = ours.wall_s * 1e3;
    state.counters["bare_ms"] = alone.wall_s * 1e3;
    state.counters["share_of_bare_speed"] = alone.wall_s / ours.wall_s;
    state.counters["by_cpu_time"] = alone.cpu_s / ours.cpu_s;
    state.counters["cpu_ns_per_primary_ray"] = ours.cpu_s * 1e9 / rays;
    state.counters["Mrays"] = rays * 1e-6;
    const auto per_primary = [&](std::uint64_t count) { return static_cast<double>(count) / rays; };
    state.counters["shadow_rays_per_primary"] = per_primary(counts.shadow);
    state.counters["skipped_shadow_per_primary"] = per_primary(counts.skipped_shadow);
    state.counters["reflections_per_primary"] = per_primary(counts.reflection);
    state.counters["transmissions_per_primary"] = per_primary(counts.transmission);
    state.counters["skipped_bounces_per_primary"] = per_primary(counts.skipped_bounce);
}
BENCHMARK(trace_against_bare)
    ->Arg(100)
    ->Arg(54)
    ->Arg(41)
    ->Arg(27)
    ->Arg(18)
    ->Iterations(12)
    ->Unit(benchmark::kMillisecond);

/// What code for a feature costs where the scene has none of it: time with it forced, as a share of the time without,
/// taken in turn; the median of the pairs. `range(0)` is the bit of Need.
void unused_feature(benchmark::State& state) {
    std::shared_ptr<const Scene> scene;
    auto frame = load_frame(state, scene, 27);
    if (!frame) return;
    TracerOptions forced = arguments().options;
    forced.forced_features = 1U << static_cast<std::uint32_t>(state.range(0));
    const auto with = make_embree_tracer(scene, forced);
    const auto without = make_embree_tracer(scene, arguments().options);
    if (!with || !without) return state.SkipWithError("the tracer failed");
    if ((scene_needs(*scene).needs & forced.forced_features) != 0) return state.SkipWithError("the scene needs it");
    const auto tasks = frame->tasks();
    std::vector<double> ratios;
    for (auto _ : state) {
        const Stopwatch with_watch;
        (*with)->trace(tasks);
        const double with_s = with_watch.cpu_s();
        const Stopwatch without_watch;
        (*without)->trace(tasks);
        ratios.push_back(with_s / without_watch.cpu_s());
    }
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    state.counters["time_with_over_without"] = ratios[ratios.size() / 2];
}
BENCHMARK(unused_feature)->DenseRange(0, kNeedCount - 1)->Iterations(21)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    std::vector<char*> rest{argv[0]};
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        const bool has_value = i + 1 < argc;
        if (name == "--scene" && has_value) {
            macula::arguments().scene = argv[++i];
        } else if (name == "--bounces" && has_value) {
            macula::arguments().options.bounces = std::atoi(argv[++i]);
        } else if (name == "--bounce-bound" && has_value) {
            macula::arguments().options.bounce_bound = std::strtof(argv[++i], nullptr);
        } else {
            rest.push_back(argv[i]);
        }
    }
    int count = static_cast<int>(rest.size());
    benchmark::Initialize(&count, rest.data());
    if (benchmark::ReportUnrecognizedArguments(count, rest.data())) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
