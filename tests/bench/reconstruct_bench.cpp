// Reconstruction of one eye of the Vive, 1512x1680, colour and inverse depth, at the presets' shares.
//
// Run with --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true and read the minima: `min_ms` is the
// fastest frame, p50 and p99 are of the frames of a repetition. `cpu_min_ms` is the calling thread's own time, which
// other work on the machine disturbs least; with one thread it is all of it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/level_map.h"
#include "masks/tile_tables.h"
#include "protocol/gl/context.h"
#include "server/render/reconstructor.h"
#include "tests/support/law_for_share.h"
#include "tests/support/tile_plans.h"

namespace macula {
namespace {

std::shared_ptr<const TileTables> tables() {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    return kTables;
}

/// What a preset's law samples at centre gaze, of a picture with edges in colour and depth.
struct Scenario {
    SamplePlan plan;
    Samples samples;
};

Scenario make_scenario(int percent) {
    const Display display = load_display("vive").value();
    const glm::ivec2 phase(37, 11);
    const TileGrid grid({display.eye_width_px, display.eye_height_px}, phase);
    std::vector<std::uint8_t> levels(static_cast<std::size_t>(grid.tiles.x * grid.tiles.y), kFullLevel);
    if (percent < 100) {
        std::fill(levels.begin(), levels.end(), std::uint8_t{0});
        LevelMap map(display, kLeftEye, law_for_share(display, kLeftEye, percent / 100.0));
        map.update(grid, {0.0F, 0.0F, -1.0F}, levels.data(), grid.tiles.x);
    }
    const auto level = [&](int x, int y) {
        const int inner_x = std::clamp(x - 1, 0, grid.tiles.x - 1);
        return levels[static_cast<std::size_t>(std::clamp(y - 1, 0, grid.tiles.y - 1) * grid.tiles.x + inner_x)];
    };
    Scenario scenario;
    scenario.plan = test::tile_plan(tables()->rank_tile(), display.eye_width_px, display.eye_height_px, phase, level,
                                    [](int, int) { return true; });
    scenario.samples = test::sample_picture(
        scenario.plan,
        [](int x, int y) { return static_cast<Rgba8>((x * x + 3 * y * y) / 64 * 0x010203 + x) | 0xFF000000U; },
        [](int x, int y) { return (x / 90 + y / 70) % 3 == 0 ? 0.0F : 0.2F + 0.0002F * static_cast<float>(x + y); });
    return scenario;
}

const Scenario& scenario_of(int percent) {
    static std::map<int, Scenario> scenarios;
    const auto [found, added] = scenarios.try_emplace(percent);
    if (added) found->second = make_scenario(percent);
    return found->second;
}

double thread_time_ms() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void measure(benchmark::State& state, Reconstructor& reconstructor, int percent) {
    const auto& [plan, samples] = scenario_of(percent);
    ColorImage color(plan.width_px, plan.height_px);
    InverseDepthImage depth(plan.width_px, plan.height_px);
    const auto width = static_cast<std::size_t>(plan.width_px);
    std::vector<double> frames_ms;
    double least_cpu_ms = 1e9;
    for (auto _ : state) {
        const double cpu_begin_ms = thread_time_ms();
        const auto begin = std::chrono::steady_clock::now();
        if (const auto done =
                reconstructor.reconstruct(plan, samples, {color.texels.data(), width, depth.texels.data(), width});
            !done) {
            state.SkipWithError(done.error().message.c_str());
            return;
        }
        frames_ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
        least_cpu_ms = std::min(least_cpu_ms, thread_time_ms() - cpu_begin_ms);
    }
    std::sort(frames_ms.begin(), frames_ms.end());
    const auto quantile = [&](double q) {
        return frames_ms[static_cast<std::size_t>(q * static_cast<double>(frames_ms.size() - 1))];
    };
    state.counters["min_ms"] = frames_ms.front();
    state.counters["cpu_min_ms"] = least_cpu_ms;
    state.counters["p50_ms"] = quantile(0.5);
    state.counters["p99_ms"] = quantile(0.99);
    state.counters["share"] = plan.traced_share();
}

void cpp(benchmark::State& state) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(state.range(1)));
    const auto reconstructor = make_cpu_reconstructor(tables());
    measure(state, *reconstructor, static_cast<int>(state.range(0)));
}
BENCHMARK(cpp)
    ->ArgsProduct({{100, 54, 41, 27, 18}, {1, 2}})
    ->ArgNames({"percent", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void reference(benchmark::State& state) {
    const auto reconstructor = make_reference_reconstructor(tables());
    measure(state, *reconstructor, static_cast<int>(state.range(0)));
}
BENCHMARK(reference)->Arg(27)->ArgName("percent")->Unit(benchmark::kMillisecond)->UseRealTime();

void gl(benchmark::State& state, ContextKind kind) {
    auto context = make_gl_context(kind);
    if (!context) return state.SkipWithError(context.error().message.c_str());
    auto reconstructor = make_gl_reconstructor(std::move(*context), *tables());
    if (!reconstructor) return state.SkipWithError(reconstructor.error().message.c_str());
    state.SetLabel((*reconstructor)->name());
    measure(state, **reconstructor, static_cast<int>(state.range(0)));
}
BENCHMARK_CAPTURE(gl, automatic, ContextKind::automatic)
    ->ArgsProduct({{100, 54, 41, 27, 18}})
    ->ArgName("percent")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(gl, osmesa, ContextKind::osmesa)
    ->ArgsProduct({{54, 18}})
    ->ArgName("percent")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
