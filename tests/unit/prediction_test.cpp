#include "server/service/prediction.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <random>

namespace macula {
namespace {

constexpr std::int64_t kMs = 1'000'000;

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-5F) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
    EXPECT_NEAR(actual.z, expected.z, tolerance);
}

Track track_at_rest() {
    Track track;
    track.pose_time_ns = 1'000 * kMs;
    track.display_time_ns = 1'050 * kMs;
    return track;
}

TEST(PredictHead, StillHeadStaysWhereItIs) {
    Track track = track_at_rest();
    track.start_from_head = {glm::angleAxis(0.7F, glm::normalize(glm::vec3(1.0F, 2.0F, -1.0F))), {0.1F, 1.6F, -2.0F}};
    const Pose predicted = predict_head(track);
    expect_near(predicted.position_m, track.start_from_head.position_m);
    EXPECT_NEAR(std::abs(glm::dot(predicted.orientation, track.start_from_head.orientation)), 1.0F, 1e-6F);
}

TEST(PredictHead, MovesAlongTheVelocity) {
    Track track = track_at_rest();
    track.linear_velocity_m_s = {2.0F, 0.0F, -1.0F};
    expect_near(predict_head(track).position_m, {0.1F, 0.0F, -0.05F});
}

TEST(PredictHead, TurnsAboutTheAxisOfStartSpace) {
    // Looks to +X (turned -90 degrees about +Y), then rolls about start's +X, its own line of sight, by 90 degrees.
    Track track = track_at_rest();
    track.start_from_head.orientation = glm::angleAxis(-glm::half_pi<float>(), glm::vec3(0.0F, 1.0F, 0.0F));
    track.angular_velocity_rad_s = {glm::half_pi<float>() / 0.05F, 0.0F, 0.0F};
    const Pose predicted = predict_head(track);
    expect_near(predicted.direction({0.0F, 0.0F, -1.0F}), {1.0F, 0.0F, 0.0F});
    expect_near(predicted.direction({0.0F, 1.0F, 0.0F}), {0.0F, 0.0F, 1.0F});
}

TEST(PredictHead, IsBoundedAndNeverLooksBack) {
    Track track = track_at_rest();
    track.linear_velocity_m_s = {1.0F, 0.0F, 0.0F};
    track.display_time_ns = track.pose_time_ns + 60'000 * kMs;
    expect_near(predict_head(track).position_m, {0.1F, 0.0F, 0.0F});
    track.display_time_ns = track.pose_time_ns - 50 * kMs;
    expect_near(predict_head(track).position_m, {0.0F, 0.0F, 0.0F});
    track.pose_time_ns = std::numeric_limits<std::int64_t>::min();
    track.display_time_ns = std::numeric_limits<std::int64_t>::max();
    expect_near(predict_head(track).position_m, {0.1F, 0.0F, 0.0F});
}

TEST(PredictHead, TwoHalfStepsAreOneStep) {
    std::mt19937 random(20261122);
    std::uniform_real_distribution<float> uniform(-3.0F, 3.0F);
    for (int i = 0; i < 200; ++i) {
        Track track = track_at_rest();
        track.start_from_head.orientation =
            glm::normalize(glm::quat(uniform(random), uniform(random), uniform(random), uniform(random)));
        track.angular_velocity_rad_s = {uniform(random), uniform(random), uniform(random)};
        track.linear_velocity_m_s = {uniform(random), uniform(random), uniform(random)};
        const Pose once = predict_head(track);
        track.display_time_ns = track.pose_time_ns + 25 * kMs;
        track.start_from_head = predict_head(track);
        const Pose twice = predict_head(track);
        EXPECT_NEAR(std::abs(glm::dot(once.orientation, twice.orientation)), 1.0F, 1e-5F) << "case " << i;
        expect_near(once.position_m, twice.position_m);
    }
}

TEST(EyeViews, StandWhereTheEyesAre) {
    Display display;
    display.eye_width_px = 64;
    display.eye_height_px = 80;
    display.eyes[kLeftEye].head_from_eye.position_m = {-0.03F, 0.0F, 0.0F};
    display.eyes[kRightEye].head_from_eye.position_m = {0.03F, 0.0F, 0.0F};
    display.eyes[kRightEye].tangents.left = -0.5F;
    // The head looks to -X: its right is -Z.
    const Pose world_from_head = {glm::angleAxis(glm::half_pi<float>(), glm::vec3(0.0F, 1.0F, 0.0F)),
                                  {1.0F, 1.5F, 2.0F}};
    const PerEye<EyeView> views = eye_views(display, world_from_head);
    expect_near(views[kLeftEye].world_from_eye.position_m, {1.0F, 1.5F, 2.03F});
    expect_near(views[kRightEye].world_from_eye.position_m, {1.0F, 1.5F, 1.97F});
    expect_near(views[kRightEye].world_from_eye.direction({0.0F, 0.0F, -1.0F}), {-1.0F, 0.0F, 0.0F});
    EXPECT_EQ(views[kRightEye].tangents.left, -0.5F);
    EXPECT_EQ(views[kLeftEye].width_px, 64);
    EXPECT_EQ(views[kLeftEye].height_px, 80);
}

TEST(GazeHold, PassesRawGazeHoldsItAndGivesUp) {
    GazeHold hold;
    const glm::vec3 left = glm::normalize(glm::vec3(-1.0F, 0.0F, -1.0F));
    const glm::vec3 up = glm::normalize(glm::vec3(0.0F, 1.0F, -1.0F));
    EXPECT_EQ(hold.update({left, 1.0F}, 0), left);
    EXPECT_EQ(hold.update({up, 0.9F}, 4 * kMs), up);  // at once: nothing is smoothed
    EXPECT_EQ(hold.update({left, 0.1F}, 8 * kMs), up);
    EXPECT_EQ(hold.update({left, 0.0F}, 504 * kMs), up);
    EXPECT_EQ(hold.update({left, 0.0F}, 505 * kMs), glm::vec3(0.0F, 0.0F, -1.0F));
    EXPECT_EQ(hold.update({left, 0.8F}, 510 * kMs), left);
}

TEST(GazeHold, GivesUpInTimeThoughTheClockIsSetBack) {
    GazeHold hold;
    const glm::vec3 left = glm::normalize(glm::vec3(-1.0F, 0.0F, -1.0F));
    hold.update({left, 1.0F}, 3'600'000 * kMs);
    EXPECT_EQ(hold.update({left, 0.0F}, 0), left);
    EXPECT_EQ(hold.update({left, 0.0F}, 500 * kMs), left);
    EXPECT_EQ(hold.update({left, 0.0F}, 501 * kMs), glm::vec3(0.0F, 0.0F, -1.0F));
}

TEST(GazeHold, LooksAheadBeforeTheFirstGaze) {
    GazeHold hold;
    EXPECT_EQ(hold.update({glm::vec3(1.0F, 0.0F, 0.0F), 0.0F}, 7), glm::vec3(0.0F, 0.0F, -1.0F));
}

}  // namespace
}  // namespace macula
