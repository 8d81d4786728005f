// Which weights of temporal accumulation are best, at rest and under head motion: PSNR of the accumulated pictures
// against 16 rays a pixel, on a synthetic moving scene that is sampled and reconstructed as the server does. Prints a
// table; taa_settings.h has the choice. Not a timing: the figures do not depend on the machine.

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "client/device/replay.h"
#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "tests/support/moving_scene.h"

namespace macula {
namespace {

using kernels::TaaWeights;

constexpr int kFrames = 36;
constexpr int kEvery = 6;  ///< of the second half of the frames, each kEvery-th is judged

struct Motion {
    std::string name;
    std::vector<Pose> poses;
};

Motion still() {
    return {"still", std::vector<Pose>(kFrames)};
}

Motion turn(double fps) {
    Motion motion{"turn 20 deg/s, " + std::to_string(static_cast<int>(fps)) + " fps", {}};
    for (int i = 0; i < kFrames; ++i) {
        const auto t = static_cast<float>(i / fps);
        motion.poses.push_back({glm::angleAxis(0.35F * t, glm::vec3(0.0F, 1.0F, 0.0F)), glm::vec3(0.0F)});
    }
    return motion;
}

Motion sway(double fps) {
    Motion motion{"sway .2 m/s, " + std::to_string(static_cast<int>(fps)) + " fps", {}};
    for (int i = 0; i < kFrames; ++i) {
        const auto t = static_cast<float>(i / fps);
        motion.poses.push_back({glm::quat(1.0F, 0.0F, 0.0F, 0.0F), glm::vec3(0.15F * std::sin(1.33F * t), 0.0F, 0.0F)});
    }
    return motion;
}

/// Second to last part of a recording.
std::optional<Motion> recorded(const std::string& file, double fps) {
    auto recording = load_recording(std::string(MACULA_SOURCE_DIR "/../shared/gaze/") + file);
    if (!recording) return std::nullopt;
    Motion motion{file.substr(10) + ", " + std::to_string(static_cast<int>(fps)) + " fps", {}};
    const auto replay = make_replay(std::move(*recording), true);
    replay->begin(0);
    for (int i = 0; i < kFrames; ++i) {
        const auto now_ns = static_cast<std::int64_t>(1e9 * (1.0 + i / fps));
        Pose pose = motion.poses.empty() ? Pose{} : motion.poses.back();
        while (const auto sample = replay->next(now_ns)) pose = sample->start_from_head;
        motion.poses.push_back(pose);
    }
    return motion;
}

struct Config {
    const char* name;
    TaaWeights weights;
};

std::vector<Config> configs() {
    const auto with = [](auto&& change) {
        TaaWeights weights = default_taa_weights();
        change(weights);
        return weights;
    };
    const auto plain = [&](float traced, float interpolated) {
        // Fixed weights: precisions p / (1 + p) of a full history, without the rest.
        return with([&](TaaWeights& w) {
            w.traced = traced / (1.0F - traced);
            w.interpolated = interpolated / (1.0F - interpolated);
            w.moving_loss = 0.0F;
        });
    };
    return {
        {"no accumulation", no_taa_weights()},
        {"default", default_taa_weights()},
        {"the paper's", paper_taa_weights()},
        {"weights .10 / .10", plain(0.10F, 0.10F)},
        {"weights .50 / .10", plain(0.50F, 0.10F)},
        {"weights .50 / .05", plain(0.50F, 0.05F)},
        {"weights .50 / .02", plain(0.50F, 0.02F)},
        {"interpolated .05", with([](TaaWeights& w) { w.interpolated = 0.05F; })},
        {"interpolated .10", with([](TaaWeights& w) { w.interpolated = 0.10F; })},
        {"traced .5", with([](TaaWeights& w) { w.traced = 0.5F; })},
        {"traced .25", with([](TaaWeights& w) { w.traced = 0.25F; })},
        {"moving loss 0", with([](TaaWeights& w) { w.moving_loss = 0.0F; })},
        {"moving loss .8", with([](TaaWeights& w) { w.moving_loss = 0.8F; })},
        {"moving loss .95", with([](TaaWeights& w) { w.moving_loss = 0.95F; })},
        {"disparity .5 px", with([](TaaWeights& w) { w.disparity_px = 0.5F; })},
        {"disparity 3 px", with([](TaaWeights& w) { w.disparity_px = 3.0F; })},
        {"no rejection by depth", with([](TaaWeights& w) { w.disparity_px = 1e9F; })},
    };
}

struct Made {
    ColorImage color;
    InverseDepthImage depth;
    EyeSamplingMessage sampling;
    NewFrame frame;
    ColorImage reference;  ///< empty where it is not judged
};

struct Quality {
    double squares = 0.0;
    double values = 0.0;
    double flicker = 0.0;
    double steps = 0.0;
    [[nodiscard]] double psnr_db() const { return 10.0 * std::log10(255.0 * 255.0 * values / squares); }
    [[nodiscard]] double flicker_rms() const { return std::sqrt(flicker / steps) / 255.0; }
};

Quality judge(const Display& display, const std::vector<Made>& frames, const TaaWeights& weights,
              const std::vector<std::uint8_t>& hidden) {
    const auto compositor = make_cpu_compositor(display, weights);
    Quality quality;
    ColorImage picture;
    ColorImage before;
    for (const Made& made : frames) {
        static_cast<void>(compositor->accumulate(made.frame));
        static_cast<void>(compositor->show(made.frame.world_from_eye, 0, picture));
        for (int y = 0; y < display.eye_height_px; ++y) {
            for (int x = 0; x < display.eye_width_px; ++x) {
                if (hidden[static_cast<std::size_t>(y * display.eye_width_px + x)] != 0) continue;
                for (int shift = 0; shift < 24; shift += 8) {
                    const double value = picture.at(x, y) >> shift & 255U;
                    if (!made.reference.texels.empty()) {
                        const double d = value - (made.reference.at(x, y) >> shift & 255U);
                        quality.squares += d * d;
                        quality.values += 1.0;
                        const double step = value - (before.at(x, y) >> shift & 255U);
                        quality.flicker += step * step;
                        quality.steps += 1.0;
                    }
                }
            }
        }
        before = picture;
    }
    return quality;
}

void measure(const Display& display, const Motion& motion, std::optional<double> share) {
    test::FoveatedView view(display, share);
    std::vector<Made> frames(motion.poses.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Made& made = frames[i];
        made.frame = view.frame(static_cast<int>(i), motion.poses[i]);
        made.color = view.color;
        made.depth = view.depth;
        made.sampling = *made.frame.sampling[0];
        made.frame.color = &made.color;
        made.frame.depth = &made.depth;
        made.frame.sampling = {&made.sampling, &made.sampling};
        if (i >= frames.size() / 2 && (i + 1) % kEvery == 0) {
            made.reference = test::reference_picture(view.view(motion.poses[i]));
        }
    }
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, kLeftEye);
    std::printf("\n%s, %s traced\n", motion.name.c_str(),
                share ? (std::to_string(static_cast<int>(100.0 * *share)) + " %").c_str() : "all");
    for (const Config& config : configs()) {
        const Quality quality = judge(display, frames, config.weights, hidden);
        std::printf("  %-24s %6.2f dB   change %.4f\n", config.name, quality.psnr_db(), quality.flicker_rms());
    }
    std::fflush(stdout);
}

}  // namespace
}  // namespace macula

int main() {
    using namespace macula;
    const Display display = *load_display("desktop");
    std::vector<Motion> motions = {still(), turn(30.0), sway(30.0)};
    for (const char* file : {"salient360_rawDataStatic1.csv", "salient360_rawDataDyn1.csv"}) {
        if (auto motion = recorded(file, 30.0)) motions.push_back(*motion);
    }
    for (const Motion& motion : motions) measure(display, motion, 0.18);
    for (const Motion& motion : motions) measure(display, motion, 0.27);
    return 0;
}
