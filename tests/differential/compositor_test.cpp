// The compositor's kernels on GL against the same kernels as C++, frame by frame, on both kinds of software context.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "masks/rank_tile.h"

namespace macula {
namespace {

/// A small headset with a hidden area, and frames of noise over a made-up surface.
struct Input {
    Display display;
    RankTile rank_tile = make_rank_tile();
    std::mt19937 random{1};
    ColorImage color;
    InverseDepthImage depth;
    PerEye<EyeSamplingMessage> sampling;
    std::vector<MovingObject> moving;
    Image<std::uint8_t> moving_map;

    Input() {
        display.name = "test";
        display.eye_width_px = 204;
        display.eye_height_px = 132;
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            display.eyes[eye].tangents = {-1.4F, 1.2F, -1.1F, 1.3F};
            display.eyes[eye].head_from_eye.position_m.x = eye == 0 ? -0.03F : 0.03F;
            display.eyes[eye].visible_outline = {{-1.3F, 0.0F}, {0.0F, -1.05F}, {1.1F, 0.0F}, {0.0F, 1.2F}};
        }
        color = ColorImage(2 * display.eye_width_px, display.eye_height_px);
        depth = InverseDepthImage(display.eye_width_px / 2, display.eye_height_px / 4);
    }

    NewFrame next(int step) {
        for (Rgba8& texel : color.texels) texel = static_cast<Rgba8>(random()) | 0xFF000000U;
        for (int y = 0; y < depth.height_px; ++y) {
            for (int x = 0; x < depth.width_px; ++x) depth.at(x, y) = (x / 8 + y / 8) % 3 == 0 ? 0.9F : 0.25F;
        }
        for (EyeSamplingMessage& eye : sampling) {
            eye.phase_px = glm::ivec2(random() % 64, random() % 64);
            eye.tiles_x = (display.eye_width_px + 15) / 16 + 1;
            eye.tiles_y = (display.eye_height_px + 15) / 16 + 1;
            eye.level.clear();
            for (int i = 0; i < eye.tiles_x * eye.tiles_y; ++i) {
                eye.level.push_back(static_cast<std::uint8_t>(random() % kLevelTotal));
            }
        }
        NewFrame frame;
        frame.color = &color;
        frame.depth = &depth;
        frame.world_from_eye = poses(static_cast<float>(step));
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) frame.sampling[eye] = &sampling[eye];
        frame.rank_tile = rank_tile.rank;
        frame.rank_tile_size_px = RankTile::kEdge_px;
        frame.continues = step != 4;
        // Still frames, moving ones, and both changes from one to the other; an object goes and another comes.
        frame.display_time_ns = step * 33'000'000;
        if (step % 6 >= 2) {
            move(step);
            frame.moving = moving;
            frame.moving_map = &moving_map;
        }
        return frame;
    }
    /// Patches of objects that slide and turn.
    void move(int step) {
        moving.clear();
        for (const int id : {1, 2, step < 4 ? 3 : 4}) {
            MovingObject object;
            object.id = static_cast<std::uint32_t>(id);
            const float speed = 0.1F * static_cast<float>(id);
            const float angle = speed * static_cast<float>(step);
            object.world_from_object = glm::mat4x3(glm::mat3_cast(glm::angleAxis(angle, glm::vec3(0.0F, 0.0F, 1.0F))));
            object.world_from_object[3] = glm::vec3(speed * static_cast<float>(step), 0.1F, -2.0F);
            object.velocity_per_s[0] = 30.0F * speed * glm::vec3(-std::sin(angle), std::cos(angle), 0.0F);
            object.velocity_per_s[1] = 30.0F * speed * glm::vec3(-std::cos(angle), -std::sin(angle), 0.0F);
            object.velocity_per_s[3].x = 30.0F * speed;
            moving.push_back(object);
        }
        moving_map = Image<std::uint8_t>(depth.width_px, depth.height_px);
        for (int y = 0; y < depth.height_px; ++y) {
            for (int x = 0; x < depth.width_px; ++x) {
                moving_map.at(x, y) = static_cast<std::uint8_t>((x / 5 + y / 4 + step) % 4);
            }
        }
    }
    [[nodiscard]] PerEye<Pose> poses(float step) const {
        const Pose head{glm::angleAxis(0.02F * step, glm::normalize(glm::vec3(0.2F, 1.0F, 0.1F))),
                        glm::vec3(0.013F * step, 0.004F * step, -0.01F * step)};
        return {head * display.eyes[0].head_from_eye, head * display.eyes[1].head_from_eye};
    }
};

class GlCompositor : public testing::TestWithParam<ContextKind> {};

TEST_P(GlCompositor, AgreesWithCpp) {
    auto context = make_gl_context(GetParam());
    if (!context) GTEST_SKIP() << context.error().message;
    Input input;
    auto gl = make_gl_compositor(std::move(*context), input.display, default_taa_weights());
    ASSERT_TRUE(gl) << gl.error().message;
    const auto cpu = make_cpu_compositor(input.display, default_taa_weights());
    ColorImage from_gl;
    ColorImage from_cpu;
    for (int step = 0; step < 8; ++step) {
        const NewFrame frame = input.next(step);
        ASSERT_TRUE((*gl)->accumulate(frame));
        ASSERT_TRUE(cpu->accumulate(frame));
        const PerEye<Pose> newest = input.poses(static_cast<float>(step) + 0.6F);
        ASSERT_TRUE((*gl)->show(newest, frame.display_time_ns + 20'000'000, from_gl));
        ASSERT_TRUE(cpu->show(newest, frame.display_time_ns + 20'000'000, from_cpu));
        ASSERT_EQ(from_gl.texels.size(), from_cpu.texels.size());
        int different = 0;
        int shown = 0;
        for (std::size_t i = 0; i < from_cpu.texels.size(); ++i) {
            int worst = 0;
            for (int shift = 0; shift < 24; shift += 8) {
                const int a = static_cast<int>((from_gl.texels[i] >> shift) & 255U);
                const int b = static_cast<int>((from_cpu.texels[i] >> shift) & 255U);
                worst = std::max(worst, std::abs(a - b));
            }
            if (worst > 1) ++different;
            if ((from_cpu.texels[i] & 0xFFFFFFU) != 0) ++shown;
        }
        // Rounding decides on which side of a threshold or a block's edge a pixel falls; that happens to few.
        EXPECT_LT(different, static_cast<int>(from_cpu.texels.size()) / 500) << "frame " << step;
        RecordProperty("different_" + std::to_string(step), different);
        EXPECT_GT(shown, static_cast<int>(from_cpu.texels.size()) / 4);
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, GlCompositor, testing::Values(ContextKind::surfaceless, ContextKind::osmesa),
                         [](const auto& kind) {
                             return kind.param == ContextKind::surfaceless ? "surfaceless" : "osmesa";
                         });

}  // namespace
}  // namespace macula
