// Shadows against closed forms: where their edges lie, that lit surfaces have no acne, that closed boxes are dark.

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

Light sun_along(const vec3& direction) {
    Light sun;
    sun.direction = glm::normalize(direction);
    return sun;
}

Light lamp_at(const vec3& position) {
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position_m = position;
    return lamp;
}

/// Wall at z = -4 and, nearer to the lights but behind the eye, a square that shades it.
Scene shaded_wall(const Light& light) {
    Scene scene;
    scene.lights.push_back(light);
    test::add(scene, test::wall({0.0F, 0.0F, -4.0F}, 10.0F), test::white());
    Material blocker = test::white();
    blocker.double_sided = true;
    test::add(scene, test::wall({0.0F, 0.0F, 1.0F}, 0.5F), blocker);
    return scene;
}

/// Pixels whose light differs from that of a shadow of half edge `half` centred at `centre` on the wall at z = -4;
/// those within `slack_m` of its edge are not counted.
int wrong_pixels(const Scene& scene, const glm::vec2& centre, float half, float slack_m) {
    const test::Traced traced = test::trace(scene, test::square_view(256));
    int wrong = 0;
    int shaded = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const glm::vec2 offset = glm::abs(traced.tangents(x, y) * 4.0F - centre);
            const float from_edge = std::max(offset.x, offset.y) - half;
            if (std::abs(from_edge) < slack_m) continue;
            const bool dark = traced.radiance(x, y) == vec3(0.0F);
            shaded += dark ? 1 : 0;
            wrong += dark != (from_edge < 0.0F) ? 1 : 0;
        }
    }
    EXPECT_GT(shaded, 100);
    return wrong;
}

TEST(Shadow, EdgeOfADirectionalShadowLiesWhereItMust) {
    // The square lies 5 m before the wall; the sun moves its shadow by 5 tan(angle).
    const Light sun = sun_along({0.2F, -0.1F, -1.0F});
    EXPECT_EQ(wrong_pixels(shaded_wall(sun), {1.0F, -0.5F}, 0.5F, 1e-4F), 0);
}

TEST(Shadow, EdgeOfAPointLightsShadowLiesWhereItMust) {
    // From 3 m behind the square its shadow on the wall 5 m before it grows by 8/3.
    const Light lamp = lamp_at({0.0F, 0.0F, 4.0F});
    EXPECT_EQ(wrong_pixels(shaded_wall(lamp), {0.0F, 0.0F}, 0.5F * 8.0F / 3.0F, 1e-4F), 0);
}

TEST(Shadow, LightsThatCastNoneShineThrough) {
    Light sun = sun_along({0.0F, 0.0F, -1.0F});
    sun.casts_shadow = false;
    const test::Traced traced = test::trace(shaded_wall(sun), test::square_view(64));
    for (int i = 0; i < 64; ++i) EXPECT_GT(traced.radiance(i, i).x, 0.0F);
}

TEST(Shadow, WhatLiesBeyondAPointLightDoesNotShade) {
    const test::Traced traced = test::trace(shaded_wall(lamp_at({0.0F, 0.0F, 0.5F})), test::square_view(64));
    for (int i = 0; i < 64; ++i) EXPECT_GT(traced.radiance(i, i).x, 0.0F);
}

/// Dark pixels on surfaces that nothing shades, seen from `height_m` above a plane tilted in all three axes, and on a
/// ball of many small triangles, both at `place`.
int acne(const vec3& place, float height_m) {
    int dark = 0;
    for (const vec3 direction : {vec3(0.3F, 0.2F, -1.0F), vec3(0.9F, 0.1F, -0.3F), vec3(0.0F, 0.999F, -0.04F)}) {
        Scene scene;
        scene.lights.push_back(sun_along(direction));
        const vec3 centre = place + vec3(0.0F, 0.0F, -height_m);
        const glm::mat4 tilt = glm::rotate(glm::translate(glm::mat4(1.0F), centre), 0.02F, vec3(0.6F, 0.64F, 0.48F));
        Material material = test::white();
        material.double_sided = true;
        test::add(scene, test::wall(vec3(0.0F), 20.0F * height_m), material, tilt);
        const test::Traced traced = test::trace(scene, test::square_view(256, place));
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) dark += traced.radiance(x, y).x <= 0.0F ? 1 : 0;
        }
    }
    return dark;
}

TEST(Shadow, LitPlanesHaveNoAcne) {
    EXPECT_EQ(acne(vec3(0.0F), 2.0F), 0);
    EXPECT_EQ(acne(vec3(0.0F), 1e-2F), 0);
    EXPECT_EQ(acne(vec3(0.0F), 500.0F), 0);
}

TEST(Shadow, LitPlanesTenKilometresAwayHaveNoAcne) {
    EXPECT_EQ(acne(vec3(6000.0F, 3000.0F, -7000.0F), 2.0F), 0);
    EXPECT_EQ(acne(vec3(10000.0F, 0.0F, 0.0F), 2.0F), 0);
    EXPECT_EQ(acne(vec3(10000.0F, 0.0F, 0.0F), 100.0F), 0);
}

/// Lit pixels inside a closed box whose walls stand between all that is seen and the lights.
int leaks(const vec3& place) {
    Scene scene;
    scene.lights.push_back(sun_along({0.3F, -1.0F, -0.2F}));
    scene.lights.push_back(sun_along({-1.0F, 0.02F, 0.01F}));
    scene.lights.push_back(lamp_at(place + vec3(0.0F, 3.0F, 0.0F)));
    scene.lights.front().intensity = vec3(1e3F);
    Material material = test::white();
    material.double_sided = true;
    test::add(scene, make_box({2.0F, 2.0F, 2.0F}), material,
              glm::translate(glm::mat4(1.0F), place - vec3(0.0F, 1.0F, 0.0F)));
    const test::Traced traced = test::trace(scene, test::square_view(512, place));
    int lit = 0;
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) lit += traced.radiance(x, y) != vec3(0.0F) ? 1 : 0;
    }
    return lit;
}

TEST(Shadow, ClosedBoxesAreDark) {
    EXPECT_EQ(leaks(vec3(0.0F)), 0);
    EXPECT_EQ(leaks(vec3(10000.0F, -300.0F, 4000.0F)), 0);
}

}  // namespace
}  // namespace macula
