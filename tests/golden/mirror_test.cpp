// Mirrors and what bounds their rays, against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/load.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

Material mirror() {
    Material material = test::white();
    material.metallic = 1.0F;
    material.roughness = 0.0F;
    return material;
}

/// Unlit colour that says where on a plane a point lies: red and green are x and y over 20 m, blue is 1.
constexpr float kChartHalf_m = 10.0F;
Mesh chart(const vec3& centre) {
    Mesh mesh = test::wall(centre, kChartHalf_m);
    for (const vec3& p : mesh.position_m)
        mesh.color.emplace_back((p.x - centre.x) / 20.0F + 0.5F, (p.y - centre.y) / 20.0F + 0.5F, 1.0F, 1.0F);
    return mesh;
}

/// A mirror across the view at z = -2 that leans by `angle` about the y axis, and behind the eye a chart at z = 3 that
/// faces it.
Scene mirror_scene(float angle) {
    Scene scene;
    test::add(scene, test::wall(vec3(0.0F), 5.0F), mirror(),
              glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -2.0F)), angle, vec3(0.0F, 1.0F, 0.0F)));
    test::add(scene, chart(vec3(0.0F)), test::unlit(),
              glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, 3.0F)), glm::radians(180.0F),
                          vec3(0.0F, 1.0F, 0.0F)));
    return scene;
}

TEST(Mirror, ShowsWhatLiesWhereTheReflectedRayGoes) {
    for (const float angle : {0.0F, 0.2F, -0.35F}) {
        const test::Traced traced = test::trace(mirror_scene(angle), test::square_view(33));
        const glm::dvec3 normal(std::sin(angle), 0.0, std::cos(angle));
        int checked = 0;
        for (int y = 0; y < 33; y += 2) {
            for (int x = 0; x < 33; x += 2) {
                const glm::dvec3 d(traced.tangents(x, y), -1.0F);
                const double t = glm::dot(glm::dvec3(0.0, 0.0, -2.0), normal) / glm::dot(d, normal);
                const glm::dvec3 hit = d * t;
                const glm::dvec3 r = d - normal * (2.0 * glm::dot(d, normal));
                const glm::dvec3 seen = hit + r * ((3.0 - hit.z) / r.z);
                if (r.z <= 0.0 || std::abs(seen.x) > 9.9 || std::abs(seen.y) > 9.9) continue;
                ++checked;
                const vec3 radiance = traced.radiance(x, y);
                ASSERT_GT(radiance.z, 0.9F);
                // The chart is turned half about y, so that its x runs the other way.
                EXPECT_NEAR(radiance.x / radiance.z, -seen.x / 20.0 + 0.5, 1e-4);
                EXPECT_NEAR(radiance.y / radiance.z, seen.y / 20.0 + 0.5, 1e-4);
                // The image lies behind the mirror, as far along the ray as the chart is by way of the mirror.
                const double path = t + (3.0 - hit.z) / r.z;
                EXPECT_NEAR(traced.image_inverse_depth(x, y), 1.0 / path, 1e-5);
                EXPECT_NEAR(traced.inverse_depth(x, y), 1.0 / t, 1e-5);
                EXPECT_EQ(traced.object(x, y), 1U);
            }
        }
        EXPECT_GT(checked, 50);
    }
}

TEST(Mirror, WithoutBouncesItShowsAmbientLight) {
    Scene scene = mirror_scene(0.0F);
    scene.ambient_radiance = vec3(0.25F);
    TracerOptions options;
    options.bounces = 0;
    TraceCounts counts;
    const test::Traced traced = test::trace(scene, test::square_view(9), options, 0.0, &counts);
    EXPECT_EQ(counts.reflection, 0U);
    EXPECT_NEAR(traced.radiance(4, 4).x, 0.25F, 0.01F);
    EXPECT_FLOAT_EQ(traced.image_inverse_depth(4, 4), traced.inverse_depth(4, 4));
}

TEST(Mirror, TwoFacingMirrorsReflectAsOftenAsBouncesAllow) {
    // Between mirrors at z = -2 and z = 2 that see nothing but each other; each last one shows the ambient light.
    for (const int bounces : {1, 2, 5}) {
        Scene scene;
        scene.ambient_radiance = vec3(1.0F);
        Material grey = mirror();
        grey.base_color = glm::vec4(0.5F, 0.5F, 0.5F, 1.0F);
        test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 50.0F), grey);
        test::add(scene, test::wall(vec3(0.0F), 50.0F), grey,
                  glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, 2.0F)), glm::radians(180.0F),
                              vec3(0.0F, 1.0F, 0.0F)));
        TracerOptions options;
        options.bounces = bounces;
        options.bounce_bound = 0.0F;
        TraceCounts counts;
        const test::Traced traced = test::trace(scene, test::square_view(3), options, 0.0, &counts);
        EXPECT_EQ(counts.reflection, 9U * static_cast<unsigned>(bounces));
        EXPECT_NEAR(traced.radiance(1, 1).x, std::pow(0.5F, static_cast<float>(bounces + 1)), 0.01F);
    }
}

TEST(BounceBound, FadesWithoutAStepAndIsOffAtZero) {
    // A floor that reflects more the flatter it is seen: rows go through the bound.
    Scene scene;
    scene.background_radiance = vec3(1.0F);
    Material floor = test::white();
    floor.roughness = 0.0F;
    floor.base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    test::add(scene, make_quad({-50.0F, -1.0F, -100.0F}, {100.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 100.0F}), floor);
    EyeView view = test::square_view(256);
    view.tangents = {-0.1F, 0.1F, -3.0F, -0.05F};
    TracerOptions all;
    all.bounce_bound = 0.0F;
    TracerOptions some;
    some.bounce_bound = 0.1F;
    TraceCounts all_counts;
    TraceCounts some_counts;
    const test::Traced exact = test::trace(scene, view, all, 0.0, &all_counts);
    const test::Traced bounded = test::trace(scene, view, some, 0.0, &some_counts);
    EXPECT_EQ(all_counts.skipped_bounce, 0U);
    EXPECT_EQ(all_counts.reflection, 256U * 256U);
    EXPECT_LT(some_counts.reflection, all_counts.reflection);
    EXPECT_GT(some_counts.reflection, 0U);
    float largest_step = 0.0F;
    for (int y = 1; y < 256; ++y) {
        // Nothing is changed by more than the bound, and no contour shows: a step would be of .1.
        EXPECT_LE(std::abs(exact.radiance(128, y).x - bounded.radiance(128, y).x), 0.2F);
        largest_step = std::max(largest_step, std::abs(bounded.radiance(128, y).x - bounded.radiance(128, y - 1).x));
    }
    EXPECT_LT(largest_step, 0.06F);
}

TEST(BounceBound, ErrorOnBunnyBoxIsSmall) {
    const auto loaded = load_scene("bunny-box");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EyeView view;
    view.world_from_eye = loaded->scene->world_from_start;
    view.tangents = {-1.0F, 1.0F, -0.75F, 0.75F};
    view.width_px = 128;
    view.height_px = 96;
    TracerOptions all;
    all.bounce_bound = 0.0F;
    const test::Traced exact = test::trace(*loaded->scene, view, all);
    const test::Traced bounded = test::trace(*loaded->scene, view);
    double sum = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < exact.samples.radiance.size(); ++i) {
        const vec3 difference = glm::abs(exact.samples.radiance[i] - bounded.samples.radiance[i]);
        const double error = std::max({difference.x, difference.y, difference.z});
        sum += error;
        largest = std::max(largest, error);
    }
    const double mean = sum / static_cast<double>(exact.samples.radiance.size());
    std::printf("bounce bound .02 on Bunny Box: mean error %.6f, largest %.4f of display white\n", mean, largest);
    EXPECT_LT(mean, 0.002);
    EXPECT_LT(largest, 0.1);
}

}  // namespace
}  // namespace macula
