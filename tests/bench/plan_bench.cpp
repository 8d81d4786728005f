// Time of one eye's plan on one core, with a gaze that drifts and a phase that changes every frame, as the service
// runs it. Counters: share of the pixels traced, and the share of it that a plain `full` plan would cost.
#include <cmath>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/tile_sampler.h"

namespace macula {
namespace {

std::shared_ptr<const TileTables> shared_tables() {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    return kTables;
}

void plan_frames(benchmark::State& state, const std::string& display_name, const std::string& sampling) {
    const Display display = load_display(display_name).value();
    const SamplingPreset preset = parse_sampling(sampling).value();
    TileSampler sampler(display, kLeftEye, tile_law(display, kLeftEye, preset), shared_tables());
    SamplePlan plan;
    int frame = 0;
    double share = 0.0;
    for (auto _ : state) {
        ++frame;
        PlanRequest request;
        const double turn = 0.01 * frame;
        request.gaze_eye = glm::normalize(glm::vec3(0.2 * std::cos(turn), 0.2 * std::sin(turn), -1.0));
        request.phase_px = glm::ivec2(64.0 * std::fmod(frame * 0.75488, 1.0), 64.0 * std::fmod(frame * 0.56984, 1.0));
        sampler.plan(request, plan);
        benchmark::DoNotOptimize(plan.trace_order.data());
        share += plan.traced_share();
    }
    state.counters["share"] = share / frame;
}

/// The level map alone.
void map_levels(benchmark::State& state, const std::string& sampling) {
    const Display display = load_display("vive").value();
    const SamplingPreset preset = parse_sampling(sampling).value();
    LevelMap map(display, kLeftEye, *tile_law(display, kLeftEye, preset));
    const TileGrid grid({display.eye_width_px, display.eye_height_px}, {5, 7});
    std::vector<std::uint8_t> levels(static_cast<std::size_t>(grid.tiles.x) * grid.tiles.y);
    for (auto _ : state) {
        map.update(grid, {0.0F, 0.0F, -1.0F}, levels.data(), grid.tiles.x);
        benchmark::DoNotOptimize(levels.data());
    }
}

void solve(benchmark::State& state, const std::string& sampling) {
    const Display display = load_display("vive").value();
    const SamplingPreset preset = parse_sampling(sampling).value();
    for (auto _ : state) benchmark::DoNotOptimize(tile_law(display, kLeftEye, preset));
}

void make_tables(benchmark::State& state) {
    const RankTile tile = make_rank_tile();
    for (auto _ : state) benchmark::DoNotOptimize(TileTables(tile));
}

void make_tile(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(make_rank_tile());
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    for (const char* display : {"vive", "desktop"}) {
        for (const char* sampling : {"full", "54", "41", "27", "18"}) {
            benchmark::RegisterBenchmark((std::string("plan/") + display + "/" + sampling).c_str(),
                                         [=](benchmark::State& s) { macula::plan_frames(s, display, sampling); })
                ->Unit(benchmark::kMillisecond);
        }
    }
    for (const char* sampling : {"27", "paper-18", "watson-27", "castle-csf-27"}) {
        benchmark::RegisterBenchmark((std::string("levels/vive/") + sampling).c_str(), [=](benchmark::State& s) {
            macula::map_levels(s, sampling);
        })->Unit(benchmark::kMicrosecond);
        benchmark::RegisterBenchmark((std::string("solve/vive/") + sampling).c_str(), [=](benchmark::State& s) {
            macula::solve(s, sampling);
        })->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark("rank_tile", macula::make_tile)->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("tile_tables", macula::make_tables)->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
