// Large triangles that are askew to the axes: the distance of their planes, and with it that of a hit, is wrong by an
// amount that grows with the triangle and not with the hit's place.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/support/slow_trace.h"

namespace macula {
namespace {

using glm::vec3;

constexpr int kSize_px = 160;

TEST(StabilityOfLargeTriangles, TiltedPlanesHaveNoAcne) {
    test::WrongPixels sum;
    for (const float half : {10.0F, 100.0F, 1e3F, 1e4F, 5e4F}) {
        for (const float tilt_rad : {0.0F, 0.02F, 0.3F}) {
            for (const float height_m : {0.01F, 1.7F}) {
                Scene scene;
                scene.lights.push_back({.direction = glm::normalize(vec3(0.3F, -0.8F, -0.2F))});
                const Mesh ground =
                    make_quad({-half, 0.0F, -half}, {2.0F * half, 0.0F, 0.0F}, {0.0F, 0.0F, 2.0F * half});
                test::add(scene, ground, test::matte(),
                          glm::rotate(glm::mat4(1.0F), tilt_rad, glm::normalize(vec3(0.6F, 0.64F, 0.48F))));
                EyeView view = test::square_view(kSize_px, {0.0F, height_m, 0.0F});
                view.tangents.bottom = -2.0F;
                view.tangents.top = -0.05F;
                const test::WrongPixels wrong = test::falsely_shaded(scene, view);
                sum.wrong += wrong.wrong;
                sum.compared += wrong.compared;
            }
        }
    }
    sum.report("acne_on_large_planes");
    EXPECT_EQ(sum.wrong, 0);
    EXPECT_GT(sum.compared, 500000);
}

// The eye is 1 mm above a quad of 100 m that stands askew to all axes.
TEST(StabilityOfLargeTriangles, TiltedPlanesAreSeenAtGrazingAngles) {
    Scene scene;
    scene.lights.push_back({.direction = glm::normalize(vec3(0.6F, -0.8F, 0.1F))});
    const glm::quat tilt = glm::angleAxis(0.3F, glm::normalize(vec3(0.5F, 0.2F, 0.8F)));
    test::add(
        scene,
        make_quad(tilt * vec3(-50.0F, 0.0F, -50.0F), tilt * vec3(100.0F, 0.0F, 0.0F), tilt * vec3(0.0F, 0.0F, 100.0F)),
        test::matte());
    EyeView view = test::square_view(kSize_px, tilt * vec3(0.0F, 1e-3F, 0.0F));
    view.world_from_eye.orientation = tilt;
    view.tangents = {-0.01F, 0.01F, -0.02F, static_cast<float>(-std::tan(0.01 * std::numbers::pi / 180.0))};
    const test::Comparison wrong = test::compare_with_slow(scene, view);
    wrong.seen.report("grazing_tilted_seen");
    wrong.shadowed.report("grazing_tilted_lit");
    EXPECT_EQ(wrong.seen.compared, kSize_px * kSize_px);
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.shadowed.wrong, 0);
}

}  // namespace
}  // namespace macula
