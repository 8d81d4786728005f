// The reflectance against what physics and its sources demand: reciprocity, energy, normalisation, limits.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "server/kernels/brdf.h"

namespace macula {
namespace {

using glm::vec3;
constexpr double kTau = 2.0 * std::numbers::pi;
const vec3 kUp(0.0F, 0.0F, 1.0F);

vec3 direction(double cos_theta, double phi) {
    const double sin_theta = std::sqrt(std::max(0.0, 1.0 - cos_theta * cos_theta));
    return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

/// Integral over the hemisphere of f(light), which holds the cosine, by the midpoint rule. Theta is spaced by its
/// square root's square so that the neighbourhood of the pole is dense.
template <class F>
double hemisphere(F&& f, int steps = 400) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double s = (i + 0.5) / steps;
        const double theta = s * s * std::numbers::pi / 2.0;
        const double d_theta = 2.0 * s / steps * std::numbers::pi / 2.0;
        for (int j = 0; j < steps; ++j)
            sum += f(direction(std::cos(theta), kTau * (j + 0.5) / steps)) * std::sin(theta) * d_theta * kTau / steps;
    }
    return sum;
}

TEST(BrdfKernel, RoughDielectricIsNearlyLambert) {
    const kernels::Reflectance white = kernels::make_reflectance(vec3(1.0F), 0.0F, 1.0F);
    const vec3 light = direction(0.5, 1.0);
    const vec3 reflected = kernels::reflect_light(white, kUp, kUp, light);
    // 96 % into the base at most; the specular layer adds about as much.
    EXPECT_NEAR(reflected.x, 0.5 / std::numbers::pi, 0.02);
}

TEST(BrdfKernel, ReflectanceOfGltf) {
    const kernels::Reflectance dielectric = kernels::make_reflectance(vec3(0.5F, 0.2F, 0.1F), 0.0F, 0.5F);
    EXPECT_EQ(dielectric.diffuse, vec3(0.5F, 0.2F, 0.1F));
    EXPECT_EQ(dielectric.f0, vec3(0.04F));
    EXPECT_FLOAT_EQ(dielectric.alpha, 0.25F);
    const kernels::Reflectance metal = kernels::make_reflectance(vec3(0.5F, 0.2F, 0.1F), 1.0F, 0.5F);
    EXPECT_EQ(metal.diffuse, vec3(0.0F));
    EXPECT_EQ(metal.f0, vec3(0.5F, 0.2F, 0.1F));
}

TEST(BrdfKernel, DistributionIsNormalised) {
    for (const float alpha : {0.04F, 0.2F, 0.6F, 1.0F}) {
        const double total = hemisphere([&](const vec3& h) {
            return static_cast<double>(kernels::ggx_distribution(h.z, h.x * h.x + h.y * h.y, alpha) * h.z);
        });
        EXPECT_NEAR(total, 1.0, 0.01) << "alpha " << alpha;
    }
}

TEST(BrdfKernel, FresnelRisesFromNormalIncidenceToOne) {
    EXPECT_FLOAT_EQ(kernels::schlick_fresnel(vec3(0.04F), 1.0F).x, 0.04F);
    EXPECT_FLOAT_EQ(kernels::schlick_fresnel(vec3(0.04F), 0.0F).x, 1.0F);
    EXPECT_NEAR(kernels::schlick_fresnel(vec3(0.04F), 0.5F).x, 0.04 + 0.96 / 32.0, 1e-6);
}

TEST(BrdfKernel, SmithVisibilityIsTheReciprocalOfFourCosinesForASmoothSurface) {
    for (const float l : {0.2F, 0.7F}) {
        for (const float v : {0.3F, 1.0F})
            EXPECT_NEAR(kernels::smith_visibility(l, v, 1e-4F) * 4.0F * l * v, 1.0F, 1e-4F);
    }
}

TEST(BrdfKernel, LightAndViewAreInterchangeable) {
    for (const float roughness : {0.1F, 0.5F, 1.0F}) {
        const kernels::Reflectance surface = kernels::make_reflectance(vec3(0.8F, 0.5F, 0.3F), 0.4F, roughness);
        const vec3 a = direction(0.8, 0.3);
        const vec3 b = direction(0.35, 2.5);
        const vec3 ab = kernels::reflect_light(surface, kUp, a, b) / b.z;
        const vec3 ba = kernels::reflect_light(surface, kUp, b, a) / a.z;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(ab[c], ba[c], 1e-4F * ab[c]) << "roughness " << roughness;
    }
}

TEST(BrdfKernel, NeverReflectsMoreThanItReceives) {
    for (const float metallic : {0.0F, 0.5F, 1.0F}) {
        for (const float roughness : {0.25F, 0.5F, 1.0F}) {
            const kernels::Reflectance white = kernels::make_reflectance(vec3(1.0F), metallic, roughness);
            for (const double cos_view : {1.0, 0.7, 0.3}) {
                const vec3 view = direction(cos_view, 0.0);
                const double albedo = hemisphere([&](const vec3& light) {
                    return static_cast<double>(kernels::reflect_light(white, kUp, view, light).x);
                });
                EXPECT_LE(albedo, 1.01) << "metallic " << metallic << " roughness " << roughness << " cos " << cos_view;
                // Single scattering loses most in rough metal; no white surface looks grey.
                EXPECT_GT(albedo, 0.3);
            }
        }
    }
}

TEST(BrdfKernel, IsTheMixOfMetalAndDielectric) {
    const vec3 view = direction(0.6, 0.0);
    const vec3 light = direction(0.7, 2.0);
    const auto reflect = [&](float metallic) {
        return kernels::reflect_light(kernels::make_reflectance(vec3(0.7F, 0.4F, 0.2F), metallic, 0.4F), kUp, view,
                                      light);
    };
    const vec3 mixed = glm::mix(reflect(0.0F), reflect(1.0F), 0.3F);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(reflect(0.3F)[c], mixed[c], 1e-6F);
}

TEST(BrdfKernel, BaseReflectsWhatTheLayerLetsThrough) {
    for (const double cos_view : {1.0, 0.6, 0.2}) {
        const double albedo = hemisphere([&](const vec3& light) {
            return static_cast<double>(kernels::layered_base(light.z, static_cast<float>(cos_view)) * light.z);
        });
        EXPECT_NEAR(albedo, 1.0 - kernels::schlick_fresnel(vec3(0.04F), static_cast<float>(cos_view)).x, 1e-3);
    }
}

TEST(BrdfKernel, SmoothWhiteMetalReflectsEverything) {
    const kernels::Reflectance mirror = kernels::make_reflectance(vec3(1.0F), 1.0F, 0.25F);
    const double albedo = hemisphere(
        [&](const vec3& light) { return static_cast<double>(kernels::reflect_light(mirror, kUp, kUp, light).x); });
    EXPECT_NEAR(albedo, 1.0, 0.01);
}

TEST(BrdfKernel, NothingComesFromBelow) {
    const kernels::Reflectance surface = kernels::make_reflectance(vec3(1.0F), 0.5F, 0.5F);
    EXPECT_EQ(kernels::reflect_light(surface, kUp, kUp, vec3(0.0F, 0.6F, -0.8F)), vec3(0.0F));
    // Opposite directions have no half vector; the result is still a number.
    EXPECT_EQ(kernels::reflect_light(surface, kUp, kUp, -kUp), vec3(0.0F));
}

TEST(BrdfKernel, WhiteSurfacesReflectAllUniformLight) {
    for (const float metallic : {0.0F, 0.3F, 1.0F}) {
        const vec3 share = kernels::reflect_uniform_light(kernels::make_reflectance(vec3(1.0F), metallic, 0.5F));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], 1.0F, 1e-6F);
    }
    const vec3 black = kernels::reflect_uniform_light(kernels::make_reflectance(vec3(0.0F), 0.0F, 0.5F));
    EXPECT_NEAR(black.x, 0.04F, 1e-6F);
}

}  // namespace
}  // namespace macula
