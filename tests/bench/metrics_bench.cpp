// What it costs to judge a frame: the chart does so some thousand times.

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "tests/metrics/clip_meter.h"

namespace macula {
namespace {

constexpr int kWidth = 756;
constexpr int kHeight = 840;

ColorImage noise(std::uint32_t seed) {
    std::mt19937 random(seed);
    ColorImage image(kWidth, kHeight);
    for (Rgba8& texel : image.texels) texel = static_cast<Rgba8>(random()) | 0xFF000000U;
    return image;
}

/// `moving:1`: the gaze is another one in each frame, so that the angle of each pixel is computed anew.
void frame(benchmark::State& state) {
    const bool moving = state.range(0) != 0;
    test::ClipMeter meter({-1.397283F, 1.250510F, -1.477517F, 1.464221F}, kWidth, kHeight, {});
    const ColorImage shown = noise(1);
    const ColorImage reference = noise(2);
    float angle = 0.0F;
    for ([[maybe_unused]] const auto _ : state) {
        if (moving) angle += 1e-3F;
        meter.add(shown, reference, glm::vec3(std::sin(angle), 0.0F, -std::cos(angle)));
    }
    benchmark::DoNotOptimize(meter.figures().psnr_db);
}
BENCHMARK(frame)->ArgName("moving")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
