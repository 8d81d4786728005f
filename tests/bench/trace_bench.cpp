// Speed of tracing with shading, textures and shadows, as a share of the speed at which Embree alone traces the very
// same primary, shadow and secondary rays in the same packets of 16. The rays are recorded as the tracer traces them;
// then both are timed alternately in one run, and the best time of each counts.
//
// usage: trace_bench [--scene NAME] [--plain] [--display NAME] [--bounces N] [--bounce-bound X]
//                    [options of Google Benchmark]
//
// --plain leaves nothing of the scene but its shape and its lights: rough white surfaces and hard shadows.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "masks/display.h"
#include "masks/rank_tile.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "scenes/load.h"
#include "scenes/needs.h"
#include "server/render/tracer.h"
#include "tests/support/bare_embree.h"
#include "tests/support/law_for_share.h"
#include "tests/support/stopwatch.h"

namespace macula {
namespace {

/// What the command line asks for.
struct Arguments {
    std::string scene = "bunny-box";
    std::string display = "vive";
    bool plain = false;
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
    Frame(const Scene& scene, const Display& display, const std::shared_ptr<const TileTables>& tables, double share) {
        for (const Eye eye : {kLeftEye, kRightEye}) {
            views[eye] = {scene.world_from_start * display.eyes[eye].head_from_eye, display.eyes[eye].tangents,
                          display.eye_width_px, display.eye_height_px};
            std::optional<AcuityLaw> law;
            if (share < 1.0) law = law_for_share(display, eye, share);
            TileSampler(display, eye, law, tables).plan({}, plans[eye]);
        }
    }

    std::array<TraceTask, 2> tasks() {
        return {TraceTask{views.data(), plans.data(), samples.data()}, TraceTask{&views[1], &plans[1], &samples[1]}};
    }
    [[nodiscard]] std::size_t rays() const { return plans[0].trace_order.size() + plans[1].trace_order.size(); }
};

/// The scene's shape in rough white, under its lights without extent.
std::shared_ptr<const Scene> stripped(const Scene& scene) {
    Scene plain = scene;
    Material white;
    white.metallic = 0.0F;
    white.double_sided = true;
    plain.materials.assign(plain.materials.size(), white);
    for (Mesh& mesh : plain.meshes) mesh.color.clear();
    for (Light& light : plain.lights) light.radius_m = light.angular_radius_rad = 0.0F;
    std::erase_if(plain.lights, [](const Light& light) { return light.kind == LightKind::rectangle; });
    plain.environment = {};
    return std::make_shared<const Scene>(std::move(plain));
}

/// A display, the scene of the command line, and a frame of `percent` of the pixels.
std::optional<Frame> load_frame(benchmark::State& state, std::shared_ptr<const Scene>& scene, std::int64_t percent) {
    static std::optional<LoadedScene> kept;  // large scenes take seconds to load
    if (!kept) {
        auto loaded = load_scene(arguments().scene);
        if (loaded && arguments().plain) loaded->scene = stripped(*loaded->scene);
        if (loaded) kept = std::move(*loaded);
    }
    const auto display = load_display(arguments().display);
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
    test::Recorder recorder;
    const auto tapped = make_embree_tracer(scene, arguments().options, &recorder);
    const auto tracer = make_embree_tracer(scene, arguments().options);
    if (!tapped || !tracer) return state.SkipWithError("the tracer failed");
    const auto tasks = frame->tasks();
    recorder.recording = true;
    const TraceCounts counts = (*tapped)->trace(tasks);
    const test::BareEmbree bare(*scene, recorder.take());

    test::Best ours;
    test::Best alone;
    for (auto _ : state) {
        const test::Stopwatch ours_watch;
        (*tracer)->trace(tasks);
        ours.add(ours_watch);
        const test::Stopwatch bare_watch;
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

/// Processor time of `one` over that of `other` for the same tasks, taken in turn; the median of the pairs.
double time_over(benchmark::State& state, const Tracer& one, const Tracer& other, std::span<const TraceTask> tasks) {
    std::vector<double> ratios;
    for (auto _ : state) {
        const test::Stopwatch one_watch;
        one.trace(tasks);
        const double one_s = one_watch.cpu_s();
        const test::Stopwatch other_watch;
        other.trace(tasks);
        ratios.push_back(one_s / other_watch.cpu_s());
    }
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    return ratios[ratios.size() / 2];
}

/// What code for a feature costs where the scene has none of it: time with it forced, as a share of the time without.
/// `range(0)` is the bit of Need.
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
    state.counters["time_with_over_without"] = time_over(state, **with, **without, frame->tasks());
}
BENCHMARK(unused_feature)->DenseRange(0, kNeedCount - 1)->Iterations(21)->Unit(benchmark::kMillisecond);

/// What the bounce bound saves: time without it, as a share of the time with it. `range(0)` is TracerOptions::bounces.
void unbounded_bounces(benchmark::State& state) {
    std::shared_ptr<const Scene> scene;
    auto frame = load_frame(state, scene, 27);
    if (!frame) return;
    TracerOptions bounded = arguments().options;
    bounded.bounces = static_cast<int>(state.range(0));
    TracerOptions unbounded = bounded;
    unbounded.bounce_bound = 0.0F;
    const auto with = make_embree_tracer(scene, bounded);
    const auto without = make_embree_tracer(scene, unbounded);
    if (!with || !without) return state.SkipWithError("the tracer failed");
    state.counters["time_without_over_with"] = time_over(state, **without, **with, frame->tasks());
}
BENCHMARK(unbounded_bounces)->RangeMultiplier(2)->Range(1, 8)->Iterations(15)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    std::vector<char*> rest{argv[0]};
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        const bool has_value = i + 1 < argc;
        if (name == "--scene" && has_value) {
            macula::arguments().scene = argv[++i];
        } else if (name == "--plain") {
            macula::arguments().plain = true;
        } else if (name == "--display" && has_value) {
            macula::arguments().display = argv[++i];
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
