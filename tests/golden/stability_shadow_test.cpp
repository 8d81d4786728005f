// Shadow rays that meet the surface they leave, or miss the one that should stop them: pixels against what convex and
// closed shapes must show.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/slow_trace.h"

namespace macula {
namespace {

using glm::vec3;

constexpr int kSize_px = 160;

Light sun_along(const vec3& direction) {
    return {.direction = glm::normalize(direction)};
}

Light lamp_at(const vec3& position_m, float intensity) {
    return {.kind = LightKind::point, .position_m = position_m, .intensity = vec3(intensity)};
}

// Nothing convex shades itself, however few its triangles are and however flat the light comes in.
TEST(SelfIntersection, ConvexShapesHaveNoAcne) {
    test::WrongPixels sum;
    for (const float radius : {1e-3F, 1.0F, 1e4F}) {
        for (const int segments : {8, 32, 128}) {
            for (const vec3 direction : {vec3(0.0F, 0.0F, -1.0F), vec3(1.0F, 0.05F, -0.1F), vec3(0.2F, -1.0F, 0.3F),
                                         vec3(-0.7F, 0.1F, 0.7F)}) {
                Scene scene;
                scene.lights.push_back(sun_along(direction));
                test::add(scene, make_sphere(radius, segments), test::matte());
                const test::WrongPixels wrong =
                    test::falsely_shaded(scene, test::square_view(kSize_px, vec3(0.0F, 0.0F, 1.7F * radius)));
                sum.wrong += wrong.wrong;
                sum.compared += wrong.compared;
            }
        }
    }
    sum.report("acne_on_balls");
    EXPECT_EQ(sum.wrong, 0);
    EXPECT_GT(sum.compared, 300000);
}

// Nor does the inside of a convex shape: a lamp in it is seen from everywhere, also from where it is almost behind the
// horizon.
TEST(SelfIntersection, TheInsideOfABallHasNoAcne) {
    test::WrongPixels sum;
    for (const float radius : {1e-3F, 1.0F, 1e4F}) {
        for (const int segments : {8, 32, 128}) {
            for (const vec3 place : {vec3(0.0F), vec3(0.2F, 0.15F, -0.7F), vec3(-0.05F, 0.8F, 0.0F)}) {
                Scene scene;
                scene.lights.push_back(lamp_at(place * radius, radius * radius));
                Material material = test::matte();
                material.double_sided = true;
                test::add(scene, make_sphere(radius, segments), material);
                const test::WrongPixels wrong =
                    test::falsely_shaded(scene, test::square_view(kSize_px, vec3(0.1F, 0.05F, 0.2F) * radius));
                sum.wrong += wrong.wrong;
                sum.compared += wrong.compared;
            }
        }
    }
    sum.report("acne_inside_balls");
    EXPECT_EQ(sum.wrong, 0);
    EXPECT_GT(sum.compared, 300000);
}

// The facets of a ball turn away from a light before or after the ball itself does, by up to half the angle between
// neighbouring facets' middles and their edges: pi / segments across, and as much along, so sqrt(2) pi / segments. No
// pixel outside this band about the terminator may be wrong. Within it, the share of the picture is what a client sees
// of the facets; it falls with their number.
TEST(SelfIntersection, TheShadowTerminatorOfAPolyhedronIsAsWideAsItsFacets) {
    double last_share = 1.0;
    for (const int segments : {16, 32, 64, 128}) {
        Scene scene;
        const vec3 to_light = glm::normalize(vec3(1.0F, 0.3F, 0.2F));
        scene.lights.push_back(sun_along(-to_light));
        test::add(scene, make_sphere(1.0F, segments), test::matte());
        const test::Traced traced = test::trace(scene, test::square_view(kSize_px, {0.0F, 0.0F, 1.8F}));
        const double band = std::sqrt(2.0) * std::numbers::pi / segments;
        test::WrongPixels terminator;
        test::WrongPixels elsewhere;
        for (int y = 0; y < kSize_px; ++y) {
            for (int x = 0; x < kSize_px; ++x) {
                if (traced.object(x, y) == 0) continue;
                const glm::dvec3 point = glm::dvec3(0.0, 0.0, 1.8) +
                                         glm::dvec3(traced.tangents(x, y), -1.0) * (1.0 / traced.inverse_depth(x, y));
                const double cosine = glm::dot(glm::normalize(point), glm::dvec3(to_light));
                const bool wrong = (traced.radiance(x, y).x > 0.0F) != (cosine > 0.0);
                terminator.count(wrong);
                if (std::abs(std::asin(cosine)) > band) elsewhere.count(wrong);
            }
        }
        terminator.report("terminator_of_" + std::to_string(segments) + "_segments");
        EXPECT_EQ(elsewhere.wrong, 0);
        const double share = static_cast<double>(terminator.wrong) / terminator.compared;
        EXPECT_LT(share, 0.6 * last_share);
        last_share = share;
    }
}

/// Pixels that are not black inside a closed shape whose lights are all outside.
test::WrongPixels leaks(Mesh mesh, const glm::mat4& place, const std::vector<Light>& lights, const vec3& eye) {
    Scene scene;
    scene.lights = lights;
    Material material = test::matte();
    material.double_sided = true;
    test::add(scene, std::move(mesh), material, place);
    test::WrongPixels result;
    for (const float yaw : {0.0F, 0.5F, 2.0F, 4.0F}) {
        EyeView view = test::square_view(kSize_px, eye);
        view.world_from_eye.orientation = glm::angleAxis(yaw, glm::normalize(vec3(0.1F, 1.0F, 0.2F)));
        const test::Traced traced = test::trace(scene, view);
        for (std::size_t i = 0; i < traced.samples.radiance.size(); ++i)
            result.count(traced.samples.object_id[i] != 1 || traced.samples.radiance[i] != vec3(0.0F));
    }
    return result;
}

/// Suns from three sides, and lamps on the same sides of a place, `distance_m` away.
std::vector<Light> lights_around(const vec3& place, float distance_m) {
    std::vector<Light> lights;
    for (const vec3 direction : {vec3(0.3F, -1.0F, -0.2F), vec3(-1.0F, 0.02F, 0.01F), vec3(0.6F, 0.5F, 0.6F)}) {
        lights.push_back(sun_along(direction));
        lights.push_back(lamp_at(place - glm::normalize(direction) * distance_m, distance_m * distance_m));
    }
    return lights;
}

TEST(LightLeaks, ClosedRoomsAreDark) {
    test::WrongPixels sum;
    for (const float half : {5e-4F, 2.0F, 5e4F}) {
        const glm::mat4 tilt = glm::rotate(glm::mat4(1.0F), 0.4F, glm::normalize(vec3(0.6F, 0.64F, 0.48F)));
        for (const glm::mat4& turn : {glm::mat4(1.0F), tilt}) {
            const glm::mat4 place = glm::translate(turn, vec3(0.0F, -half, 0.0F));
            const test::WrongPixels wrong =
                leaks(make_box(vec3(2.0F * half)), place, lights_around(vec3(0.0F), 1.75F * half),
                      vec3(0.1F, 0.3F, -0.2F) * half);
            sum.wrong += wrong.wrong;
            sum.compared += wrong.compared;
        }
    }
    sum.report("leaks_into_rooms");
    EXPECT_EQ(sum.wrong, 0);
}

TEST(LightLeaks, ClosedBallsAreDark) {
    test::WrongPixels sum;
    for (const float radius : {5e-4F, 2.0F, 5e4F}) {
        for (const int segments : {8, 32, 128}) {
            const test::WrongPixels wrong =
                leaks(make_sphere(radius, segments), glm::rotate(glm::mat4(1.0F), 0.4F, vec3(0.6F, 0.0F, 0.8F)),
                      lights_around(vec3(0.0F), 1.001F * radius), vec3(0.1F, 0.3F, -0.2F) * radius);
            sum.wrong += wrong.wrong;
            sum.compared += wrong.compared;
        }
    }
    sum.report("leaks_into_balls");
    EXPECT_EQ(sum.wrong, 0);
}

// Ten kilometres from the origin floats are 1 mm apart, so that a hit that lies nearer than that to an edge of the room
// may be placed beyond the wall next to it. A millimetre is a twentieth of a pixel here, and edges cross some 600
// pixels of each of the four views: at most 120 pixels, all of them at edges.
TEST(LightLeaks, ARoomTenKilometresAwayIsDark) {
    const vec3 place(10000.0F, -300.0F, 4000.0F);
    const glm::mat4 turn =
        glm::rotate(glm::translate(glm::mat4(1.0F), place), 0.4F, glm::normalize(vec3(0.6F, 0.64F, 0.48F)));
    const test::WrongPixels wrong = leaks(make_box(vec3(4.0F)), glm::translate(turn, vec3(0.0F, -2.0F, 0.0F)),
                                          lights_around(place, 3.5F), place + vec3(0.1F, 0.3F, -0.2F));
    wrong.report("leaks_10_km_away");
    EXPECT_LE(wrong.wrong, 120);
}

/// A tent: two roofs that meet at `angle_rad` along a ridge of 2 m, a floor and two gables, all closed.
Mesh tent(float angle_rad) {
    const float half = std::tan(0.5F * angle_rad);
    const vec3 front_ridge(0.0F, 0.0F, 1.0F);
    const vec3 back_ridge(0.0F, 0.0F, -1.0F);
    Mesh mesh;
    mesh.position_m = {front_ridge, front_ridge + vec3(-half, -1.0F, 0.0F), front_ridge + vec3(half, -1.0F, 0.0F),
                       back_ridge,  back_ridge + vec3(-half, -1.0F, 0.0F),  back_ridge + vec3(half, -1.0F, 0.0F)};
    mesh.normal.assign(6, vec3(0.0F, 1.0F, 0.0F));
    mesh.triangle = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}};
    return mesh;
}

// In the ridge of a tent the step off one roof leads through the other. That is where they are closer together than
// twice the step: 5e-7 m / sin 5 degrees = 6 um below the ridge, a thousandth of a pixel here.
TEST(LightLeaks, ATentIsDarkUpToItsRidge) {
    Scene scene;
    scene.lights = {sun_along({1.0F, -0.3F, 0.1F}), sun_along({-1.0F, -0.2F, 0.0F}), sun_along({0.1F, -1.0F, 0.0F})};
    Material material = test::matte();
    material.double_sided = true;
    test::add(scene, tent(5.0F * std::numbers::pi_v<float> / 180.0F), material);
    EyeView view = test::square_view(kSize_px, {0.0F, -0.6F, 0.9F});
    const test::Traced traced = test::trace(scene, view);
    test::WrongPixels leaks;
    for (const vec3& radiance : traced.samples.radiance) leaks.count(radiance != vec3(0.0F));
    leaks.report("leaks_into_tent");
    EXPECT_EQ(leaks.wrong, 0);
}

}  // namespace
}  // namespace macula
