// Shadow rays that are not traced change nothing: lights with cones, ranges, and backs, against a slow tracer that
// asks every light.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/slow_radiance.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr int kSize = 64;

/// Matt boxes on a floor and an unlit one, below lights of which each reaches only a part.
Scene boxes() {
    Scene scene;
    Material matt = test::white();
    matt.specular = 0.0F;
    matt.base_color = glm::vec4(0.8F, 0.6F, 0.4F, 1.0F);
    test::add(scene, make_quad({-6.0F, -1.0F, -9.0F}, {12.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 9.0F}), matt);
    const auto add_box = [&](const vec3& place, float turn, const Material& material) {
        test::add(scene, make_box({0.9F, 1.1F, 0.8F}), material,
                  glm::rotate(glm::translate(glm::mat4(1.0F), place), turn, glm::normalize(vec3(0.1F, 1.0F, 0.2F))));
    };
    add_box({-1.3F, -1.1F, -4.0F}, 0.4F, matt);
    add_box({0.2F, -1.2F, -3.2F}, 1.1F, matt);
    add_box({1.6F, -1.0F, -5.0F}, 2.3F, matt);
    add_box({1.2F, -1.1F, -3.0F}, 0.2F, test::unlit());
    return scene;
}

Light spot() {
    Light light;
    light.kind = LightKind::spot;
    light.position_m = vec3(-0.5F, 2.0F, -3.0F);
    light.direction = glm::normalize(vec3(0.1F, -1.0F, -0.3F));
    light.intensity = vec3(9.0F);
    light.spot_cos_outer = 0.92F;
    light.spot_cos_inner = 0.96F;
    return light;
}

Light short_range() {
    Light light;
    light.kind = LightKind::point;
    light.position_m = vec3(1.0F, 0.6F, -3.6F);
    light.intensity = vec3(2.0F, 1.0F, 3.0F);
    light.range_m = 1.9F;
    return light;
}

Light low_sun() {
    Light light;
    light.direction = glm::normalize(vec3(-1.0F, -0.4F, 0.3F));
    light.intensity = vec3(1.5F);
    return light;
}

Light from_below() {
    Light light;
    light.direction = glm::normalize(vec3(0.1F, 1.0F, 0.0F));
    return light;
}

Light panel_that_faces_away() {
    Light light;
    light.kind = LightKind::rectangle;
    light.position_m = vec3(0.0F, 1.0F, -4.0F);
    light.direction = vec3(0.0F, 1.0F, 0.0F);
    light.half_u_m = vec3(0.0F, 0.0F, 0.4F);
    light.half_v_m = vec3(0.4F, 0.0F, 0.0F);
    return light;
}

std::uint64_t lit_samples(const test::Traced& traced) {
    std::uint64_t count = 0;
    for (const std::uint32_t object : traced.samples.object_id) count += object != 0 && object != 5 ? 1 : 0;
    return count;
}

TEST(SkippedShadowRays, ChangeNothing) {
    Scene scene = boxes();
    scene.lights = {spot(), short_range(), low_sun(), from_below()};
    TraceCounts counts;
    const test::Traced traced = test::trace(scene, test::square_view(kSize), {}, 0.0, &counts);
    EXPECT_GT(counts.shadow, 0U);
    EXPECT_GT(counts.skipped_shadow, 0U);
    EXPECT_EQ(counts.shadow + counts.skipped_shadow, 4U * lit_samples(traced));
    const test::SlowRadiance slow(scene, 1);
    int checked = 0;
    int shadowed = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const test::SlowSight sight = slow.along(dvec3(0.0), dvec3(traced.tangents(x, y), -1.0F), 0);
            if (sight.margin < 1e-3) continue;
            ++checked;
            shadowed += sight.radiance.x < sight.open.x ? 1 : 0;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(traced.radiance(x, y)[c], sight.radiance[c], 2e-4 * sight.open[c] + 1e-5) << x << ", " << y;
        }
    }
    EXPECT_GT(checked, 3000);
    EXPECT_GT(shadowed, 100);
}

/// Each light alone is skipped exactly where it brings nothing by its formulas.
TEST(SkippedShadowRays, AreThoseThatBringNothing) {
    for (const Light& light : {spot(), short_range(), low_sun(), from_below()}) {
        Scene scene = boxes();
        scene.lights = {light};
        TraceCounts counts;
        const test::Traced traced = test::trace(scene, test::square_view(kSize), {}, 0.0, &counts);
        const test::SlowRadiance slow(scene, 1);
        std::int64_t expected = 0;
        std::int64_t undecided = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (traced.object(x, y) == 0 || traced.object(x, y) == 5) continue;
                const test::SlowSight sight = slow.along(dvec3(0.0), dvec3(traced.tangents(x, y), -1.0F), 0);
                if (sight.margin < 1e-3) ++undecided;
                expected += sight.open.x > 0.0 ? 1 : 0;
            }
        }
        EXPECT_NEAR(static_cast<double>(counts.shadow), static_cast<double>(expected),
                    static_cast<double>(undecided) + 2.0);
        EXPECT_GT(counts.skipped_shadow, 0U);
        EXPECT_LT(undecided, 120);
    }
}

TEST(SkippedShadowRays, NoneAreTracedToAPanelFromItsBack) {
    Scene scene = boxes();
    scene.lights = {panel_that_faces_away()};
    for (const int samples : {1, 4, 16, 64}) {
        TracerOptions options;
        options.light_samples = samples;
        TraceCounts counts;
        const test::Traced traced = test::trace(scene, test::square_view(kSize), options, 0.0, &counts);
        EXPECT_EQ(counts.shadow, 0U);
        EXPECT_EQ(counts.skipped_shadow, static_cast<std::uint64_t>(samples) * lit_samples(traced));
    }
}

TEST(SkippedShadowRays, LightsWithoutShadowsHaveNone) {
    Scene scene = boxes();
    scene.lights = {low_sun(), spot()};
    scene.lights[0].casts_shadow = false;
    TraceCounts counts;
    const test::Traced traced = test::trace(scene, test::square_view(kSize), {}, 0.0, &counts);
    EXPECT_EQ(counts.shadow + counts.skipped_shadow, lit_samples(traced));
}

}  // namespace
}  // namespace macula
