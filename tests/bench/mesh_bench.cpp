// What a mesh costs once: triangulation, checks, writing and reading its file. `random` scatters sites over a mask of
// twice the width and height of a vive eye; `grid` is all pixels of one eye, which are cocircular everywhere. Counter
// peak_MB: memory above that of the sites, at its peak.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "masks/mesh/mesh_file.h"
#include "masks/mesh/mesh_quality.h"
#include "masks/mesh/triangulate.h"
#include "tests/support/triangulated.h"

namespace macula {
namespace {

constexpr int kEyeWidth_px = 1512;
constexpr int kEyeHeight_px = 1680;

/// A value of /proc/self/status, in MB.
double status_mb(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kib = 0.0;
        if (word == name + ":" && status >> kib) return kib / 1024.0;
    }
    return 0.0;
}

/// Sites of a full grid of one eye for a density of 1, else scattered over a whole mask.
SampleMesh sites_of(double density) {
    std::mt19937 random(1);
    SampleMesh mesh;
    const bool grid = density == 1.0;
    mesh.width_px = grid ? kEyeWidth_px : 2 * kEyeWidth_px;
    mesh.height_px = grid ? kEyeHeight_px : 2 * kEyeHeight_px;
    mesh.site = testing::scattered_sites(mesh.width_px, mesh.height_px, density, random);
    mesh.recipe = "{}";
    return mesh;
}

void bench_triangulate(benchmark::State& state, double density) {
    const SampleMesh mesh = sites_of(density);
    std::ofstream("/proc/self/clear_refs") << 5;  // forgets the peak
    const double before = status_mb("VmRSS");
    std::size_t triangles = 0;
    for (auto _ : state) triangles = triangulate(mesh.site).size();
    state.counters["peak_MB"] = status_mb("VmHWM") - before;
    state.counters["sites"] = static_cast<double>(mesh.site.size());
    state.counters["triangles"] = static_cast<double>(triangles);
}

void bench_file(benchmark::State& state, double density, const std::string& what) {
    SampleMesh mesh = sites_of(density);
    mesh.triangle = triangulate(mesh.site);
    const std::string path =
        (std::filesystem::temp_directory_path() / ("mesh_bench_" + std::to_string(::getpid()) + ".glb")).string();
    if (!write_mesh(mesh, path)) return state.SkipWithError("the file cannot be written");
    for (auto _ : state) {
        if (what == "write") benchmark::DoNotOptimize(write_mesh(mesh, path).has_value());
        if (what == "read") benchmark::DoNotOptimize(read_mesh(path).has_value());
        if (what == "check") benchmark::DoNotOptimize(mesh_defect(mesh).size());
        if (what == "triangle_quality") benchmark::DoNotOptimize(triangle_quality(mesh).aspect_p50);
    }
    state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(path)) / 1048576.0;
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    struct Case {
        const char* name;
        double density;
    };
    const std::vector<Case> cases = {
        {"random_160k", 0.016}, {"random_640k", 0.064}, {"random_2.5M", 0.25}, {"grid", 1.0}};
    for (const Case& c : cases) {
        benchmark::RegisterBenchmark((std::string("triangulate/") + c.name).c_str(), [c](benchmark::State& s) {
            macula::bench_triangulate(s, c.density);
        })->Unit(benchmark::kMillisecond);
    }
    for (const char* what : {"write", "read", "check", "triangle_quality"}) {
        benchmark::RegisterBenchmark((std::string(what) + "/random_2.5M").c_str(), [what](benchmark::State& s) {
            macula::bench_file(s, 0.25, what);
        })->Unit(benchmark::kMillisecond);
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
