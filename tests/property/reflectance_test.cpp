// What holds for any material, view and light: reciprocity, no negative radiance, no more light out than in.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "server/kernels/layers.h"
#include "tests/support/hemisphere.h"

namespace macula {
namespace {

using glm::vec3;
using test::direction_at;

constexpr std::uint32_t kSeed = 20;
const vec3 kUp(0.0F, 0.0F, 1.0F);

struct AnyMaterial {
    vec3 base_color;
    float metallic;
    float roughness;
    vec3 f0;
    float f90;
    float opacity;
    bool layered;
    float coat;
    float coat_roughness;
    vec3 sheen_color;
    float sheen_roughness;

    explicit AnyMaterial(std::mt19937& random) {
        std::uniform_real_distribution<float> unit(0.0F, 1.0F);
        // Extremes are as frequent as what lies between.
        const auto pick = [&] {
            const float u = 2.0F * unit(random) - 0.5F;
            return std::clamp(u, 0.0F, 1.0F);
        };
        base_color = vec3(pick(), pick(), pick());
        metallic = pick();
        roughness = pick();
        const float specular = pick();
        const vec3 specular_color(pick(), pick(), pick());
        const float ior = 1.1F + 1.3F * unit(random);
        f0 = glm::min(specular_color * kernels::fresnel_f0(ior), vec3(1.0F)) * specular;
        f90 = specular;
        opacity = pick();
        layered = unit(random) < 0.5F;
        coat = pick();
        coat_roughness = pick();
        sheen_color = vec3(pick(), pick(), pick());
        sheen_roughness = pick();
    }

    /// Reflectance distribution times n.l.
    [[nodiscard]] vec3 reflect(const vec3& view, const vec3& light) const {
        const auto surface = kernels::make_surface(base_color, metallic, roughness, f0, f90, opacity, view.z);
        if (!layered) return kernels::reflect_light(surface, kUp, view, light);
        const auto layers =
            kernels::make_layers(surface, view.z, coat, coat_roughness, view.z, sheen_color, sheen_roughness);
        return kernels::reflect_light(surface, layers, kUp, kUp, view, light);
    }
};

TEST(Reflectance, LightAndViewAreInterchangeable) {
    std::mt19937 random(kSeed);
    std::printf("seed %u\n", kSeed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 20000; ++i) {
        const AnyMaterial material(random);
        const vec3 a = direction_at(0.005 + 0.995 * unit(random), 6.28 * unit(random));
        const vec3 b = direction_at(0.005 + 0.995 * unit(random), 6.28 * unit(random));
        const vec3 ab = material.reflect(a, b) / b.z;
        const vec3 ba = material.reflect(b, a) / a.z;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(ab[c], ba[c], 1e-3F * std::abs(ab[c]) + 1e-5F) << "material " << i << " of seed " << kSeed;
    }
}

TEST(Reflectance, IsNeverNegativeAndAlwaysANumber) {
    std::mt19937 random(kSeed + 1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 20000; ++i) {
        const AnyMaterial material(random);
        // Also from just above the horizon, and from behind.
        const vec3 view = direction_at(std::pow(unit(random), 4.0), 6.28 * unit(random));
        const vec3 light = direction_at(std::pow(unit(random), 4.0) * (unit(random) < 0.1 ? -1.0 : 1.0), 6.28);
        const vec3 radiance = material.reflect(view, light);
        for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(radiance[c])) << "material " << i << " of seed " << kSeed + 1;
            ASSERT_GE(radiance[c], 0.0F) << "material " << i << " of seed " << kSeed + 1;
        }
    }
}

TEST(Reflectance, NeverSendsBackMoreThanArrives) {
    std::mt19937 random(kSeed + 2);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double most = 0.0;
    for (int i = 0; i < 300; ++i) {
        const AnyMaterial material(random);
        const vec3 view = direction_at(0.02 + 0.98 * unit(random));
        for (int c = 0; c < 3; ++c) {
            const double albedo = test::integrate_over_lights(
                view, [&](const vec3& light) { return material.reflect(view, light)[c]; }, 120, 60);
            ASSERT_LT(albedo, 1.01) << "material " << i << " of seed " << kSeed + 2;
            most = std::max(most, albedo);
        }
    }
    std::printf("seed %u: largest albedo %.4f\n", kSeed + 2, most);
    EXPECT_GT(most, 0.9);
}

// KHR_materials_ior over its range: a white dielectric of any index, with and without specular, loses nothing.
TEST(Reflectance, WhiteDielectricsOfAnyIndexLoseNothing) {
    for (const float ior : {1.0F, 1.1F, 1.33F, 1.5F, 1.9F, 2.4F}) {
        for (const float specular : {0.0F, 0.5F, 1.0F}) {
            for (const float roughness : {0.1F, 0.4F, 1.0F}) {
                for (const double cosine : {0.03, 0.2, 0.6, 1.0}) {
                    const vec3 view = direction_at(cosine);
                    const auto surface = kernels::make_surface(
                        vec3(1.0F), 0.0F, roughness, vec3(kernels::fresnel_f0(ior) * specular), specular, 1.0F, view.z);
                    const double albedo = test::integrate_over_lights(
                        view, [&](const vec3& light) { return kernels::reflect_light(surface, kUp, view, light).x; });
                    EXPECT_NEAR(albedo, 1.0, 0.01) << "ior " << ior << " roughness " << roughness << " n.v " << cosine;
                }
            }
        }
    }
}

}  // namespace
}  // namespace macula
