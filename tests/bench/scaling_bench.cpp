// How the cost of a sample grows with the number of triangles: tracing with shading and shadows, and Embree alone on
// the very same rays, on one place made of more and more triangles. Both are timed in turn, and the best time of each
// counts. Surfaces are two-sided. Besides: the memory that a triangle takes.
//
// usage: scaling_bench [options of Google Benchmark]; the largest scene takes 4 GB

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/shapes.h"
#include "server/render/tracer.h"
#include "tests/support/bare_embree.h"
#include "tests/support/plans.h"
#include "tests/support/stopwatch.h"

namespace macula {
namespace {

constexpr int kSize_px = 640;

/// Ball with bumps of several sizes, of about `segments`^2 triangles.
Mesh bumpy_ball(int segments) {
    Mesh ball = make_sphere(1.0F, segments);
    for (std::size_t i = 0; i < ball.position_m.size(); ++i) {
        glm::vec3& p = ball.position_m[i];
        float bump = 0.0F;
        for (const float frequency : {5.0F, 13.0F, 37.0F})
            bump +=
                std::sin(frequency * p.x + 1.0F) * std::sin(frequency * p.y) * std::sin(frequency * p.z) / frequency;
        p *= 1.0F + 0.4F * bump;
    }
    return ball;
}

/// Nine by nine bumpy balls over a ground, under a sun. The triangles are shared out evenly.
std::shared_ptr<const Scene> field_of_balls(double triangles) {
    constexpr int kRow = 9;
    auto scene = std::make_shared<Scene>();
    scene->materials.resize(2);
    for (Material& material : scene->materials) {
        material.metallic = 0.0F;
        material.double_sided = true;
    }
    scene->ambient_radiance = glm::vec3(0.1F);
    scene->lights.push_back({.direction = glm::normalize(glm::vec3(0.5F, -0.7F, -0.4F)), .intensity = glm::vec3(3.0F)});
    // Each ball has a mesh of its own: memory is that of a scene without instancing.
    const int segments = static_cast<int>(std::lround(std::sqrt(triangles / (kRow * kRow))));
    const Mesh ball = bumpy_ball(segments);
    for (int i = 0; i < kRow * kRow; ++i) {
        const glm::vec3 place(2.6F * static_cast<float>(i % kRow - kRow / 2), 1.0F,
                              -2.6F * static_cast<float>(i / kRow));
        scene->instances.push_back({"ball", static_cast<int>(scene->meshes.size()),
                                    glm::rotate(glm::translate(glm::mat4(1.0F), place), 0.7F * static_cast<float>(i),
                                                glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F)))});
        scene->meshes.push_back(ball);
    }
    scene->instances.push_back({"ground", static_cast<int>(scene->meshes.size()), glm::mat4(1.0F)});
    scene->meshes.push_back(make_quad({-60.0F, 0.0F, -60.0F}, {120.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 120.0F}));
    scene->meshes.back().material = 1;
    scene->world_from_start = {glm::angleAxis(-0.35F, glm::vec3(1.0F, 0.0F, 0.0F)), {0.0F, 5.0F, 7.0F}};
    return scene;
}

std::size_t bytes_of(const Scene& scene) {
    std::size_t bytes = 0;
    for (const Mesh& mesh : scene.meshes) {
        bytes += mesh.position_m.capacity() * sizeof(glm::vec3) + mesh.normal.capacity() * sizeof(glm::vec3) +
                 mesh.uv0.capacity() * sizeof(glm::vec2) + mesh.triangle.capacity() * sizeof(glm::uvec3);
    }
    return bytes;
}

/// Memory of this process that is in use now.
double resident_bytes() {
    double pages = 0.0;
    std::ifstream file("/proc/self/statm");
    file >> pages >> pages;  // the second number is the resident size
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

struct Cost {
    double ours_ns;
    double bare_ns;
};

/// One picture of the field of about `range(0)` triangles, every pixel.
void grow(benchmark::State& state) {
    static std::map<std::int64_t, Cost> costs;
    const double before_bytes = resident_bytes();
    const std::shared_ptr<const Scene> scene = field_of_balls(static_cast<double>(state.range(0)));
    const auto tracer = make_embree_tracer(scene);
    if (!tracer) return state.SkipWithError("the tracer failed");
    const double after_bytes = resident_bytes();

    EyeView view;
    view.world_from_eye = scene->world_from_start;
    view.width_px = view.height_px = kSize_px;
    const SamplePlan plan = test::full_plan(kSize_px, kSize_px);
    Samples samples;
    const TraceTask task{&view, &plan, &samples};
    test::Recorder recorder;
    TraceCounts counts;
    {
        const auto tapped = make_embree_tracer(scene, {}, &recorder);
        if (!tapped) return state.SkipWithError("the tracer failed");
        recorder.recording = true;
        counts = (*tapped)->trace({&task, 1});
    }
    const test::BareEmbree bare(*scene, recorder.take());

    test::Best ours;
    test::Best alone;
    for (auto _ : state) {
        const test::Stopwatch ours_watch;
        (*tracer)->trace({&task, 1});
        ours.add(ours_watch);
        const test::Stopwatch bare_watch;
        benchmark::DoNotOptimize(bare.trace());
        alone.add(bare_watch);
    }
    const auto rays = static_cast<double>(plan.trace_order.size());
    const Cost cost{ours.cpu_s * 1e9 / rays, alone.cpu_s * 1e9 / rays};
    costs[state.range(0)] = cost;
    const Cost& first = costs.begin()->second;
    const auto triangles = static_cast<double>(scene->triangle_count());
    state.counters["triangles"] = triangles;
    state.counters["cpu_ns_per_sample"] = cost.ours_ns;
    state.counters["bare_cpu_ns_per_sample"] = cost.bare_ns;
    state.counters["share_of_bare_speed"] = alone.wall_s / ours.wall_s;
    state.counters["own_cpu_ns_per_sample"] = cost.ours_ns - cost.bare_ns;
    state.counters["shadow_rays_per_sample"] = static_cast<double>(counts.shadow) / rays;
    state.counters["growth"] = cost.ours_ns / first.ours_ns;
    state.counters["bare_growth"] = cost.bare_ns / first.bare_ns;
    state.counters["growth_over_bare"] = (cost.ours_ns / first.ours_ns) / (cost.bare_ns / first.bare_ns);
    state.counters["scene_bytes_per_triangle"] = static_cast<double>(bytes_of(*scene)) / triangles;
    state.counters["tracer_bytes_per_triangle"] = static_cast<double>((*tracer)->memory_bytes()) / triangles;
    state.counters["resident_bytes_per_triangle"] = (after_bytes - before_bytes) / triangles;
}
BENCHMARK(grow)->Arg(50'000)->Arg(500'000)->Arg(5'000'000)->Iterations(9)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
