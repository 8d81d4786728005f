// Reconstruction of one eye of the Vive, 1512x1680, colour and inverse depth, of meshes at the presets' shares: by
// table and by raster, beside the tile reconstructor with the same share. Scattering the samples is part of it.
//
// Run with --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true and read the minima: `min_ms` is the
// fastest frame, p50 and p99 are of the frames of a repetition. `cpu_min_ms` is the time of all of the process's
// threads, GL's too, which other work on the machine disturbs least. Meshes are kept in the system's folder for
// temporary files, so that a second run begins sooner.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "masks/make/mesh_store.h"
#include "masks/mesh/mesh_sampler.h"
#include "masks/mesh/mesh_table.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/gl/context.h"
#include "server/render/mesh_reconstructors.h"
#include "server/render/raster_mesh.h"
#include "server/render/reconstructor.h"
#include "server/render/sample_image.h"
#include "tests/support/tile_plans.h"

namespace macula {
namespace {

std::shared_ptr<const TileTables> tables() {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    return kTables;
}

/// A plan at centre gaze, of a picture with edges in colour and depth.
struct Scenario {
    SamplePlan plan;
    Samples samples;

    void sample() {
        samples = test::sample_picture(
            plan,
            [](int x, int y) { return static_cast<Rgba8>((x * x + 3 * y * y) / 64 * 0x010203 + x) | 0xFF000000U; },
            [](int x, int y) {
                return (x / 90 + y / 70) % 3 == 0 ? 0.0F : 0.2F + 0.0002F * static_cast<float>(x + y + 300);
            });
    }
};

constexpr PlanRequest kRequest = {{0.0F, 0.0F, -1.0F}, {37, 11}};

Scenario make_mesh_scenario(int percent) {
    const Display display = load_display("vive").value();
    const SamplingPreset preset = parse_sampling(percent == 100 ? "full" : std::to_string(percent)).value();
    const auto cache = std::filesystem::temp_directory_path() / "macula_mesh_reconstruct_bench";
    auto table = MeshTable::make(obtain_mesh({display, preset}, cache).value()).value();
    MeshSampler sampler(display, kLeftEye, std::make_shared<const MeshTable>(std::move(table)));
    Scenario scenario;
    sampler.plan(kRequest, scenario.plan);
    scenario.sample();
    return scenario;
}

Scenario make_tile_scenario(int percent) {
    const Display display = load_display("vive").value();
    const SamplingPreset preset = parse_sampling(percent == 100 ? "full" : std::to_string(percent)).value();
    TileSampler sampler(display, kLeftEye, tile_law(display, kLeftEye, preset), tables());
    Scenario scenario;
    sampler.plan(kRequest, scenario.plan);
    scenario.sample();
    return scenario;
}

using MakeScenario = Scenario (*)(int percent);

const Scenario& scenario_of(MakeScenario make, int percent) {
    static std::map<std::pair<MakeScenario, int>, Scenario> scenarios;
    const auto [found, added] = scenarios.try_emplace({make, percent});
    if (added) found->second = make(percent);
    return found->second;
}

double process_time_ms() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Takes the times of `frame()`, which says what went wrong.
template <class Frame>
void measure(benchmark::State& state, const Frame& frame) {
    std::vector<double> frames_ms;
    double least_cpu_ms = 1e9;
    if (const auto warm = frame(); !warm) return state.SkipWithError(warm.error().message.c_str());
    for (auto _ : state) {
        const double cpu_begin_ms = process_time_ms();
        const auto begin = std::chrono::steady_clock::now();
        if (const auto done = frame(); !done) return state.SkipWithError(done.error().message.c_str());
        frames_ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
        least_cpu_ms = std::min(least_cpu_ms, process_time_ms() - cpu_begin_ms);
    }
    std::sort(frames_ms.begin(), frames_ms.end());
    const auto quantile = [&](double q) {
        return frames_ms[static_cast<std::size_t>(q * static_cast<double>(frames_ms.size() - 1))];
    };
    state.counters["min_ms"] = frames_ms.front();
    state.counters["cpu_min_ms"] = least_cpu_ms;
    state.counters["p50_ms"] = quantile(0.5);
    state.counters["p99_ms"] = quantile(0.99);
}

void measure(benchmark::State& state, Reconstructor& reconstructor, const Scenario& scenario) {
    const auto& [plan, samples] = scenario;
    ColorImage color(plan.width_px, plan.height_px);
    InverseDepthImage depth(plan.width_px, plan.height_px);
    const auto width = static_cast<std::size_t>(plan.width_px);
    measure(state, [&] {
        return reconstructor.reconstruct(plan, samples, {color.texels.data(), width, depth.texels.data(), width});
    });
    state.counters["share"] = plan.traced_share();
}

void cpp(benchmark::State& state, std::unique_ptr<Reconstructor> (*make)(), MakeScenario scenario) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(state.range(1)));
    measure(state, *make(), scenario_of(scenario, static_cast<int>(state.range(0))));
}

void scatter(benchmark::State& state) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
    const Scenario& scenario = scenario_of(make_mesh_scenario, static_cast<int>(state.range(0)));
    SampleImage image;
    measure(state, [&]() -> Expected<void> {
        image.fill(scenario.plan, scenario.samples, false);
        return {};
    });
}

/// What a raster reconstructor does when a mesh is new.
void sort_triangles(benchmark::State& state) {
    const Scenario& scenario = scenario_of(make_mesh_scenario, static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(RasterMesh(scenario.plan.mesh->mesh()));
    state.counters["sites"] = static_cast<double>(scenario.plan.mesh->mesh().site.size());
}

void gl(benchmark::State& state, Expected<std::unique_ptr<Reconstructor>> (*make)(std::unique_ptr<GlContext>),
        MakeScenario scenario) {
    auto context = make_gl_context(ContextKind::automatic);
    if (!context) return state.SkipWithError(context.error().message.c_str());
    auto reconstructor = make(std::move(*context));
    if (!reconstructor) return state.SkipWithError(reconstructor.error().message.c_str());
    state.SetLabel((*reconstructor)->name());
    measure(state, **reconstructor, scenario_of(scenario, static_cast<int>(state.range(0))));
}

std::unique_ptr<Reconstructor> make_cpu_tiles() {
    return make_cpu_reconstructor(tables());
}
Expected<std::unique_ptr<Reconstructor>> make_gl_tiles(std::unique_ptr<GlContext> context) {
    return make_gl_reconstructor(std::move(context), *tables());
}

void shares(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgsProduct({{100, 54, 27}})->ArgName("percent")->Unit(benchmark::kMillisecond)->UseRealTime();
}
void shares_and_threads(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgsProduct({{100, 54, 27}, {1, 2}})
        ->ArgNames({"percent", "threads"})
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

BENCHMARK_CAPTURE(cpp, tiles, make_cpu_tiles, make_tile_scenario)->Apply(shares_and_threads);
BENCHMARK_CAPTURE(cpp, table, make_cpu_table_reconstructor, make_mesh_scenario)->Apply(shares_and_threads);
BENCHMARK(scatter)->Apply(shares);
BENCHMARK_CAPTURE(cpp, raster, make_cpu_raster_reconstructor, make_mesh_scenario)->Apply(shares_and_threads);
BENCHMARK(sort_triangles)->Apply(shares);
BENCHMARK_CAPTURE(gl, tiles, make_gl_tiles, make_tile_scenario)->Apply(shares);
BENCHMARK_CAPTURE(gl, table, make_gl_table_reconstructor, make_mesh_scenario)->Apply(shares);
BENCHMARK_CAPTURE(gl, raster, make_gl_raster_reconstructor, make_mesh_scenario)->Apply(shares);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
