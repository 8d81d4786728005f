// What a frame is made of, with fakes for everything that renders.

#include "server/service/frame_maker.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "masks/tile_sampler.h"
#include "protocol/base/clock.h"
#include "protocol/message/byte_map.h"
#include "server/service/pacing.h"

namespace macula {
namespace {

constexpr int kEdge_px = 64;

/// Made once: it takes longer than a test.
std::shared_ptr<const TileTables> shared_tables() {
    static const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    return tables;
}

TEST(SamplingMessage, OfTilesIsTheirLevelsWithoutTheGuardRing) {
    const Display display = load_display("desktop").value();
    SamplePlan plan;
    TileSampler(display, kLeftEye, AcuityLaw{}, shared_tables()).plan({.phase_px = {21, 40}}, plan);
    const EyeSamplingMessage message = sampling_message(plan);
    EXPECT_TRUE(message.exact);
    EXPECT_EQ(message.phase_px, glm::ivec2(21, 40));
    ASSERT_EQ(message.level.size(), static_cast<std::size_t>(plan.tiles_x - 2) * (plan.tiles_y - 2));
    EXPECT_EQ(message.level.back(), plan.level[(plan.tiles_y - 1) * plan.tiles_x - 2]);
}

TEST(SamplingMessage, OfOtherPlansCountsWhatTilesWouldHave) {
    // A plan of tiles that does not say so: the counts must lead back to its levels.
    Display display = load_display("vive").value();
    SamplePlan plan;
    TileSampler(display, kRightEye, AcuityLaw{}, shared_tables()).plan({}, plan);
    const std::vector<std::uint8_t> levels = sampling_message(plan).level;
    SamplePlan untold = plan;
    untold.level.clear();
    const EyeSamplingMessage message = sampling_message(untold);
    EXPECT_FALSE(message.exact);
    EXPECT_EQ(message.phase_px, glm::ivec2(0));
    ASSERT_EQ(message.tiles_x * message.tiles_y, plan.tiles_x * plan.tiles_y - 2 * (plan.tiles_x + plan.tiles_y) + 4);
    ASSERT_EQ(message.level.size(), levels.size());
    int partial = 0;
    for (int tile = 0; tile < static_cast<int>(levels.size()); ++tile) {
        const glm::ivec2 at(tile % message.tiles_x, tile / message.tiles_x);
        int visible = 0;
        for (int y = 16 * at.y; y < std::min(16 * at.y + 16, plan.height_px); ++y) {
            for (int x = 16 * at.x; x < std::min(16 * at.x + 16, plan.width_px); ++x)
                visible += (*plan.hidden)[y * plan.width_px + x] == 0 ? 1 : 0;
        }
        const int told = message.level[tile];
        const int level = levels[tile];
        if (visible == 256 || visible == 0 || level == kFullLevel) {
            ASSERT_EQ(told, level) << tile;
        } else {
            // Few pixels may have more or fewer samples than their share.
            ++partial;
            ASSERT_LE(std::abs(kLevelCounts[told] - kLevelCounts[level]) * visible / 256, 8) << tile;
        }
    }
    EXPECT_GT(partial, 100);
}

TEST(SamplingMessage, OfSamplesThatLieTogetherIsFullAtMost) {
    SamplePlan plan;
    plan.width_px = 40;
    plan.height_px = 20;
    for (int i = 0; i < 600; ++i) {
        plan.trace_order.push_back(static_cast<std::uint32_t>(plan.position.size()));
        plan.position.push_back({static_cast<std::int16_t>(i % 16), static_cast<std::int16_t>(i % 5)});
    }
    for (const SamplePosition beside : {SamplePosition{-1, 3}, {40, 3}, {33, 20}, {33, -2}, {39, 19}}) {
        plan.trace_order.push_back(static_cast<std::uint32_t>(plan.position.size()));
        plan.position.push_back(beside);
    }
    // The last tile has 8 x 4 pixels, of which one is traced: 8 of 256.
    EXPECT_EQ(sampling_message(plan).level, (std::vector<std::uint8_t>{kFullLevel, 0, 0, 0, 0, 4}));
}

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

/// Repeats the phase that it is asked for.
class PhaseSampler final : public Sampler {
public:
    void plan(const PlanRequest& request, SamplePlan& plan) override {
        GridSampler().plan(request, plan);
        plan.phase_px = request.phase_px;
    }
};

TEST(FrameMaker, ThePhaseRunsThroughItsCycleOrStays) {
    for (const bool shifts : {true, false}) {
        Display display;
        display.eye_width_px = display.eye_height_px = kEdge_px;
        FrameMaker::Parts parts;
        parts.scene = std::make_shared<const Scene>(two_instances());
        parts.shifts_phase = shifts;
        parts.tracer = std::make_shared<HalvesTracer>();
        for (auto& sampler : parts.samplers) sampler = std::make_unique<PhaseSampler>();
        parts.reconstructor = std::make_unique<FlatReconstructor>();
        FrameMaker maker(display, std::move(parts));
        Picture picture;
        for (std::uint64_t frame = 0; frame < 66; ++frame) {
            ASSERT_TRUE(maker.make(Track{}, 0, picture));
            for (const EyeSamplingMessage& sampling : picture.frame.sampling) {
                ASSERT_EQ(sampling.phase_px, phase_of_frame(shifts ? frame : 0)) << frame;
            }
        }
    }
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
