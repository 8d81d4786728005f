// Plan and reconstruction of one eye of the Vive, 1512x1680, by the published ways to place samples on grids, with a
// gaze that drifts and a phase that changes every frame. One thread unless the argument says otherwise.
//
// Run with --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true and read the minima: `cpu_min_ms` is
// the least processor time of the calling thread of a frame, which other work on the machine disturbs least.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>

#include <tbb/global_control.h>
#include <glm/geometric.hpp>

#include "masks/display.h"
#include "masks/rivals/layer_sampler.h"
#include "masks/rivals/log_polar_sampler.h"
#include "masks/rivals/uniform_sampler.h"
#include "protocol/gl/context.h"
#include "server/render/grid_reconstructors.h"

namespace macula {
namespace {

constexpr int kFull = 100;

std::unique_ptr<Sampler> make_sampler(const std::string& name, int percent) {
    static const Display kDisplay = load_display("vive").value();
    const double share = percent / 100.0;
    if (name == "uniform") return std::make_unique<UniformSampler>(kDisplay, kLeftEye, share);
    if (name == "layers") return std::make_unique<LayerSampler>(kDisplay, kLeftEye, share);
    return LogPolarSampler::make(kDisplay, kLeftEye, share).value();
}

PlanRequest request_of(int frame) {
    PlanRequest request;
    const double turn = 0.01 * frame;
    request.gaze_eye = glm::normalize(glm::vec3(0.2 * std::cos(turn), 0.2 * std::sin(turn), -1.0));
    request.phase_px = glm::ivec2(64.0 * std::fmod(frame * 0.75488, 1.0), 64.0 * std::fmod(frame * 0.56984, 1.0));
    return request;
}

double thread_time_ms() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void plan_frames(benchmark::State& state, const std::string& name, int percent) {
    const auto sampler = make_sampler(name, percent);
    SamplePlan plan;
    sampler->plan(request_of(0), plan);
    int frame = 0;
    double share = 0.0;
    double least_ms = 1e9;
    for (auto _ : state) {
        const double begin_ms = thread_time_ms();
        sampler->plan(request_of(++frame), plan);
        least_ms = std::min(least_ms, thread_time_ms() - begin_ms);
        benchmark::DoNotOptimize(plan.trace_order.data());
        share += plan.traced_share();
    }
    state.counters["share"] = share / frame;
    state.counters["cpu_min_ms"] = least_ms;
}

void reconstruct_frames(benchmark::State& state, Reconstructor& reconstructor, const std::string& name, int percent) {
    const auto sampler = make_sampler(name, percent);
    SamplePlan plan;
    sampler->plan(request_of(1), plan);
    Samples samples;
    samples.color.resize(plan.address_count());
    samples.inverse_depth_per_m.assign(plan.address_count(), -1.0F);
    for (const std::uint32_t address : plan.trace_order) {
        const int x = plan.position[address].x_px;
        const int y = plan.position[address].y_px;
        samples.color[address] = static_cast<Rgba8>((x * x + 3 * y * y) / 64 * 0x010203 + x) | 0xFF000000U;
        samples.inverse_depth_per_m[address] =
            (x / 90 + y / 70) % 3 == 0 ? 0.0F : 0.2F + 0.0002F * static_cast<float>(x + y);
    }
    ColorImage color(plan.width_px, plan.height_px);
    InverseDepthImage depth(plan.width_px, plan.height_px);
    const auto width = static_cast<std::size_t>(plan.width_px);
    double least_ms = 1e9;
    for (auto _ : state) {
        const double begin_ms = thread_time_ms();
        if (const auto done =
                reconstructor.reconstruct(plan, samples, {color.texels.data(), width, depth.texels.data(), width});
            !done)
            return state.SkipWithError(done.error().message.c_str());
        least_ms = std::min(least_ms, thread_time_ms() - begin_ms);
    }
    state.counters["cpu_min_ms"] = least_ms;
}

void add(const std::string& name, int percent) {
    const std::string suffix = "/" + name + "/" + (percent == kFull ? "full" : std::to_string(percent));
    benchmark::RegisterBenchmark(("plan" + suffix).c_str(), [=](benchmark::State& state) {
        plan_frames(state, name, percent);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("cpp" + suffix).c_str(), [=](benchmark::State& state) {
        const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
        reconstruct_frames(state, *make_cpu_grid_reconstructor(), name, percent);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("gl" + suffix).c_str(),
                                 [=](benchmark::State& state) {
                                     auto context = make_gl_context(ContextKind::automatic);
                                     if (!context) return state.SkipWithError(context.error().message.c_str());
                                     auto reconstructor = make_gl_grid_reconstructor(std::move(*context));
                                     if (!reconstructor)
                                         return state.SkipWithError(reconstructor.error().message.c_str());
                                     state.SetLabel((*reconstructor)->name());
                                     reconstruct_frames(state, **reconstructor, name, percent);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    for (const int percent : {100, 54, 27, 18})
        for (const char* name : {"uniform", "layers", "log-polar"})
            if (percent < macula::kFull || std::string(name) != "log-polar") macula::add(name, percent);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
