// The compositor's kernels on GL against the same kernels as C++, frame by frame, on both kinds of software context.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <utility>
#include <vector>

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
            eye.exact = random() % 2 == 0;
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

/// The paper's accumulation, pixel by pixel, as geometry.
class HalfAndHalf {
public:
    explicit HalfAndHalf(const Display& display) : display_(display) {}

    void accumulate(const NewFrame& frame) {
        const std::vector<glm::vec3> before = std::exchange(picture_, {});
        for (int y = 0; y < display_.eye_height_px; ++y) {
            for (int column = 0; column < frame.color->width_px; ++column) {
                const std::size_t eye = column < display_.eye_width_px ? 0 : 1;
                const Rgba8 texel = frame.color->at(column, y);
                const glm::vec3 now(texel & 255U, texel >> 8 & 255U, texel >> 16 & 255U);
                const float inverse_depth = frame.depth->at(column / 4, y / 4);
                const int first_column = static_cast<int>(eye) * display_.eye_width_px;
                const glm::dvec2 was =
                    place_before(eye, {column - first_column + 0.5, y + 0.5}, inverse_depth, frame.world_from_eye[eye]);
                const bool known = frame.continues && !before.empty() && was.x >= 0.0 && was.y >= 0.0 &&
                                   was.x <= display_.eye_width_px && was.y <= display_.eye_height_px;
                picture_.push_back(known ? 0.5F * (now + sample(before, first_column, was)) : now);
            }
        }
        world_from_eye_ = frame.world_from_eye;
    }
    [[nodiscard]] const std::vector<glm::vec3>& picture() const { return picture_; }

private:
    [[nodiscard]] glm::dvec2 place_before(std::size_t eye, glm::dvec2 at_px, double inverse_depth,
                                          const Pose& now) const {
        const Tangents& edge = display_.eyes[eye].tangents;
        const glm::dvec2 size(display_.eye_width_px, display_.eye_height_px);
        const glm::dvec2 upper_left(edge.left, edge.top);
        const glm::dvec2 extent(double{edge.right} - edge.left, double{edge.bottom} - edge.top);
        const glm::dvec3 here = glm::dvec3(upper_left + at_px / size * extent, -1.0) / inverse_depth;
        const glm::dquat turn = glm::dquat(world_from_eye_[eye].orientation);
        const glm::dvec3 world = glm::dquat(now.orientation) * here + glm::dvec3(now.position_m);
        const glm::dvec3 there = glm::conjugate(turn) * (world - glm::dvec3(world_from_eye_[eye].position_m));
        return (glm::dvec2(there) / -there.z - upper_left) / extent * size;
    }
    [[nodiscard]] glm::vec3 sample(const std::vector<glm::vec3>& picture, int first_column, glm::dvec2 at_px) const {
        const glm::dvec2 last(display_.eye_width_px - 1, display_.eye_height_px - 1);
        const glm::dvec2 at = glm::clamp(at_px - 0.5, glm::dvec2(0.0), last);
        const glm::ivec2 corner = glm::min(glm::ivec2(at), glm::ivec2(last) - 1);
        const glm::vec2 part(at - glm::dvec2(corner));
        const auto texel = [&](int dx, int dy) {
            const int index = (corner.y + dy) * 2 * display_.eye_width_px + first_column + corner.x + dx;
            return picture[index];
        };
        return glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x), glm::mix(texel(0, 1), texel(1, 1), part.x), part.y);
    }

    Display display_;
    PerEye<Pose> world_from_eye_;
    std::vector<glm::vec3> picture_;
};

void expect_half_and_half(Compositor& compositor, Input& input) {
    HalfAndHalf formula(input.display);
    ColorImage picture;
    for (int step = 0; step < 6; ++step) {
        const NewFrame frame = input.next(step);
        ASSERT_TRUE(compositor.accumulate(frame));
        formula.accumulate(frame);
        ASSERT_TRUE(compositor.show(frame.world_from_eye, frame.display_time_ns, picture));
        int different = 0;
        for (std::size_t i = 0; i < picture.texels.size(); ++i) {
            const Rgba8 texel = picture.texels[i];
            const glm::vec3 difference =
                glm::vec3(texel & 255U, texel >> 8 & 255U, texel >> 16 & 255U) - formula.picture()[i];
            // Noise as it is, a thousandth of a pixel is a quarter of a step.
            if (std::max({std::abs(difference.x), std::abs(difference.y), std::abs(difference.z)}) > 1.5F) ++different;
        }
        // Rounding decides on which side of the picture's edge a pixel falls.
        EXPECT_LE(different, static_cast<int>(picture.texels.size()) / 1000) << "frame " << step;
    }
}

/// A headset that hides nothing.
Input bare_input() {
    Input input;
    for (EyeDisplay& eye : input.display.eyes) eye.visible_outline.clear();
    return input;
}

TEST_P(GlCompositor, AveragesHalfAndHalfAsThePaper) {
    auto context = make_gl_context(GetParam());
    if (!context) GTEST_SKIP() << context.error().message;
    Input input = bare_input();
    auto gl = make_gl_compositor(std::move(*context), input.display, paper_taa_weights());
    ASSERT_TRUE(gl) << gl.error().message;
    expect_half_and_half(**gl, input);
}

TEST(CppCompositor, AveragesHalfAndHalfAsThePaper) {
    Input input = bare_input();
    const auto cpu = make_cpu_compositor(input.display, paper_taa_weights());
    expect_half_and_half(*cpu, input);
}

}  // namespace
}  // namespace macula
