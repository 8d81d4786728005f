#include "scenes/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace macula {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// One node with one channel.
Animation animate(AnimationPath path, Interpolation interpolation, std::vector<float> time_s,
                  std::vector<glm::vec4> value) {
    Animation animation;
    animation.nodes = {AnimationNode()};
    const float period = time_s.back();
    animation.channels = {{0, path, interpolation, std::move(time_s), std::move(value), period}};
    animation.duration_s = period;
    return animation;
}

glm::mat4 pose(const Animation& animation, double time_s, std::size_t node = 0) {
    std::vector<glm::mat4> world_from_node(17, glm::mat4(0.0F));  // what is there before does not matter
    pose_nodes(animation, time_s, world_from_node);
    EXPECT_EQ(world_from_node.size(), animation.nodes.size());
    return world_from_node.at(node);
}

glm::vec3 moved(const Animation& animation, double time_s, const glm::vec3& point = glm::vec3(0.0F),
                std::size_t node = 0) {
    return glm::vec3(pose(animation, time_s, node) * glm::vec4(point, 1.0F));
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5F) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

glm::vec4 turn_about_z(float angle_rad) {
    return {0.0F, 0.0F, std::sin(0.5F * angle_rad), std::cos(0.5F * angle_rad)};
}

/// Angle about z of where +x is at a time.
float angle_at(const Animation& animation, double time_s) {
    const glm::vec3 x = moved(animation, time_s, {1, 0, 0});
    EXPECT_NEAR(x.z, 0.0F, 1e-6F);
    EXPECT_NEAR(glm::length(x), 1.0F, 1e-6F);
    return std::atan2(x.y, x.x);
}

TEST(Animation, StepHoldsUntilTheNextKey) {
    const Animation a =
        animate(AnimationPath::translation, Interpolation::step, {0, 1, 3}, {{1, 0, 0, 0}, {2, 0, 0, 0}, {3, 0, 0, 0}});
    EXPECT_EQ(moved(a, 0.0).x, 1.0F);
    EXPECT_EQ(moved(a, 0.999).x, 1.0F);
    EXPECT_EQ(moved(a, 1.0).x, 2.0F);
    EXPECT_EQ(moved(a, 2.999).x, 2.0F);
}

TEST(Animation, LinearBetweenUnevenKeysAndHeldOutsideThem) {
    Animation a = animate(AnimationPath::translation, Interpolation::linear, {1, 2, 4},
                          {{0, 0, 0, 0}, {10, 0, 0, 0}, {10, 8, 0, 0}});
    expect_near(moved(a, 0.5), {0, 0, 0});
    expect_near(moved(a, 1.25), {2.5F, 0, 0});
    expect_near(moved(a, 3.0), {10, 4, 0});
    a.channels[0].period_s = 6.0F;  // as where another channel of the animation is longer
    expect_near(moved(a, 5.0), {10, 8, 0});
}

TEST(Animation, RepeatsForAnyTime) {
    const Animation a =
        animate(AnimationPath::translation, Interpolation::linear, {0, 4}, {{0, 0, 0, 0}, {4, 0, 0, 0}});
    for (const double loops : {0.0, 1.0, 7.0, -1.0, -3.0, 1e6})
        EXPECT_NEAR(moved(a, 4.0 * loops + 1.5).x, 1.5F, 1e-5F) << loops;
    // A year: a float of seconds would be off by two seconds here.
    EXPECT_NEAR(moved(a, 4.0 * 7884000 + 0.25).x, 0.25F, 1e-5F);
}

TEST(Animation, EachChannelHasItsOwnPeriod) {
    Animation a = animate(AnimationPath::translation, Interpolation::linear, {0, 2}, {{0, 0, 0, 0}, {2, 0, 0, 0}});
    a.nodes.emplace_back();
    a.channels.push_back(
        {1, AnimationPath::translation, Interpolation::linear, {0, 3}, {{0, 0, 0, 0}, {3, 0, 0, 0}}, 3.0F});
    EXPECT_NEAR(moved(a, 2.5, {}, 0).x, 0.5F, 1e-6F);
    EXPECT_NEAR(moved(a, 2.5, {}, 1).x, 2.5F, 1e-6F);
}

TEST(Animation, OneKeyIsConstant) {
    const Animation a = animate(AnimationPath::scale, Interpolation::linear, {0}, {{2, 3, 4, 0}});
    for (const double t : {-1.0, 0.0, 5.0}) expect_near(moved(a, t, {1, 1, 1}), {2, 3, 4});
}

TEST(Animation, SlerpTurnsEvenly) {
    const Animation a = animate(AnimationPath::rotation, Interpolation::linear, {0, 1},
                                {turn_about_z(0.0F), turn_about_z(0.75F * kPi)});
    for (int i = 0; i < 16; ++i) {
        const float u = static_cast<float>(i) / 16.0F;
        EXPECT_NEAR(angle_at(a, u), u * 0.75F * kPi, 1e-5F);
    }
}

TEST(Animation, SlerpTakesTheShorterWayWhateverTheSign) {
    for (const float sign : {1.0F, -1.0F}) {
        const Animation a = animate(AnimationPath::rotation, Interpolation::linear, {0, 1},
                                    {turn_about_z(0.1F), sign * turn_about_z(-0.3F)});
        for (const float u : {0.0F, 0.25F, 0.5F, 0.875F}) EXPECT_NEAR(angle_at(a, u), 0.1F - 0.4F * u, 1e-5F) << sign;
    }
}

TEST(Animation, SlerpOfRotationsThatAllButAgree) {
    const Animation a =
        animate(AnimationPath::rotation, Interpolation::linear, {0, 1}, {turn_about_z(0.5F), -turn_about_z(0.5001F)});
    EXPECT_NEAR(angle_at(a, 0.5), 0.50005F, 1e-6F);
}

TEST(Animation, CubicSplineReproducesACubic) {
    // x(t) = t^3 - 2 t^2 + 3, whose derivative is 3 t^2 - 4 t, from keys that are not evenly spaced.
    const auto x = [](float t) { return t * t * t - 2 * t * t + 3; };
    const auto slope = [](float t) { return 3 * t * t - 4 * t; };
    std::vector<float> times = {0.0F, 0.5F, 2.0F, 3.0F};
    std::vector<glm::vec4> values;
    for (const float t : times) {
        values.emplace_back(slope(t), 0, 0, 0);
        values.emplace_back(x(t), 0, 0, 0);
        values.emplace_back(slope(t), 0, 0, 0);
    }
    const Animation a = animate(AnimationPath::translation, Interpolation::cubic_spline, times, values);
    for (float t = 0.0F; t < 3.0F; t += 0.0625F) EXPECT_NEAR(moved(a, t).x, x(t), 1e-4F) << t;
}

TEST(Animation, CubicSplineHasTangentsOfItsOwnOnEachSide) {
    // In-tangent of the second key -6, out-tangent +6: a corner.
    const Animation a = animate(AnimationPath::translation, Interpolation::cubic_spline, {0, 1, 2},
                                {{9, 0, 0, 0},
                                 {0, 0, 0, 0},
                                 {0, 0, 0, 0},
                                 {-6, 0, 0, 0},
                                 {1, 0, 0, 0},
                                 {6, 0, 0, 0},
                                 {0, 0, 0, 0},
                                 {1, 0, 0, 0},
                                 {9, 0, 0, 0}});
    constexpr float kStep = 1.0F / 64.0F;
    EXPECT_NEAR((moved(a, 1.0).x - moved(a, 1.0 - kStep).x) / kStep, -6.0F, 0.5F);
    EXPECT_NEAR((moved(a, 1.0 + kStep).x - moved(a, 1.0).x) / kStep, 6.0F, 0.5F);
    // Half way the basis is 1/2, 1/8, 1/2, -1/8: 0.5 * 0 + 0.5 * 1 - 0.125 * (-6).
    EXPECT_NEAR(moved(a, 0.5).x, 1.25F, 1e-6F);
}

TEST(Animation, CubicSplineOfRotationsIsUnit) {
    const glm::vec4 zero(0.0F);
    const Animation a = animate(AnimationPath::rotation, Interpolation::cubic_spline, {0, 1},
                                {zero, turn_about_z(0.0F), zero, zero, turn_about_z(0.5F * kPi), zero});
    EXPECT_NEAR(angle_at(a, 0.5), 0.25F * kPi, 1e-5F);
    EXPECT_GT(angle_at(a, 0.25), 0.0F);
}

TEST(Animation, CubicSplineThroughNoRotationAtAllKeepsTheRestRotation) {
    const glm::vec4 zero(0.0F);
    Animation a = animate(AnimationPath::rotation, Interpolation::cubic_spline, {0, 1},
                          {zero, turn_about_z(0.3F), zero, zero, -turn_about_z(0.3F), zero});
    const glm::vec4 rest = turn_about_z(0.7F);
    a.nodes[0].rotation = glm::quat(rest.w, rest.x, rest.y, rest.z);
    EXPECT_NEAR(angle_at(a, 0.5), 0.7F, 1e-5F);
}

TEST(Animation, ScaleNeverVanishes) {
    const Animation a = animate(AnimationPath::scale, Interpolation::linear, {0, 2}, {{1, 1, 1, 0}, {-1, 1, 0, 0}});
    const glm::mat4 m = pose(a, 1.0);
    EXPECT_EQ(std::abs(m[0].x), kSmallestAnimatedScale);
    EXPECT_EQ(m[1].y, 1.0F);
    EXPECT_EQ(m[2].z, 0.5F);
    EXPECT_LT(pose(a, 1.5)[0].x, 0.0F) << "a mirrored object stays mirrored";
}

TEST(Animation, OtherPropertiesAndParentsStay) {
    Animation a;
    a.nodes.resize(2);
    a.nodes[0].translation_m = {10, 0, 0};
    a.nodes[0].scale = glm::vec3(2.0F);
    a.nodes[1].parent = 0;
    a.nodes[1].translation_m = {1, 0, 0};
    a.nodes[1].scale = {1, 1, 3};
    a.nodes[1].parent_from_place[3] = glm::vec4(0, 0, 5, 1);  // a matrix between the two
    a.channels = {
        {0, AnimationPath::rotation, Interpolation::linear, {0, 1}, {turn_about_z(0), turn_about_z(kPi / 2)}, 1.0F},
        {0, AnimationPath::translation, Interpolation::step, {0, 0.25F}, {{10, 0, 0, 0}, {20, 0, 0, 0}}, 1.0F}};
    // (0, 1, 1) -> scaled (0, 1, 3) -> moved (1, 1, 8) -> scaled (2, 2, 16) -> turned by 45 degrees -> moved by 20.
    const float h = std::sqrt(0.5F);
    expect_near(moved(a, 0.5, {0, 1, 1}, 1), {20 + 2 * h - 2 * h, 2 * h + 2 * h, 16});
    expect_near(moved(a, 0.0, {0, 1, 1}, 1), {12, 2, 16});
}

TEST(Animation, NothingMovesNothing) {
    const Animation none;
    EXPECT_FALSE(none.present());
    std::vector<glm::mat4> out(3);
    pose_nodes(none, 1.0, out);
    EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace macula
