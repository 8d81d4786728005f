// Light from an image all around, as the tracer shows it and as surfaces receive it.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/texture_image.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr int kSize = 48;

void surround(Scene& scene, const TextureImage& image, float intensity = 1.0F, float rotation_rad = 0.0F) {
    scene.environment.image = static_cast<int>(scene.images.size());
    scene.environment.intensity = intensity;
    scene.environment.rotation_rad = rotation_rad;
    scene.images.push_back(image);
}

TextureImage constant_map(float value) {
    return test::make_image(32, 16, 3, TexelType::f32, [value](int, int) { return glm::vec4(value); });
}

/// A colour for every direction (unit), linear in its components.
dvec3 color_of(const dvec3& direction) {
    return 0.5 + 0.4 * direction;
}

/// The map of that, by the definition in scene.h.
TextureImage direction_map() {
    constexpr int kWidth = 64;
    constexpr int kHeight = 32;
    return test::make_image(kWidth, kHeight, 3, TexelType::f32, [](int x, int y) {
        const double phi = 2.0 * std::numbers::pi * (x + 0.5) / kWidth;
        const double theta = std::numbers::pi * (y + 0.5) / kHeight;
        const dvec3 direction(-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta));
        return glm::vec4(vec3(color_of(direction)), 1.0F);
    });
}

/// What is seen along a direction of the world when the map is turned.
dvec3 seen_along(const dvec3& any_direction, double rotation_rad) {
    const dvec3 d = glm::normalize(any_direction);
    const double c = std::cos(rotation_rad);
    const double s = std::sin(rotation_rad);
    return color_of({c * d.x - s * d.z, d.y, s * d.x + c * d.z});
}

void expect_near(const vec3& found, const dvec3& expected, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance);
}

TEST(EnvironmentLight, RaysThatMissSeeTheTurnedMap) {
    for (const float rotation : {0.0F, 0.6F, -2.2F}) {
        Scene scene;
        scene.background_radiance = vec3(9.0F);  // the map stands in its place
        scene.materials.push_back(test::white());
        surround(scene, direction_map(), 1.5F, rotation);
        const auto tracer = test::tracer_of(scene);
        const SamplePlan plan = test::full_plan(kSize, kSize);
        for (const float turn : {0.0F, 1.3F, 3.0F}) {
            EyeView view = test::square_view(kSize);
            view.world_from_eye.orientation = glm::angleAxis(turn, glm::normalize(vec3(0.2F, 1.0F, 0.1F)));
            test::Traced traced{view, {}};
            traced.samples.keep_radiance = true;
            const TraceTask task{&traced.view, &plan, &traced.samples};
            tracer->trace({&task, 1});
            for (int y = 0; y < kSize; ++y) {
                for (int x = 0; x < kSize; ++x) {
                    const dvec3 d(view.world_from_eye.direction(vec3(traced.tangents(x, y), -1.0F)));
                    expect_near(traced.radiance(x, y), 1.5 * seen_along(d, static_cast<double>(rotation)), 3e-3);
                    ASSERT_EQ(traced.inverse_depth(x, y), 0.0F);
                    ASSERT_EQ(traced.object(x, y), 0U);
                }
            }
        }
    }
}

TEST(EnvironmentLight, AMirrorShowsWhatLiesWhereTheReflectedRayGoes) {
    Scene scene;
    Material mirror = test::white();
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 10.0F), mirror);
    surround(scene, direction_map(), 1.0F, 0.6F);
    const test::Traced traced = test::trace(scene, test::square_view(kSize));
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x)
            expect_near(traced.radiance(x, y), seen_along(dvec3(traced.tangents(x, y), 1.0F), double{0.6F}), 3e-3);
    }
}

TEST(EnvironmentLight, AMattWallReceivesItsHalfOfTheMap) {
    // The irradiance of radiance a + b.d over the half around n is pi a + 2/3 pi b.n.
    Scene scene;
    Material matt = test::white();
    matt.specular = 0.0F;
    test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 10.0F), matt);
    surround(scene, direction_map());
    const test::Traced traced = test::trace(scene, test::square_view(kSize));
    const dvec3 expected = 0.5 + 0.4 * (2.0 / 3.0) * dvec3(0.0, 0.0, 1.0);
    for (int i = 0; i < kSize; ++i) expect_near(traced.radiance(i, 7), expected, 5e-3);
}

struct Named {
    const char* name;
    Material material;
};

/// White materials of every kind that can lose or gain light.
std::array<Named, 9> white_materials() {
    const auto rough = [](float metallic, float roughness) {
        Material material = test::white();
        material.metallic = metallic;
        material.roughness = roughness;
        return material;
    };
    Material glass = rough(0.0F, 0.0F);
    glass.transmission = 1.0F;
    glass.thickness_m = 1.0F;
    Material pane = glass;
    pane.thickness_m = 0.0F;
    Material film = rough(0.0F, 0.7F);
    film.base_color.w = 0.3F;
    film.alpha_mode = AlphaMode::blend;
    Material coated = rough(0.0F, 0.6F);
    coated.clearcoat = 1.0F;
    coated.clearcoat_roughness = 0.05F;
    return {{{"matt", rough(0.0F, 1.0F)},
             {"polished", rough(0.0F, 0.05F)},
             {"rough metal", rough(1.0F, 0.9F)},
             {"glossy metal", rough(1.0F, 0.25F)},
             {"mirror", rough(1.0F, 0.0F)},
             {"glass", glass},
             {"bubble", pane},
             {"film", film},
             {"coated", coated}}};
}

TEST(EnvironmentLight, WhiteBallsVanishInAWhiteWorld) {
    const auto materials = white_materials();
    Scene scene;
    surround(scene, constant_map(0.5F), 2.0F);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const std::size_t row = i / 3;
        const vec3 place(static_cast<float>(i % 3) - 1.0F, static_cast<float>(row) - 1.0F, -2.0F);
        test::add(scene, make_sphere(0.45F), materials[i].material, glm::translate(glm::mat4(1.0F), place));
    }
    for (const float bound : {0.0F, 0.02F}) {
        TracerOptions options;
        options.bounce_bound = bound;
        const test::Traced traced = test::trace(scene, test::square_view(2 * kSize), options);
        std::array<int, 10> seen{};
        for (int y = 0; y < 2 * kSize; ++y) {
            for (int x = 0; x < 2 * kSize; ++x) {
                const std::uint32_t object = traced.object(x, y);
                ++seen[object];
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(traced.radiance(x, y)[c], 1.0F, 3e-3F)
                        << x << ", " << y << ", " << (object == 0 ? "no ball" : materials[object - 1].name);
            }
        }
        for (const int pixels : seen) EXPECT_GT(pixels, 200);
    }
}

}  // namespace
}  // namespace macula
