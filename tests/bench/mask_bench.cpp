// Making masks: each placement's by the two presets, and from a mask to a mesh, made and read from the cache.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "masks/make/mesh_store.h"

namespace macula {
namespace {

Recipe recipe_of(Placement placement, const char* sampling) {
    return {load_display("vive").value(), parse_sampling(sampling).value(), placement};
}

void make(benchmark::State& state, Placement placement, const char* sampling) {
    const Recipe recipe = recipe_of(placement, sampling);
    for (auto _ : state) benchmark::DoNotOptimize(make_mask(recipe).value());
}

void triangulate(benchmark::State& state, Placement placement, const char* sampling) {
    const Mask mask = make_mask(recipe_of(placement, sampling)).value();
    std::size_t sites = 0;
    for (auto _ : state) sites = triangulate_mask(mask).site.size();
    state.counters["sites"] = static_cast<double>(sites);
}

void load(benchmark::State& state, Placement placement, const char* sampling) {
    const Recipe recipe = recipe_of(placement, sampling);
    const auto cache = std::filesystem::temp_directory_path() / "macula_mask_bench";
    benchmark::DoNotOptimize(obtain_mesh(recipe, cache).value());
    for (auto _ : state) benchmark::DoNotOptimize(obtain_mesh(recipe, cache).value());
    std::filesystem::remove_all(cache);
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    using macula::Placement;
    for (const char* sampling : {"27", "54"}) {
        for (const Placement placement : {Placement::void_and_cluster, Placement::floyd_steinberg,
                                          Placement::poisson_disk, Placement::white_noise, Placement::quincunx}) {
            const std::string name = macula::to_string(placement) + "/" + sampling;
            benchmark::RegisterBenchmark(("make/" + name).c_str(), macula::make, placement, sampling)
                ->Unit(benchmark::kMillisecond);
            benchmark::RegisterBenchmark(("triangulate/" + name).c_str(), macula::triangulate, placement, sampling)
                ->Unit(benchmark::kMillisecond);
            benchmark::RegisterBenchmark(("load/" + name).c_str(), macula::load, placement, sampling)
                ->Unit(benchmark::kMillisecond);
        }
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
