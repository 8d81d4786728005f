// Coat and sheen over surfaces: energy, limits, and the sheen lobe against its own integral.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "server/kernels/layers.h"
#include "tests/support/hemisphere.h"

namespace macula {
namespace {

using glm::vec3;
using test::direction_at;
using test::integrate_over_lights;

const vec3 kUp(0.0F, 0.0F, 1.0F);

/// A surface of which everything that is not named is white.
struct Stack {
    float metallic = 0.0F;
    float roughness = 0.5F;
    float coat = 0.0F;
    float coat_roughness = 0.0F;
    float sheen = 0.0F;
    float sheen_roughness = 0.5F;
};

double furnace(const Stack& stack, double cosine) {
    const vec3 view = direction_at(cosine);
    const auto surface = kernels::make_surface(vec3(1.0F), stack.metallic, stack.roughness, view.z);
    const auto layers = kernels::make_layers(surface, view.z, stack.coat, stack.coat_roughness, view.z,
                                             vec3(stack.sheen), stack.sheen_roughness);
    return integrate_over_lights(
        view, [&](const vec3& light) { return kernels::reflect_light(surface, layers, kUp, kUp, view, light).x; });
}

/// Least and largest albedo over views, and over roughnesses of the surface.
struct Range {
    double least = 2.0;
    double most = 0.0;
};

Range furnace(Stack stack) {
    Range range;
    for (const float roughness : {0.05F, 0.15F, 0.3F, 0.5F, 0.75F, 1.0F}) {
        stack.roughness = roughness;
        for (const double cosine : {0.02, 0.08, 0.2, 0.4, 0.7, 1.0}) {
            const double a = furnace(stack, cosine);
            range.least = std::min(range.least, a);
            range.most = std::max(range.most, a);
        }
    }
    return range;
}

TEST(LayersKernel, CoatOverWhiteLosesNothing) {
    for (const float metallic : {0.0F, 1.0F}) {
        for (const float coat_roughness : {0.0F, 0.2F, 0.5F, 1.0F}) {
            const Range a = furnace({metallic, 0.0F, 1.0F, coat_roughness});
            std::printf("coat of roughness %.1f over metallic %.0f: %.4f to %.4f\n",
                        static_cast<double>(coat_roughness), static_cast<double>(metallic), a.least, a.most);
            EXPECT_GT(a.least, 0.99);
            // 1.014 is reached where a coat of roughness .2 lies on metal of roughness .15, seen at n.v = .08.
            EXPECT_LT(a.most, metallic > 0.0F ? 1.015 : 1.01);
        }
    }
}

TEST(LayersKernel, SheenOverWhiteLosesNothing) {
    for (const float sheen_roughness : {0.0F, 0.15F, 0.3F, 0.6F, 1.0F}) {
        const Range a = furnace({0.0F, 0.0F, 0.0F, 0.0F, 1.0F, sheen_roughness});
        std::printf("sheen of roughness %.2f: %.4f to %.4f\n", static_cast<double>(sheen_roughness), a.least, a.most);
        EXPECT_GT(a.least, sheen_roughness == 0.15F ? 0.98 : 0.985);
        EXPECT_LT(a.most, 1.01);
    }
}

// Cloth is not metal; what white metal under white sheen loses is bounded all the same.
TEST(LayersKernel, SheenOverMetalLosesLittle) {
    for (const float sheen_roughness : {0.2F, 0.5F, 1.0F}) {
        const Range a = furnace({1.0F, 0.0F, 0.0F, 0.0F, 1.0F, sheen_roughness});
        std::printf("sheen of roughness %.2f over metal: %.4f to %.4f\n", static_cast<double>(sheen_roughness), a.least,
                    a.most);
        EXPECT_GT(a.least, 0.97);
        EXPECT_LT(a.most, 1.015);
    }
}

TEST(LayersKernel, CoatOverSheenLosesLittle) {
    for (const float sheen_roughness : {0.2F, 0.5F, 1.0F}) {
        const Range a = furnace({0.0F, 0.0F, 1.0F, 0.1F, 1.0F, sheen_roughness});
        std::printf("coat over sheen of roughness %.2f: %.4f to %.4f\n", static_cast<double>(sheen_roughness), a.least,
                    a.most);
        EXPECT_GT(a.least, 0.975);
        EXPECT_LT(a.most, 1.02);
    }
}

TEST(LayersKernel, LayersOfStrengthZeroChangeNothing) {
    for (const float metallic : {0.0F, 1.0F}) {
        const vec3 view = direction_at(0.4);
        const vec3 light = direction_at(0.8, 2.0);
        const auto surface = kernels::make_surface(vec3(0.8F, 0.5F, 0.2F), metallic, 0.4F, view.z);
        const auto layers = kernels::make_layers(surface, view.z, 0.0F, 0.3F, view.z, vec3(0.0F), 0.4F);
        const vec3 with = kernels::reflect_light(surface, layers, kUp, kUp, view, light);
        const vec3 without = kernels::reflect_light(surface, kUp, view, light);
        // The mean under layers is integrated by five nodes, that without is a fit.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(with[c], without[c], 2e-3F * without[c]);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(layers.albedo[c], kernels::reflect_uniform_light(surface)[c], 1e-5F);
    }
}

TEST(LayersKernel, CoatReflectsAsADielectricOnBlack) {
    for (const double cosine : {0.3, 0.6, 1.0}) {
        const vec3 view = direction_at(cosine);
        const auto black = kernels::make_surface(vec3(0.0F), 1.0F, 0.5F, view.z);  // metal, so that there is no base
        const auto layers = kernels::make_layers(black, view.z, 1.0F, 0.045F, view.z, vec3(0.0F), 0.5F);
        const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
        const double coat = integrate_over_lights(
            view, [&](const vec3& light) { return kernels::reflect_light(black, layers, kUp, kUp, view, light).y; });
        // Black metal reflects at grazing angles, too: f90 is 1.
        const double under = static_cast<double>(kernels::reflect_uniform_light(black).y) * (1.0 - fresnel);
        EXPECT_NEAR(coat, fresnel + under, 0.008) << "n.v " << cosine;
    }
}

TEST(LayersKernel, CoatHasItsOwnNormal) {
    const vec3 view = direction_at(1.0);
    const vec3 coat_normal = direction_at(std::cos(0.3));
    const auto black = kernels::make_surface(vec3(0.0F), 0.0F, 1.0F, view.z);
    const auto layers = kernels::make_layers(black, view.z, 1.0F, 0.1F, glm::dot(coat_normal, view), vec3(0.0F), 0.5F);
    const auto at = [&](double angle) {
        return kernels::reflect_light(black, layers, kUp, coat_normal, view, direction_at(std::cos(angle))).x;
    };
    EXPECT_GT(at(0.6), 20.0F * at(0.3));
    EXPECT_GT(at(0.6), 20.0F * at(0.9));
}

TEST(SheenKernel, AlbedoIsThatOfTheLobe) {
    double worst = 0.0;
    for (const float roughness : {0.07F, 0.11F, 0.17F, 0.25F, 0.37F, 0.52F, 0.7F, 0.88F, 1.0F}) {
        const kernels::Sheen sheen = kernels::make_sheen(roughness);
        for (const double cosine : {0.02, 0.06, 0.15, 0.3, 0.55, 0.8, 1.0}) {
            const vec3 view = direction_at(cosine);
            const float masking = kernels::sheen_masking(sheen, view.z);
            const double integral = integrate_over_lights(view, [&](const vec3& light) {
                const vec3 h = glm::normalize(light + view);
                return kernels::reflect_sheen(sheen, light.z, view.z, h.x * h.x + h.y * h.y, masking) * light.z;
            });
            worst = std::max(worst, std::abs(integral - static_cast<double>(kernels::sheen_albedo(sheen, view.z))));
            EXPECT_LT(integral, 1.0);
        }
    }
    std::printf("sheen albedo: worst error %.4f\n", worst);
    EXPECT_LT(worst, 0.0065);
}

// The published distribution and masking, evaluated here in double with the library's powers.
TEST(SheenKernel, LobeIsTheOneOfThePaper) {
    const auto masking = [](double x, double alpha) {
        const double t = (1.0 - alpha) * (1.0 - alpha);
        const auto mix = [t](double rough, double smooth) { return rough + (smooth - rough) * t; };
        const auto l = [&](double at) {
            return mix(21.5473, 25.3245) / (1.0 + mix(3.82987, 3.32435) * std::pow(at, mix(0.19823, 0.16801))) +
                   mix(-1.97760, -1.27393) * at + mix(-4.32054, -4.85967);
        };
        return x < 0.5 ? std::exp(l(x)) : std::exp(2.0 * l(0.5) - l(1.0 - x));
    };
    for (const float roughness : {0.3F, 0.6F, 1.0F}) {
        const kernels::Sheen sheen = kernels::make_sheen(roughness);
        const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
        for (const double v : {0.1, 0.45, 0.9}) {
            for (const double l : {0.2, 0.8}) {
                const vec3 view = direction_at(v);
                const vec3 light = direction_at(l, 2.0);
                const vec3 h = glm::normalize(view + light);
                const double sine = std::hypot(static_cast<double>(h.x), static_cast<double>(h.y));
                const double d = (2.0 + 1.0 / alpha) * std::pow(sine, 1.0 / alpha) / (2.0 * std::numbers::pi);
                const double expected = d / (1.0 + masking(v, alpha) + masking(l, alpha)) / (4.0 * v * l);
                const float actual = kernels::reflect_sheen(sheen, light.z, view.z, h.x * h.x + h.y * h.y,
                                                            kernels::sheen_masking(sheen, view.z));
                EXPECT_NEAR(static_cast<double>(actual), expected, 1e-4 * expected);
            }
        }
    }
}

TEST(PowersKernel, AreAsExactAsStated) {
    double worst_log = 0.0;
    double worst_exp = 0.0;
    for (int i = 1; i < 200000; ++i) {
        const float x =
            std::exp2(static_cast<float>(i % 1000) * 0.04F - 30.0F) * (1.0F + static_cast<float>(i) * 5e-6F);
        const double exact = std::log2(static_cast<double>(x));
        if (x != 1.0F)
            worst_log = std::max(worst_log, std::abs(static_cast<double>(kernels::log2_near(x)) - exact) /
                                                std::max(std::abs(exact), 1e-3));
        const float y = static_cast<float>(i) * 1.2e-3F - 120.0F;
        worst_exp = std::max(
            worst_exp, std::abs(static_cast<double>(kernels::exp2_near(y)) / std::exp2(static_cast<double>(y)) - 1.0));
    }
    EXPECT_LT(worst_log, 3e-6);
    EXPECT_LT(worst_exp, 3e-7);
    EXPECT_EQ(kernels::log2_near(1.0F), 0.0F);
    EXPECT_NEAR(kernels::pow_near(0.3F, 2.5F), std::pow(0.3F, 2.5F), 1e-6F);
    EXPECT_NEAR(kernels::exp_near(-2.0F), std::exp(-2.0F), 1e-6F);
}

}  // namespace
}  // namespace macula
