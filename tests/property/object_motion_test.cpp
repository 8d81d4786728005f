// How an object's points move, and what becomes of the history of objects that come and go.

#include "client/present/object_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <glm/gtc/quaternion.hpp>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "masks/rank_tile.h"

namespace macula {
namespace {

constexpr int kEdge_px = 64;

Display square_display() {
    Display display;
    display.name = "test";
    display.eye_width_px = display.eye_height_px = kEdge_px;
    return display;
}

void expect_near(const glm::dmat4x3& a, const glm::dmat4x3& b, double tolerance) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) EXPECT_NEAR(a[column][row], b[column][row], tolerance) << column << row;
    }
}

/// A place that turns about an axis through a point and either slides along it, a screw, or grows.
MovingObject screw(double time_s, const glm::dvec3& axis, const glm::dvec3& through, double growth) {
    const auto place = [&](double t) {
        const glm::dmat3 linear = std::exp(growth * t) * glm::mat3_cast(glm::angleAxis(3.0 * t, axis)) *
                                  glm::dmat3(1.0, 0.2, 0.0, 0.0, 0.5, 0.1, 0.3, 0.0, 2.0);
        const glm::dvec3 origin = through + (growth == 0.0 ? 0.4 * t : 0.0) * axis;
        return glm::dmat4x3(linear[0], linear[1], linear[2], origin);
    };
    const double step = 1e-5;
    return {1, glm::mat4x3(place(time_s)), glm::mat4x3((place(time_s + step) - place(time_s - step)) * (0.5 / step))};
}

TEST(MotionOfAnObject, AheadIsExactForScrewsAndGrowthWhereverTheWorldsOriginLies) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 1.0, -0.2));
    for (const glm::dvec3& through : {glm::dvec3(0.1, 0.2, -2.0), glm::dvec3(900.0, 0.0, -400.0)}) {
        for (const double growth : {0.0, 0.7}) {
            const MovingObject now = screw(0.5, axis, through, growth);
            for (const double ahead_s : {-0.1, 0.0, 0.02, 0.1}) {
                // Taken there by the motion, the place is that of the screw.
                const glm::dmat4 moved(motion_ahead(now, ahead_s));
                const glm::dmat4x3 place(moved * glm::dmat4(glm::mat4(now.world_from_object)));
                const double tolerance = 1e-5 + 3e-7 * glm::length(through);
                expect_near(place, glm::dmat4x3(screw(0.5 + ahead_s, axis, through, growth).world_from_object),
                            tolerance);
            }
        }
    }
}

TEST(MotionOfAnObject, BackUndoesWhatTheObjectDid) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 1.0, -0.2));
    const MovingObject before = screw(0.1, axis, {0.1, 0.2, -2.0}, 0.7);
    const MovingObject now = screw(0.4, axis, {0.1, 0.2, -2.0}, 0.7);
    glm::dmat4x3 back;
    ASSERT_TRUE(motion_back(before, now, back));
    expect_near(glm::dmat4x3(glm::dmat4(back) * glm::dmat4(glm::mat4(now.world_from_object))),
                glm::dmat4x3(before.world_from_object), 1e-6);
}

TEST(MotionOfAnObject, FlatAbsurdAndEndlessPlacesDoNotMove) {
    MovingObject flat;
    flat.world_from_object[2] = glm::vec3(0.0F);
    flat.velocity_per_s[0].y = 1.0F;
    glm::dmat4x3 back;
    EXPECT_FALSE(motion_back(MovingObject{}, flat, back));
    expect_near(motion_ahead(flat, 0.1), glm::dmat4x3(1.0), 0.0);
    MovingObject absurd;
    absurd.velocity_per_s = glm::mat4x3(1e6F);
    expect_near(motion_ahead(absurd, 0.1), glm::dmat4x3(1.0), 0.0);
    MovingObject tiny;
    tiny.world_from_object = glm::mat4x3(1e-30F);
    EXPECT_FALSE(motion_back(MovingObject{}, tiny, back));
}

/// Frames of one colour, in which an object covers all blocks, comes or goes.
class ComingAndGoing : public testing::Test {
protected:
    static constexpr Rgba8 kOld = 0xFF404040U;
    static constexpr Rgba8 kNew = 0xFFC0C0C0U;

    ComingAndGoing() : map_(kEdge_px / 2, kEdge_px / 4), depth_(kEdge_px / 2, kEdge_px / 4, 0.5F) {
        sampling_.tiles_x = sampling_.tiles_y = kEdge_px / 16;
        sampling_.level.assign(static_cast<std::size_t>(sampling_.tiles_x * sampling_.tiles_y), 1);
        compositor_ = make_cpu_compositor(square_display(), default_taa_weights());
    }
    void accumulate(Rgba8 color, std::optional<std::uint32_t> object) {
        const ColorImage picture(2 * kEdge_px, kEdge_px, color);
        std::vector<MovingObject> moving;
        if (object) moving.push_back({*object, glm::mat4x3(1.0F), glm::mat4x3(0.0F)});
        std::ranges::fill(map_.texels, static_cast<std::uint8_t>(moving.size()));
        NewFrame frame;
        frame.color = &picture;
        frame.depth = &depth_;
        frame.sampling = {&sampling_, &sampling_};
        frame.rank_tile = rank_tile_.rank;
        frame.rank_tile_size_px = RankTile::kEdge_px;
        frame.moving = moving;
        frame.moving_map = &map_;
        ASSERT_TRUE(compositor_->accumulate(frame));
    }
    /// Share of the history in a pixel that was interpolated in the last frame.
    double history_share() {
        ColorImage picture;
        EXPECT_TRUE(compositor_->show({}, 0, picture));
        double nearest_old = 0.0;
        for (const Rgba8 texel : picture.texels) {
            nearest_old = std::max(nearest_old, (0xC0 - static_cast<double>(texel & 255U)) / (0xC0 - 0x40));
        }
        return nearest_old;
    }

    oneapi::tbb::global_control one_thread_{oneapi::tbb::global_control::max_allowed_parallelism, 1};
    RankTile rank_tile_ = make_rank_tile();
    Image<std::uint8_t> map_;
    InverseDepthImage depth_;
    EyeSamplingMessage sampling_;
    std::unique_ptr<Compositor> compositor_;
};

TEST_F(ComingAndGoing, TheSameRestingObjectKeepsItsHistory) {
    accumulate(kOld, 7);
    accumulate(kNew, 7);
    EXPECT_GT(history_share(), 0.45);
}

TEST_F(ComingAndGoing, AnObjectThatWasNotSeenBeforeHasNone) {
    accumulate(kOld, 7);
    accumulate(kNew, 8);
    EXPECT_EQ(history_share(), 0.0);
}

TEST_F(ComingAndGoing, WhatWasBehindAnObjectThatWentHasNone) {
    accumulate(kOld, 7);
    accumulate(kNew, std::nullopt);
    EXPECT_EQ(history_share(), 0.0);
    accumulate(kOld, std::nullopt);
    EXPECT_LT(history_share(), 1.0) << "but from then on";
}

}  // namespace
}  // namespace macula
