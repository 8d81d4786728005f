// What a frame is made of, with fakes for everything that renders.

#include "server/service/frame_maker.h"

#include <gtest/gtest.h>

#include "protocol/base/clock.h"
#include "protocol/message/byte_map.h"

namespace macula {
namespace {

constexpr int kEdge_px = 64;

/// One sample in each 4x4 block.
class GridSampler final : public Sampler {
public:
    void plan(const PlanRequest& /*request*/, SamplePlan& plan) override {
        plan = SamplePlan{};
        plan.width_px = plan.height_px = kEdge_px;
        plan.tiles_x = plan.tiles_y = kEdge_px / 16 + 2;
        plan.level.assign(static_cast<std::size_t>(plan.tiles_x * plan.tiles_y), 7);
        for (int y = 2; y < kEdge_px; y += 4) {
            for (int x = 2; x < kEdge_px; x += 4) {
                plan.trace_order.push_back(static_cast<std::uint32_t>(plan.position.size()));
                plan.position.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
            }
        }
    }
};

constexpr float kMirror_per_m = 0.5F;
constexpr float kImage_per_m = 0.125F;

/// Sees object 1 in the left half and 2, a mirror, in the right one.
class HalvesTracer final : public Tracer {
public:
    TraceCounts trace(std::span<const TraceTask> tasks, double time_s) const noexcept override {
        last_time_s = time_s;
        for (const TraceTask& task : tasks) {
            Samples& samples = *task.samples;
            const std::size_t count = task.plan->position.size();
            samples.color.assign(count, 0xFF000000U);
            samples.inverse_depth_per_m.assign(count, kMirror_per_m);
            samples.object_id.resize(count);
            if (samples.keep_image_depth) samples.image_inverse_depth_per_m.assign(count, kImage_per_m);
            for (std::size_t i = 0; i < count; ++i) {
                samples.object_id[i] = task.plan->position[i].x_px < kEdge_px / 2 ? 1 : 2;
            }
        }
        return {};
    }
    [[nodiscard]] std::string name() const override { return "halves"; }
    [[nodiscard]] std::size_t memory_bytes() const override { return 0; }

    mutable double last_time_s = 0.0;
};

/// Gives each pixel the depth of the first sample.
class FlatReconstructor final : public Reconstructor {
public:
    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        for (int y = 0; y < plan.height_px; ++y) {
            std::fill_n(target.inverse_depth_per_m + static_cast<std::size_t>(y) * target.depth_stride_px,
                        plan.width_px, samples.inverse_depth_per_m[0]);
        }
        return {};
    }
    [[nodiscard]] std::string name() const override { return "flat"; }
};

struct Made {
    explicit Made(Scene scene, bool image_depth = false) {
        Display display;
        display.eye_width_px = display.eye_height_px = kEdge_px;
        FrameMaker::Parts parts;
        parts.scene = std::make_shared<const Scene>(std::move(scene));
        parts.image_depth = image_depth;
        parts.scene_start_ns = now_ns() - 2'000'000'000;
        parts.tracer = tracer;
        for (auto& sampler : parts.samplers) sampler = std::make_unique<GridSampler>();
        parts.reconstructor = std::make_unique<FlatReconstructor>();
        const std::int64_t start_ns = parts.scene_start_ns;
        FrameMaker maker(display, std::move(parts));
        Track track;
        track.pose_time_ns = 77;
        track.display_time_ns = 77 + 30'000'000;
        EXPECT_TRUE(maker.make(track, start_ns + 1'000'000'000, picture));
    }
    std::shared_ptr<HalvesTracer> tracer = std::make_shared<HalvesTracer>();
    Picture picture;
};

Scene two_instances() {
    Scene scene;
    scene.instances.resize(2);
    return scene;
}

TEST(FrameMaker, DepthIsThatOfTheSurfaceUnlessImagesAreWanted) {
    const Made surface(two_instances());
    for (const float depth : surface.picture.inverse_depth.texels) ASSERT_EQ(depth, kMirror_per_m);
    const Made image(two_instances(), true);
    for (const float depth : image.picture.inverse_depth.texels) ASSERT_EQ(depth, kImage_per_m);
}

TEST(FrameMaker, SceneIsTracedAsItStandsWhenTheFrameIsShown) {
    const Made made(two_instances());
    EXPECT_NEAR(made.tracer->last_time_s, 1.030, 1e-9);
    EXPECT_TRUE(made.picture.frame.moving.empty());
    EXPECT_TRUE(made.picture.frame.moving_map.empty());
}

TEST(FrameMaker, FramesOfMovingScenesSayWhatMoves) {
    Scene scene = two_instances();
    scene.instances[0].node = 0;
    scene.animation.nodes.resize(1);
    AnimationChannel slide;
    slide.time_s = {0.0F, 2.0F};
    slide.value = {glm::vec4(0.0F), glm::vec4(0.0F, 2.0F, 0.0F, 0.0F)};
    slide.period_s = scene.animation.duration_s = 2.0F;
    scene.animation.channels.push_back(slide);
    for (const bool image_depth : {false, true}) {
        const Made made(scene, image_depth);
        const Frame& frame = made.picture.frame;
        ASSERT_EQ(frame.moving.size(), 1U);
        EXPECT_EQ(frame.moving[0].id, 1U);
        EXPECT_NEAR(frame.moving[0].world_from_object[3].y, 1.030F, 1e-5F);
        EXPECT_NEAR(frame.moving[0].velocity_per_s[3].y, 1.0F, 1e-3F);
        const int columns = kEdge_px / 4;
        const auto map = unpack_map(frame.moving_map, static_cast<std::size_t>(2 * columns * columns));
        ASSERT_TRUE(map) << map.error().message;
        for (int i = 0; i < 2 * columns * columns; ++i) {
            ASSERT_EQ((*map)[static_cast<std::size_t>(i)], i % columns < columns / 2 ? 1 : 0) << "block " << i;
        }
    }
}

}  // namespace
}  // namespace macula
