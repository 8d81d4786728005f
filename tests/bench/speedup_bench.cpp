// What foveation gains: time of a stereo frame's plan, trace and reconstruction at several shares against full
// sampling, taken in turn in one run. The share of 1/fraction tells how much of the saved rays became saved time:
// 1 is proportional, and fixed costs and less coherent packets take away from it.
//
// usage: speedup_bench [display] [scene] [rounds]

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/tile_sampler.h"
#include "protocol/base/clock.h"
#include "scenes/load.h"
#include "server/render/reconstructor.h"
#include "server/render/tracer.h"

namespace {

using namespace macula;

/// The stages of one stereo frame, in milliseconds.
struct FrameTime {
    double plan = 0.0;
    double trace = 0.0;
    double reconstruct = 0.0;
    [[nodiscard]] double trace_and_reconstruct() const { return trace + reconstruct; }
};

double percentile(std::vector<double> values, double p) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1) + 0.5)];
}

/// Everything that renders frames at one sampling; pictures are kept as a session keeps them.
class Pipeline {
public:
    Pipeline(const std::string& sampling, const Display& display, const Scene& scene, const Tracer& tracer,
             const std::shared_ptr<const TileTables>& tables)
        : name(sampling),
          tracer_(tracer),
          reconstructor_(make_cpu_reconstructor(tables)),
          color_(2 * display.eye_width_px, display.eye_height_px),
          depth_(2 * display.eye_width_px, display.eye_height_px) {
        const SamplingPreset preset = parse_sampling(sampling).value();
        for (const Eye eye : {kLeftEye, kRightEye}) {
            samplers_[eye] = std::make_unique<TileSampler>(display, eye, tile_law(display, eye, preset), tables);
            views_[eye] = {scene.world_from_start * display.eyes[eye].head_from_eye, display.eyes[eye].tangents,
                           display.eye_width_px, display.eye_height_px};
        }
    }

    FrameTime render(int frame) {
        const std::int64_t begin = now_ns();
        std::array<TraceTask, kEyeCount> tasks;
        for (const Eye eye : {kLeftEye, kRightEye}) {
            samplers_[eye]->plan({.phase_px = {frame * 13 % 64, frame * 29 % 64}}, plans_[eye]);
            tasks[eye] = {&views_[eye], &plans_[eye], &samples_[eye]};
        }
        const std::int64_t planned = now_ns();
        tracer_.trace(tasks);
        const std::int64_t traced = now_ns();
        for (const Eye eye : {kLeftEye, kRightEye}) {
            const int left = eye * plans_[eye].width_px;
            const auto stride = static_cast<std::size_t>(color_.width_px);
            if (!reconstructor_->reconstruct(plans_[eye], samples_[eye],
                                             {color_.row(0) + left, stride, depth_.row(0) + left, stride}))
                std::abort();
        }
        const std::int64_t done = now_ns();
        const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-6; };
        return {ms(planned - begin), ms(traced - planned), ms(done - traced)};
    }

    [[nodiscard]] std::size_t rays() const { return plans_[0].trace_order.size() + plans_[1].trace_order.size(); }

    std::string name;
    std::vector<FrameTime> times;

private:
    const Tracer& tracer_;
    std::unique_ptr<Reconstructor> reconstructor_;
    PerEye<std::unique_ptr<TileSampler>> samplers_;
    PerEye<EyeView> views_;
    PerEye<SamplePlan> plans_;
    PerEye<Samples> samples_;
    ColorImage color_;
    InverseDepthImage depth_;
};

/// Quantile of a figure over the frames of a pipeline.
template <class Figure>
double quantile(const Pipeline& pipeline, double p, Figure figure) {
    std::vector<double> values;
    for (const FrameTime& time : pipeline.times) values.push_back(figure(time));
    return percentile(std::move(values), p);
}

/// Median over the rounds of full's time over this pipeline's time in the same round.
double speed_up(const Pipeline& full, const Pipeline& pipeline) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < full.times.size(); ++i)
        ratios.push_back(full.times[i].trace_and_reconstruct() / pipeline.times[i].trace_and_reconstruct());
    return percentile(std::move(ratios), 0.5);
}

}  // namespace

int main(int argc, char** argv) {
    const auto display = load_display(argc > 1 ? argv[1] : "vive");
    const auto loaded = load_scene(argc > 2 ? argv[2] : "bunny-box");
    const int rounds = argc > 3 ? std::max(1, std::atoi(argv[3])) : 15;
    if (!display || !loaded) {
        std::fprintf(stderr, "speedup_bench: %s\n", (!display ? display.error() : loaded.error()).message.c_str());
        return static_cast<int>((!display ? display.error() : loaded.error()).code);
    }
    const auto tracer = make_embree_tracer(loaded->scene);
    if (!tracer) {
        std::fprintf(stderr, "speedup_bench: %s\n", tracer.error().message.c_str());
        return static_cast<int>(tracer.error().code);
    }
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    std::vector<std::unique_ptr<Pipeline>> pipelines;
    for (const char* sampling : {"full", "54", "41", "27", "18"})
        pipelines.push_back(std::make_unique<Pipeline>(sampling, *display, *loaded->scene, **tracer, tables));

    for (int round = -1; round < rounds; ++round) {  // the first round warms up
        for (auto& pipeline : pipelines) {
            const FrameTime time = pipeline->render(round + 1);
            if (round >= 0) pipeline->times.push_back(time);
        }
    }

    std::printf("%s, %s, %d rounds; stereo frame, milliseconds, p50 (p99)\n", display->name.c_str(),
                loaded->scene->name.c_str(), rounds);
    std::printf("%-8s %10s %9s %8s %18s %18s %18s %9s %20s\n", "sampling", "rays", "of full", "plan", "trace",
                "reconstruct", "trace+reconstruct", "speed-up", "share of 1/fraction");
    const Pipeline& full = *pipelines.front();
    for (const auto& pipeline : pipelines) {
        const auto cell = [&](auto figure) {
            static std::array<char, 32> text;
            std::snprintf(text.data(), text.size(), "%.1f (%.1f)", quantile(*pipeline, 0.5, figure),
                          quantile(*pipeline, 0.99, figure));
            return std::string(text.data());
        };
        const double fraction = static_cast<double>(pipeline->rays()) / static_cast<double>(full.rays());
        const double gain = speed_up(full, *pipeline);
        std::printf("%-8s %10zu %8.1f%% %8.2f %18s %18s %18s %8.2fx %20.3f\n", pipeline->name.c_str(), pipeline->rays(),
                    100.0 * fraction, quantile(*pipeline, 0.5, [](const FrameTime& t) { return t.plan; }),
                    cell([](const FrameTime& t) { return t.trace; }).c_str(),
                    cell([](const FrameTime& t) { return t.reconstruct; }).c_str(),
                    cell([](const FrameTime& t) { return t.trace_and_reconstruct(); }).c_str(), gain, gain * fraction);
    }
    return 0;
}
