// What a picture costs the client: temporal anti-aliasing and late reprojection. Run with
// --benchmark_repetitions=5 and take the minimum: the figures are CPU time of one thread.

#include <memory>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "masks/rank_tile.h"

namespace macula {
namespace {

/// A frame of noise at the 18 % preset's density, seen by a head that turns and moves.
struct Input {
    Display display;
    RankTile rank_tile = make_rank_tile();
    ColorImage color;
    InverseDepthImage depth;
    EyeSamplingMessage sampling;
    std::vector<MovingObject> moving;
    Image<std::uint8_t> moving_map;

    explicit Input(const char* name) : display(*load_display(name)) {
        const int width = display.eye_width_px;
        const int height = display.eye_height_px;
        color = ColorImage(2 * width, height);
        depth = InverseDepthImage(width / 2, height / 4);
        std::mt19937 random(1);
        for (Rgba8& texel : color.texels) texel = static_cast<Rgba8>(random()) | 0xFF000000U;
        for (float& texel : depth.texels) texel = 0.2F + 0.01F * static_cast<float>(random() % 16);
        sampling.tiles_x = (width + 15) / 16 + 1;
        sampling.tiles_y = (height + 15) / 16 + 1;
        for (int i = 0; i < sampling.tiles_x * sampling.tiles_y; ++i) {
            sampling.level.push_back(static_cast<std::uint8_t>(1 + random() % kFullLevel));
        }
    }
    /// Three objects cover this share of the blocks, as a band across the picture.
    void move(double share) {
        for (std::uint32_t id = 1; id <= 3; ++id) {
            MovingObject object;
            object.id = id;
            object.world_from_object[3].z = -2.0F;
            object.velocity_per_s[3].x = 0.5F;
            moving.push_back(object);
        }
        moving_map = Image<std::uint8_t>(depth.width_px, depth.height_px);
        const int rows = static_cast<int>(share * moving_map.height_px);
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < moving_map.width_px; ++x) {
                moving_map.at(x, y + (moving_map.height_px - rows) / 2) = static_cast<std::uint8_t>(1 + x / 20 % 3);
            }
        }
    }
    [[nodiscard]] PerEye<Pose> poses(int step) const {
        const float t = 0.01F * static_cast<float>(step % 100);
        const Pose head{glm::angleAxis(0.3F * t, glm::vec3(0.1F, 0.99F, 0.0F)), glm::vec3(0.2F * t, 0.0F, 0.1F * t)};
        return {head * display.eyes[0].head_from_eye, head * display.eyes[1].head_from_eye};
    }
    [[nodiscard]] NewFrame frame(int step) const {
        NewFrame frame;
        frame.color = &color;
        frame.depth = &depth;
        frame.world_from_eye = poses(step);
        frame.sampling = {&sampling, &sampling};
        frame.rank_tile = rank_tile.rank;
        frame.rank_tile_size_px = RankTile::kEdge_px;
        frame.moving = moving;
        frame.moving_map = &moving_map;
        return frame;
    }
};

/// `moving_share` of the picture moves by itself; 0: the scene is still.
void accumulate(benchmark::State& state, const char* display, double moving_share) {
    const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    Input input(display);
    if (moving_share > 0.0) input.move(moving_share);
    const auto compositor = make_cpu_compositor(input.display, default_taa_weights());
    int step = 0;
    for (auto _ : state) benchmark::DoNotOptimize(compositor->accumulate(input.frame(step++)).has_value());
}

void reproject(benchmark::State& state, const char* display, double moving_share) {
    const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    Input input(display);
    if (moving_share > 0.0) input.move(moving_share);
    const auto compositor = make_cpu_compositor(input.display, default_taa_weights());
    static_cast<void>(compositor->accumulate(input.frame(0)));
    ColorImage picture;
    int step = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(compositor->show(input.poses(1 + step++ % 4), 10'000'000, picture).has_value());
}

BENCHMARK_CAPTURE(accumulate, desktop, "desktop", 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reproject, desktop, "desktop", 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(accumulate, vive, "vive", 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reproject, vive, "vive", 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(accumulate, vive_a_tenth_moving, "vive", 0.1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reproject, vive_a_tenth_moving, "vive", 0.1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(accumulate, vive_all_moving, "vive", 1.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reproject, vive_all_moving, "vive", 1.0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
