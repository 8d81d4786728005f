// What is seen where: depth and object ids against closed forms, on off-centre frusta and turned eyes.

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

/// A turned eye with an off-centre frustum.
EyeView turned_view() {
    EyeView view;
    view.world_from_eye.orientation = glm::angleAxis(0.7F, glm::normalize(vec3(0.2F, 1.0F, -0.1F)));
    view.world_from_eye.position_m = vec3(1.0F, 2.0F, 3.0F);
    view.tangents = {-1.4F, 1.25F, -1.48F, 1.46F};
    view.width_px = 60;
    view.height_px = 70;
    return view;
}

TEST(Geometry, DepthOfAPlaneIsAffineInTheImage) {
    const EyeView view = turned_view();
    // A plane that the eye sees at an angle, given in eye space and taken to the world.
    const vec3 normal_eye = glm::normalize(vec3(0.3F, -0.2F, 1.0F));
    const vec3 point_eye(0.0F, 0.0F, -5.0F);
    Scene scene;
    const glm::mat4 world_from_eye = glm::translate(glm::mat4(1.0F), view.world_from_eye.position_m) *
                                     glm::mat4_cast(view.world_from_eye.orientation);
    const vec3 front(0.0F, 0.0F, 1.0F);
    const glm::quat tilt =
        glm::angleAxis(std::acos(glm::dot(front, normal_eye)), glm::normalize(glm::cross(front, normal_eye)));
    const glm::mat4 place = world_from_eye * glm::translate(glm::mat4(1.0F), point_eye) * glm::mat4_cast(tilt);
    const std::uint32_t object = test::add(scene, test::wall(vec3(0.0F), 200.0F), test::unlit(), place);
    const test::Traced traced = test::trace(scene, view);
    for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) {
            const vec3 ray(traced.tangents(x, y), -1.0F);
            const float expected = glm::dot(ray, normal_eye) / glm::dot(point_eye, normal_eye);
            EXPECT_NEAR(traced.inverse_depth(x, y), expected, 2e-6F) << x << ", " << y;
            EXPECT_EQ(traced.object(x, y), object);
        }
    }
}

TEST(Geometry, NearestObjectWinsAndTheBackgroundHasNoDepth) {
    Scene scene;
    scene.background_radiance = vec3(0.25F, 0.5F, 1.0F);
    const std::uint32_t far = test::add(scene, test::wall({0.0F, 0.0F, -4.0F}, 2.0F), test::unlit());
    const std::uint32_t near = test::add(scene, test::wall({0.5F, 0.5F, -2.0F}, 0.5F), test::unlit({1, 0, 0, 1}));
    const test::Traced traced = test::trace(scene, test::square_view(64));
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const glm::vec2 t = traced.tangents(x, y);
            const bool on_near = t.x > 0.0F && t.x < 0.5F && t.y > 0.0F && t.y < 0.5F;
            const bool on_far = std::max(std::abs(t.x), std::abs(t.y)) < 0.5F;
            EXPECT_EQ(traced.object(x, y), on_near ? near : (on_far ? far : 0U));
            EXPECT_FLOAT_EQ(traced.inverse_depth(x, y), on_near ? 0.5F : (on_far ? 0.25F : 0.0F));
            if (!on_far) {
                EXPECT_EQ(traced.radiance(x, y), scene.background_radiance);
            }
        }
    }
    EXPECT_EQ(traced.color(40, 24), 0xFF0000FFU);  // red in the lowest byte, up and right of the centre
}

TEST(Geometry, MirroredAndScaledInstancesKeepTheirFronts) {
    Scene scene;
    Light sun;
    sun.direction = vec3(0.0F, 0.0F, -1.0F);
    scene.lights.push_back(sun);
    const glm::mat4 mirror = glm::scale(glm::mat4(1.0F), vec3(-1.0F, 1.0F, 1.0F));
    const glm::mat4 stretch =
        glm::scale(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -3.0F)), vec3(2.0F, 5.0F, 0.5F));
    const std::uint32_t plain = test::add(scene, test::wall({1.0F, 0.0F, -2.0F}, 0.9F), test::white());
    const std::uint32_t mirrored = test::add(scene, test::wall({1.0F, 0.0F, -2.0F}, 0.9F), test::white(), mirror);
    const std::uint32_t stretched = test::add(scene, test::wall(vec3(0.0F), 5.0F), test::white(), stretch);
    const test::Traced traced = test::trace(scene, test::square_view(64));
    EXPECT_EQ(traced.object(48, 32), plain);
    EXPECT_EQ(traced.object(15, 32), mirrored);
    EXPECT_EQ(traced.object(32, 2), stretched);
    EXPECT_EQ(traced.radiance(48, 32), traced.radiance(15, 32));
    EXPECT_GT(traced.radiance(32, 2).x, 0.1F);
}

TEST(Geometry, ExposureScalesWhatIsShownAndNotTheRadiance) {
    Scene scene;
    scene.exposure = 0.5F;
    test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 8.0F), test::unlit({1, 1, 0, 1}));
    const test::Traced traced = test::trace(scene, test::square_view(16));
    EXPECT_EQ(traced.radiance(8, 8), vec3(1.0F, 1.0F, 0.0F));
    EXPECT_EQ(traced.color(8, 8), 0xFF00BCBCU);  // sRGB of a half is 188
}

}  // namespace
}  // namespace macula
