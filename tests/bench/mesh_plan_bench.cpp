// What a mesh costs at start (read from the cache, and its table) and in each frame: one eye's plan on one core, with
// a gaze that drifts, as the service runs it. Masks that are not in the cache yet are made first, which takes a while.
// Counters: sites and triangles of the mask, share of the pixels traced, samples beyond what is visible.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/make/mesh_store.h"
#include "masks/mesh/mesh_sampler.h"
#include "masks/mesh/mesh_table.h"

namespace macula {
namespace {

template <class T>
T value_of(Expected<T> result) {
    if (result) return *std::move(result);
    std::cerr << result.error().message << "\n";
    std::exit(static_cast<int>(result.error().code));
}

SampleMesh obtain(const std::string& sampling) {
    Recipe recipe;
    recipe.display = value_of(load_display("vive"));
    recipe.preset = value_of(parse_sampling(sampling));
    return value_of(obtain_mesh(recipe, value_of(default_mesh_cache())));
}

/// Made once: each is up to 200 MB.
std::shared_ptr<const MeshTable> table_of(const std::string& sampling) {
    static std::string made;
    static std::shared_ptr<const MeshTable> table;
    if (made != sampling) {
        table.reset();
        table = std::make_shared<const MeshTable>(value_of(MeshTable::make(obtain(sampling))));
        made = sampling;
    }
    return table;
}

void plan_frames(benchmark::State& state, const std::string& sampling, int step_px) {
    const Display display = value_of(load_display("vive"));
    MeshSampler sampler(display, kLeftEye, table_of(sampling), step_px);
    SamplePlan plan;
    int frame = 0;
    double share = 0.0;
    double beyond = 0.0;
    for (auto _ : state) {
        const double turn = 0.01 * ++frame;
        sampler.plan({glm::normalize(glm::vec3(0.2 * std::cos(turn), 0.2 * std::sin(turn), -1.0)), glm::ivec2(0)},
                     plan);
        benchmark::DoNotOptimize(plan.position.data());
        share += plan.traced_share();
        const auto& hidden = *plan.hidden;
        if (frame % 16 != 1) continue;
        state.PauseTiming();
        double unseen = 0.0;
        for (const SamplePosition& p : plan.position) {
            const bool inside = p.x_px >= 0 && p.y_px >= 0 && p.x_px < plan.width_px && p.y_px < plan.height_px;
            unseen += !inside || hidden[static_cast<std::size_t>(p.y_px * plan.width_px + p.x_px)] != 0 ? 1.0 : 0.0;
        }
        beyond = std::max(beyond, unseen);
        state.ResumeTiming();
    }
    state.counters["share"] = share / frame;
    state.counters["unseen"] = beyond;
}

void make_table(benchmark::State& state, const std::string& sampling) {
    const SampleMesh mesh = obtain(sampling);
    for (auto _ : state) {
        state.PauseTiming();
        SampleMesh copy = mesh;
        state.ResumeTiming();
        benchmark::DoNotOptimize(MeshTable::make(std::move(copy)));
    }
    state.counters["sites"] = static_cast<double>(mesh.site.size());
    state.counters["triangles"] = static_cast<double>(mesh.triangle.size());
}

void load(benchmark::State& state, const std::string& sampling) {
    obtain(sampling);
    for (auto _ : state) benchmark::DoNotOptimize(MeshTable::make(obtain(sampling)));
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    for (const std::string sampling : {"full", "54", "41", "27", "18", "paper-54"}) {
        const auto add = [&](const std::string& name, auto run) {
            benchmark::RegisterBenchmark((name + "/" + sampling).c_str(), run)->Unit(benchmark::kMillisecond);
        };
        add("plan", [=](benchmark::State& s) { macula::plan_frames(s, sampling, 1); });
        add("plan_step_16", [=](benchmark::State& s) { macula::plan_frames(s, sampling, 16); });
        add("table", [=](benchmark::State& s) { macula::make_table(s, sampling); });
        add("load", [=](benchmark::State& s) { macula::load(s, sampling); });
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
