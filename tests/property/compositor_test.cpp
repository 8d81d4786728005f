// What temporal accumulation and late reprojection promise, on pictures whose answer is known.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "masks/levels.h"
#include "masks/rank_tile.h"

namespace macula {
namespace {

using kernels::TaaWeights;
using ColorAt = std::function<Rgba8(int x, int y)>;

constexpr int kEdge_px = 128;
constexpr float kFocal_px = kEdge_px / 2.0F;  // tangents -1..1

Rgba8 grey(int value) {
    return 0xFF000000U | static_cast<Rgba8>(value) * 0x010101U;
}
int value_of(Rgba8 color) {
    return static_cast<int>(color & 255U);
}
/// A smooth texture over the picture's coordinates; pixel centres are at +.5.
float waves(float x, float y) {
    return 128.0F + 60.0F * std::sin(0.11F * x) + 50.0F * std::cos(0.09F * y);
}
Rgba8 waves_at(int x, int y) {
    return grey(static_cast<int>(waves(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) + 0.5F));
}

/// Made once: it takes longer than a test.
const RankTile& shared_rank_tile() {
    static const RankTile kTile = make_rank_tile();
    return kTile;
}

/// A compositor for a square display, and frames under the test's control: all tiles at one level, both eyes alike.
class Compositing : public testing::Test {
protected:
    void begin(const TaaWeights& weights, std::uint8_t level) {
        Display display;
        display.name = "test";
        display.eye_width_px = display.eye_height_px = kEdge_px;
        compositor_ = make_cpu_compositor(display, weights);
        sampling_.tiles_x = sampling_.tiles_y = kEdge_px / 16 + 1;
        sampling_.level.assign(static_cast<std::size_t>(sampling_.tiles_x * sampling_.tiles_y), level);
    }
    void set_depth(const std::function<float(int block_x, int block_y)>& inverse_depth) {
        for (int y = 0; y < depth_.height_px; ++y) {
            for (int x = 0; x < depth_.width_px; ++x) depth_.at(x, y) = inverse_depth(x % (kEdge_px / 4), y);
        }
    }
    void draw(const ColorAt& color_at) {
        for (int y = 0; y < kEdge_px; ++y) {
            for (int x = 0; x < kEdge_px; ++x) color_.at(x, y) = color_.at(x + kEdge_px, y) = color_at(x, y);
        }
    }
    void accumulate(const Pose& pose, const ColorAt& color_at, bool continues = true) {
        draw(color_at);
        accumulate_drawn(pose, continues);
    }
    void accumulate_drawn(const Pose& pose, bool continues = true) {
        NewFrame frame;
        frame.color = &color_;
        frame.depth = &depth_;
        frame.world_from_eye = {pose, pose};
        frame.sampling = {&sampling_, &sampling_};
        frame.rank_tile = rank_tile_.rank;
        frame.rank_tile_size_px = RankTile::kEdge_px;
        frame.continues = continues;
        ASSERT_TRUE(compositor_->accumulate(frame));
    }
    const ColorImage& show(const Pose& pose) {
        EXPECT_TRUE(compositor_->show({pose, pose}, 0, picture_));
        return picture_;
    }
    int shown_at(int x, int y) { return value_of(show({}).at(x, y)); }
    [[nodiscard]] bool traced(int x, int y) const {
        const int rank = rank_tile_.at((x + sampling_.phase_px.x) % 64, (y + sampling_.phase_px.y) % 64);
        return rank < kLevelCounts[sampling_.level[0]];
    }
    void next_phase() { sampling_.phase_px = glm::ivec2(random_() % 64, random_() % 64); }

    // Rows share nothing; ThreadSanitizer cannot see how TBB's threads wait for one another.
    oneapi::tbb::global_control one_thread_{oneapi::tbb::global_control::max_allowed_parallelism, 1};
    std::mt19937 random_{1};
    const RankTile& rank_tile_ = shared_rank_tile();
    EyeSamplingMessage sampling_;
    ColorImage color_{2 * kEdge_px, kEdge_px};
    InverseDepthImage depth_{kEdge_px / 2, kEdge_px / 4, 0.5F};
    ColorImage picture_;
    std::unique_ptr<Compositor> compositor_;
};

TEST_F(Compositing, AStillViewConvergesToTheMeanOfItsTracedPixels) {
    TaaWeights weights = default_taa_weights();
    weights.traced = 0.01F;  // far from the limit every sample of a pixel weighs the same
    weights.interpolated = 1e-6F;
    begin(weights, 12);  // 48 of 256
    std::vector<double> sum(kEdge_px * kEdge_px);
    std::vector<int> count(kEdge_px * kEdge_px);
    for (int i = 0; i < 40; ++i) {
        next_phase();
        accumulate({}, [&](int x, int y) {
            // Interpolated pixels are wrong on purpose.
            const int value = traced(x, y) ? (x * 7 + y * 13 + i * 101) % 256 : 255;
            const auto at = static_cast<std::size_t>(y * kEdge_px + x);
            if (traced(x, y)) {
                sum[at] += value;
                ++count[at];
            }
            return grey(value);
        });
    }
    const ColorImage& picture = show({});
    int checked = 0;
    for (int y = 0; y < kEdge_px; ++y) {
        for (int x = 0; x < kEdge_px; ++x) {
            const auto at = static_cast<std::size_t>(y * kEdge_px + x);
            if (count[at] == 0) continue;
            ++checked;
            ASSERT_NEAR(value_of(picture.at(x, y)), sum[at] / count[at], 1.5) << x << " " << y;
        }
    }
    EXPECT_GT(checked, kEdge_px * kEdge_px * 9 / 10);
}

TEST_F(Compositing, WhereOnlyDensitiesAreKnownAPixelIsWorthTheMean) {
    for (const int level : {0, 12, kFullLevel}) {
        begin(default_taa_weights(), static_cast<std::uint8_t>(level));
        sampling_.exact = false;
        accumulate({}, [](int, int) { return grey(40); });
        accumulate({}, [](int, int) { return grey(200); });
        // Two frames alike: half and half, whatever a pixel is worth.
        ASSERT_NEAR(shown_at(37, 59), 120, 1) << level;
        const double precision = 0.02 + (1.0 - 0.02) * kLevelCounts[level] / 256.0;
        const double known = std::min(2.0 * precision, 1.0);
        accumulate({}, [](int, int) { return grey(0); });
        for (const int x : {0, 37, 127}) {
            ASSERT_NEAR(shown_at(x, 59), 120.0 * known / (known + precision), 1.5) << level;
        }
    }
}

TEST_F(Compositing, AStaticPictureStaysFor200Frames) {
    begin(default_taa_weights(), 10);
    draw(waves_at);
    for (int i = 0; i < 200; ++i) {
        next_phase();
        accumulate_drawn({});
    }
    const ColorImage& picture = show({});
    for (int y = 0; y < kEdge_px; ++y) {
        for (int x = 0; x < kEdge_px; ++x) {
            ASSERT_NEAR(value_of(picture.at(x, y)), value_of(waves_at(x, y)), 1) << x << " " << y;
        }
    }
}

/// A still surface of value 40 that is 240 from one frame to the next, as when its light changes: nothing but its
/// colour tells, so it fades. A settled history has precision 1, so a traced pixel takes 1 / 2 of what is missing, an
/// interpolated one .02 / 1.02.
class NewShade : public Compositing {
protected:
    static constexpr double kTraced = 0.5;
    static constexpr double kInterpolated = 0.02 / 1.02;

    void settle() {
        begin(default_taa_weights(), 12);  // 48 of 256
        draw([](int, int) { return grey(40); });
        for (int i = 0; i < 60; ++i) accumulate_drawn({});
        draw([](int, int) { return grey(240); });
    }
    /// `missing` is the share of the change that is not shown yet. Its error is rounding: half a value when it is
    /// shown, and in the history 1 / 514 a frame, which adds up to .1 where a frame takes one part in 51.
    void expect_missing(int x, int y, double missing) {
        ASSERT_NEAR(value_of(picture_.at(x, y)), 240.0 - 200.0 * missing, 0.65) << x << " " << y;
    }
};

TEST_F(NewShade, IsNineTenthsShownAfter4TracedOr117InterpolatedFrames) {
    settle();
    std::array<int, 2> frames = {0, 0};  // of interpolated and of traced pixels
    for (int i = 1; i <= 130; ++i) {
        accumulate_drawn({});
        show({});
        std::array<int, 2> darkest = {255, 255};
        for (int y = 0; y < kEdge_px; ++y) {
            for (int x = 0; x < kEdge_px; ++x) {
                const bool now = traced(x, y);
                expect_missing(x, y, std::pow(1.0 - (now ? kTraced : kInterpolated), i));
                darkest[now ? 1 : 0] = std::min(darkest[now ? 1 : 0], value_of(picture_.at(x, y)));
            }
        }
        for (std::size_t kind = 0; kind < 2; ++kind) {
            if (darkest[kind] < 220) ++frames[kind];
        }
    }
    EXPECT_EQ(frames[1] + 1, 4);
    // One frame changes it by .4 there, so rounding shifts it by up to two.
    EXPECT_NEAR(frames[0] + 1, 117, 2);
}

TEST_F(NewShade, FadesInAsOftenAsEachPixelIsTraced) {
    settle();
    std::vector<double> missing(kEdge_px * kEdge_px, 1.0);
    for (int i = 0; i < 30; ++i) {
        next_phase();
        accumulate_drawn({});
        show({});
        double mean = 0.0;
        std::size_t at = 0;
        for (int y = 0; y < kEdge_px; ++y) {
            for (int x = 0; x < kEdge_px; ++x) {
                double& here = missing[at++];
                here *= 1.0 - (traced(x, y) ? kTraced : kInterpolated);
                mean += here / (kEdge_px * kEdge_px);
                expect_missing(x, y, here);
            }
        }
        // Over the picture, each frame takes the same share: that of a traced pixel for 48 of 256.
        const double kept = 1.0 - kTraced * 48.0 / 256.0 - kInterpolated * 208.0 / 256.0;
        ASSERT_NEAR(mean, std::pow(kept, i + 1), 0.1 * std::pow(kept, i + 1)) << i;
    }
}

TEST_F(Compositing, WithoutHistoryAFrameIsShownAsItCame) {
    begin(default_taa_weights(), 10);
    accumulate({}, [](int, int) { return grey(250); });
    accumulate({}, waves_at, false);
    EXPECT_EQ(show({}).texels, color_.texels);
    begin(no_taa_weights(), 10);
    accumulate({}, [](int, int) { return grey(250); });
    accumulate({}, waves_at);
    EXPECT_EQ(show({}).texels, color_.texels);
}

/// A near surface covers the left half. The eye moves to the right by .25 m: the far one moves by 4 pixels, the near
/// one's edge by 16, from 64 to 48, and what it hid between 48 and 60 comes into view.
class Disocclusion : public Compositing {
protected:
    int worst_ghost(const TaaWeights& weights) {
        begin(weights, 9);
        const auto scene = [this](int edge_px) {
            set_depth([=](int x, int) { return x < edge_px / 4 ? 1.0F : 0.25F; });
            return [=](int x, int) { return grey(x < edge_px ? 200 : 60); };
        };
        for (int i = 0; i < 10; ++i) accumulate({}, scene(64));
        const Pose moved{glm::quat(1.0F, 0.0F, 0.0F, 0.0F), glm::vec3(0.25F, 0.0F, 0.0F)};
        accumulate(moved, scene(48));
        const ColorImage& picture = show(moved);
        int worst = 0;
        for (int y = 8; y < kEdge_px - 8; ++y) {
            for (int x = 49; x < 59; ++x) worst = std::max(worst, std::abs(value_of(picture.at(x, y)) - 60));
        }
        return worst;
    }
};

TEST_F(Disocclusion, IsRejected) {
    EXPECT_LE(worst_ghost(default_taa_weights()), 2);
}

TEST_F(Disocclusion, WouldLeaveAGhostWithoutRejection) {
    TaaWeights weights = default_taa_weights();
    weights.disparity_px = 1e9F;
    EXPECT_GT(worst_ghost(weights), 40) << "the test above could not fail";
}

TEST_F(Compositing, RotationRejectsNothingInsideThePicture) {
    begin(default_taa_weights(), 9);
    accumulate({}, [](int, int) { return grey(200); });
    for (int i = 0; i < 8; ++i) {
        next_phase();
        accumulate({}, [](int, int) { return grey(200); });
    }
    // Depths that have nothing to do with those before, and colours that only rejected pixels would take over.
    set_depth([](int x, int y) { return (x + y) % 2 == 0 ? 2.0F : 0.1F; });
    const Pose turned{glm::angleAxis(0.05F, glm::vec3(0.0F, 1.0F, 0.0F)), glm::vec3(0.0F)};
    accumulate(turned, [this](int x, int y) { return grey(traced(x, y) ? 200 : 190); });
    const ColorImage& picture = show(turned);
    for (int y = 8; y < kEdge_px - 8; ++y) {
        for (int x = 16; x < kEdge_px - 16; ++x) ASSERT_GT(value_of(picture.at(x, y)), 195) << x << " " << y;
    }
}

/// A textured plane 2 m ahead and an eye that moved and turned: what it sees, in closed form.
class TexturedPlane : public Compositing {
protected:
    const Pose moved_{glm::angleAxis(0.04F, glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F))),
                      glm::vec3(0.11F, -0.07F, 0.13F)};

    /// Value of the texture at the pixel of the picture seen from `pose`; the texture is what the identity sees.
    static float closed_form(const Pose& pose, int x, int y) {
        const glm::vec3 direction = pose.direction(glm::vec3((static_cast<float>(x) + 0.5F) / kFocal_px - 1.0F,
                                                             1.0F - (static_cast<float>(y) + 0.5F) / kFocal_px, -1.0F));
        const glm::vec3 point = pose.position_m + direction * ((-2.0F - pose.position_m.z) / direction.z);
        return waves(kFocal_px * (point.x / 2.0F + 1.0F), kFocal_px * (1.0F - point.y / 2.0F));
    }
    static float inverse_depth(const Pose& pose, float x, float y) {
        const glm::vec3 direction = pose.direction(glm::vec3(x / kFocal_px - 1.0F, 1.0F - y / kFocal_px, -1.0F));
        return direction.z / (-2.0F - pose.position_m.z);
    }
    void expect_closed_form(const Pose& pose, float tolerance) {
        const ColorImage& picture = show(pose);
        for (int y = 16; y < kEdge_px - 16; ++y) {
            for (int x = 16; x < kEdge_px - 16; ++x) {
                ASSERT_NEAR(static_cast<float>(value_of(picture.at(x, y))), closed_form(pose, x, y), tolerance)
                    << x << " " << y;
            }
        }
    }
};

TEST_F(TexturedPlane, IsShownFromWhereTheEyeIsNow) {
    begin(default_taa_weights(), kFullLevel);
    accumulate({}, waves_at);
    expect_closed_form(moved_, 2.0F);
    expect_closed_form({}, 0.6F);
}

TEST_F(TexturedPlane, ItsHistoryFollowsTheEye) {
    begin(default_taa_weights(), 9);
    sampling_.phase_px = glm::ivec2(0);
    for (int i = 0; i < 20; ++i) {
        next_phase();
        accumulate({}, waves_at);
    }
    // The new frame knows only its traced pixels; the others are off by 40 and must hardly count.
    set_depth([this](int x, int y) {
        return inverse_depth(moved_, static_cast<float>(4 * x + 2), static_cast<float>(4 * y + 2));
    });
    accumulate(moved_, [this](int x, int y) {
        const float value = closed_form(moved_, x, y) + (traced(x, y) ? 0.0F : 40.0F);
        return grey(static_cast<int>(std::clamp(value, 0.0F, 255.0F)));
    });
    expect_closed_form(moved_, 5.0F);
}

TEST_F(Compositing, WhatWasNeverSeenIsBlack) {
    begin(default_taa_weights(), kFullLevel);
    accumulate({}, [](int, int) { return grey(200); });
    const Pose turned{glm::angleAxis(0.3F, glm::vec3(0.0F, 1.0F, 0.0F)), glm::vec3(0.0F)};  // to the left
    const ColorImage& picture = show(turned);
    EXPECT_EQ(value_of(picture.at(2, kEdge_px / 2)), 0);
    EXPECT_EQ(value_of(picture.at(kEdge_px - 3, kEdge_px / 2)), 200);
}

}  // namespace
}  // namespace macula
