// What moves by itself is as sharp as what is still, leaves no ghost, and is shown where it is now: pictures of a
// foveated server's frames of a moving square, compared with what should be seen.

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "tests/support/animated_view.h"

namespace macula {
namespace {

constexpr int kEdge_px = 256;
constexpr double kPeriod_s = 1.0 / 30.0;
constexpr int kFrames = 14;

AnimationChannel channel(AnimationPath path, const glm::vec4& from, const glm::vec4& to, float period_s) {
    AnimationChannel channel;
    channel.path = path;
    channel.time_s = {0.0F, period_s};
    channel.value = {from, to};
    channel.period_s = period_s;
    return channel;
}

/// Slides to the right 2 m before the eye, 3.6 pixels a frame.
Animation slide() {
    Animation animation;
    animation.nodes.resize(1);
    animation.nodes[0].translation_m.z = -2.0F;
    animation.channels.push_back(channel(AnimationPath::translation, {-1.0F, 0.1F, -2.0F, 0.0F},
                                         {-1.0F + 1.7F * 2.0F, 0.1F, -2.0F, 0.0F}, 2.0F));
    animation.duration_s = 2.0F;
    return animation;
}

/// Turns about the line of sight, 12 degrees a frame: its corners move by 9 pixels.
Animation turn() {
    Animation animation;
    animation.nodes.resize(1);
    animation.nodes[0].translation_m.z = -2.0F;
    AnimationChannel rotation;
    rotation.path = AnimationPath::rotation;
    for (int i = 0; i <= 4; ++i) {
        const float half = static_cast<float>(i) * std::numbers::pi_v<float> / 4.0F;
        rotation.time_s.push_back(0.25F * static_cast<float>(i));
        rotation.value.emplace_back(0.0F, 0.0F, std::sin(half), std::cos(half));
    }
    rotation.period_s = animation.duration_s = 1.0F;
    animation.channels.push_back(rotation);
    return animation;
}

/// Comes nearer while it turns about the vertical.
Animation approach() {
    Animation animation = turn();
    for (glm::vec4& value : animation.channels[0].value) value = {0.0F, 0.5F * value.z, 0.0F, 0.0F};
    for (glm::vec4& value : animation.channels[0].value) value.w = std::sqrt(1.0F - value.y * value.y);
    animation.channels.push_back(
        channel(AnimationPath::translation, {0.0F, 0.0F, -3.0F, 0.0F}, {0.2F, 0.0F, -1.4F, 0.0F}, 1.0F));
    return animation;
}

Display square_display() {
    Display display;
    display.name = "test";
    display.eye_width_px = display.eye_height_px = kEdge_px;
    return display;
}

/// Which pixels are judged.
using Judged = std::function<bool(int x, int y)>;

double psnr_db(const ColorImage& picture, const ColorImage& truth, const Judged& judged) {
    double squares = 0.0;
    int count = 0;
    for (int y = 0; y < kEdge_px; ++y) {
        for (int x = 0; x < kEdge_px; ++x) {
            if (!judged(x, y)) continue;
            for (int shift = 0; shift < 24; shift += 8) {
                const double d = static_cast<double>(picture.at(x, y) >> shift & 255U) -
                                 static_cast<double>(truth.at(x, y) >> shift & 255U);
                squares += d * d;
                ++count;
            }
        }
    }
    EXPECT_GT(count, 500) << "nothing is judged";
    return 10.0 * std::log10(255.0 * 255.0 * count / squares);
}

/// With and without what frames say about motion.
struct Quality {
    double with_db = 0.0;
    double without_db = 0.0;
};

class CompositorMotion : public testing::Test {
protected:
    /// What is seen `late_s` after the last frame's time, from a still eye.
    void play(const Animation& animation, std::optional<double> share, double late_s) {
        const test::AnimatedSquare square(animation);
        view_ = std::make_unique<test::AnimatedView>(square_display(), share, square);
        with_ = make_cpu_compositor(square_display(), default_taa_weights());
        without_ = make_cpu_compositor(square_display(), default_taa_weights());
        for (int i = 0; i < kFrames; ++i) {
            NewFrame frame = view_->frame(i, {}, kPeriod_s * i);
            ASSERT_TRUE(with_->accumulate(frame));
            frame.moving = {};
            ASSERT_TRUE(without_->accumulate(frame));
        }
        last_s_ = kPeriod_s * (kFrames - 1);
        shown_s_ = last_s_ + late_s;
        const auto shown_ns = static_cast<std::int64_t>(1e9 * shown_s_);
        ASSERT_TRUE(with_->show({}, shown_ns, picture_with_));
        ASSERT_TRUE(without_->show({}, shown_ns, picture_without_));
        truth_ = view_->truth({}, shown_s_);
    }
    Quality judge(const char* what, const Judged& judged) {
        const Quality quality{psnr_db(picture_with_, truth_, judged), psnr_db(picture_without_, truth_, judged)};
        std::printf("             %-40s %5.2f dB, without motion %5.2f dB\n", what, quality.with_db,
                    quality.without_db);
        return quality;
    }
    [[nodiscard]] bool shows_square(double time_s, int x, int y) const { return view_->covered({}, time_s, x, y); }
    [[nodiscard]] Judged on_square() const {
        return [this](int x, int y) { return shows_square(shown_s_, x, y); };
    }
    /// What the square has uncovered since some frames before.
    [[nodiscard]] Judged behind_it(int frames) const {
        return [this, frames](int x, int y) {
            return !shows_square(shown_s_, x, y) && shows_square(shown_s_ - kPeriod_s * frames, x, y);
        };
    }
    /// What the square never covered. Pixels beside it that share a block with it are moved as it is.
    [[nodiscard]] Judged elsewhere() const {
        return [this](int x, int y) {
            for (int i = 0; i < kFrames; ++i) {
                if (shows_square(kPeriod_s * i, x, y)) return false;
            }
            for (int dy = -8; dy <= 8; dy += 4) {
                for (int dx = -8; dx <= 8; dx += 4) {
                    if (shows_square(shown_s_, x + dx, y + dy) || shows_square(last_s_, x + dx, y + dy)) return false;
                }
            }
            return true;
        };
    }

    // Rows share nothing; ThreadSanitizer cannot see how TBB's threads wait for one another.
    oneapi::tbb::global_control one_thread_{oneapi::tbb::global_control::max_allowed_parallelism, 1};
    std::unique_ptr<test::AnimatedView> view_;
    std::unique_ptr<Compositor> with_;
    std::unique_ptr<Compositor> without_;
    double last_s_ = 0.0;
    double shown_s_ = 0.0;
    ColorImage picture_with_;
    ColorImage picture_without_;
    ColorImage truth_;
};

TEST_F(CompositorMotion, ASlidingSquareIsSharpAndLeavesNoGhost) {
    play(slide(), 0.27, 0.0);
    const Quality on_it = judge("sliding, on it", on_square());
    EXPECT_GT(on_it.with_db, on_it.without_db + 3.0);
    const Quality behind = judge("sliding, behind it", behind_it(4));
    EXPECT_GT(behind.with_db, behind.without_db + 3.0);
    const Quality still = judge("sliding, elsewhere", elsewhere());
    EXPECT_GT(still.with_db, still.without_db - 0.1);
    EXPECT_LT(view_->motion_bytes(), 600U);
}

TEST_F(CompositorMotion, ATurningSquareIsSharp) {
    play(turn(), 0.27, 0.0);
    const Quality on_it = judge("turning, on it", on_square());
    EXPECT_GT(on_it.with_db, on_it.without_db + 3.0);
}

TEST_F(CompositorMotion, AnApproachingSquareIsSharp) {
    play(approach(), 0.27, 0.0);
    const Quality on_it = judge("approaching, on it", on_square());
    EXPECT_GT(on_it.with_db, on_it.without_db + 3.0);
}

TEST_F(CompositorMotion, LateReprojectionMovesASlidingSquareOn) {
    play(slide(), std::nullopt, 0.025);
    const Quality on_it = judge("sliding on for 25 ms, on it", on_square());
    EXPECT_GT(on_it.with_db, on_it.without_db + 6.0);
    const Quality still = judge("sliding on for 25 ms, elsewhere", elsewhere());
    EXPECT_GT(still.with_db, still.without_db - 0.1);
}

TEST_F(CompositorMotion, LateReprojectionTurnsASquareOn) {
    play(turn(), std::nullopt, 0.05);
    const Quality on_it = judge("turning on for 50 ms, on it", on_square());
    EXPECT_GT(on_it.with_db, on_it.without_db + 6.0);
}

TEST_F(CompositorMotion, LateReprojectionGoesBackToo) {
    play(slide(), std::nullopt, -0.015);
    const Quality on_it = judge("sliding back for 15 ms, on it", on_square());
    EXPECT_GT(on_it.with_db, on_it.without_db + 6.0);
}

}  // namespace
}  // namespace macula
