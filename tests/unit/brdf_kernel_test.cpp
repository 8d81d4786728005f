// The reflectance of surfaces without layers against what physics and its sources demand: energy, normalisation,
// limits.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "server/kernels/glossy.h"
#include "tests/support/hemisphere.h"

namespace macula {
namespace {

using glm::vec3;
using test::direction_at;
using test::integrate_over_lights;

const vec3 kUp(0.0F, 0.0F, 1.0F);

/// Share of uniform light that a surface sends to a view.
vec3 albedo(const kernels::Surface& surface, const vec3& view) {
    vec3 result;
    for (int c = 0; c < 3; ++c)
        result[c] = static_cast<float>(integrate_over_lights(
            view, [&](const vec3& light) { return kernels::reflect_light(surface, kUp, view, light)[c]; }));
    return result;
}

float white_albedo(float metallic, float roughness, double cosine) {
    const vec3 view = direction_at(cosine);
    const kernels::Surface surface = kernels::make_surface(vec3(1.0F), metallic, roughness, view.z);
    return static_cast<float>(integrate_over_lights(
        view, [&](const vec3& light) { return kernels::reflect_light(surface, kUp, view, light).x; }));
}

TEST(BrdfKernel, ReflectancesOfGltf) {
    const kernels::Surface dielectric = kernels::make_surface(vec3(0.5F, 0.2F, 0.1F), 0.0F, 0.5F, 1.0F);
    EXPECT_EQ(dielectric.f0, vec3(0.04F));
    EXPECT_EQ(dielectric.f90, 1.0F);
    EXPECT_FLOAT_EQ(dielectric.curves.alpha, 0.25F);
    const kernels::Surface metal = kernels::make_surface(vec3(0.5F, 0.2F, 0.1F), 1.0F, 0.5F, 1.0F);
    EXPECT_EQ(metal.base, vec3(0.0F));
    EXPECT_EQ(metal.f0, vec3(0.5F, 0.2F, 0.1F));
}

TEST(BrdfKernel, DistributionIsNormalised) {
    for (const float alpha : {0.002F, 0.04F, 0.2F, 0.6F, 1.0F}) {
        const double total = integrate_over_lights(
            kUp, [&](const vec3& h) { return kernels::ggx_distribution(h.z, h.x * h.x + h.y * h.y, alpha) * h.z; });
        EXPECT_NEAR(total, 1.0, 0.001) << "alpha " << alpha;
    }
}

TEST(BrdfKernel, SmithVisibilityIsTheReciprocalOfFourCosinesForASmoothSurface) {
    for (const float l : {0.2F, 0.7F}) {
        for (const float v : {0.3F, 1.0F})
            EXPECT_NEAR(kernels::smith_visibility(l, v, 1e-4F) * 4.0F * l * v, 1.0F, 1e-4F);
    }
}

// The table of the GGX lobe's albedo that its fits stand for, integrated here by a rule of its own.
TEST(BrdfKernel, AlbedoCurvesAreThoseOfTheLobe) {
    double worst_loss = 0.0;
    double worst_grazing = 0.0;
    for (const float roughness : {0.045F, 0.08F, 0.12F, 0.2F, 0.33F, 0.47F, 0.61F, 0.78F, 0.9F, 1.0F}) {
        const kernels::AlbedoCurves curves = kernels::make_albedo_curves(roughness);
        for (const double cosine : {0.02, 0.035, 0.06, 0.13, 0.25, 0.42, 0.66, 0.85, 1.0}) {
            const vec3 view = direction_at(cosine);
            const auto integral = [&](bool weighted) {
                return integrate_over_lights(view, [&](const vec3& light) {
                    const kernels::Bounce b = kernels::bounce_angles(kUp, view, light);
                    const float weight = weighted ? kernels::schlick_weight(b.v_dot_h) : 1.0F;
                    return weight * kernels::ggx_lobe(b, curves.alpha) * b.n_dot_l;
                });
            };
            const kernels::Albedos fit = kernels::albedos_at(curves, view.z);
            worst_loss = std::max(worst_loss, std::abs(1.0 - integral(false) - static_cast<double>(fit.loss)));
            worst_grazing = std::max(worst_grazing, std::abs(integral(true) - static_cast<double>(fit.grazing)));
            EXPECT_GE(fit.loss, 0.0F);
            EXPECT_GE(fit.grazing, 0.0F);
        }
    }
    EXPECT_LT(worst_loss, 0.0045);
    EXPECT_LT(worst_grazing, 0.0045);
    RecordProperty("worst_loss", std::to_string(worst_loss));
}

TEST(BrdfKernel, MeansOfTheAlbedoCurvesAreTheirIntegrals) {
    for (const float roughness : {0.045F, 0.1F, 0.2F, 0.5F, 0.8F, 1.0F}) {
        const kernels::AlbedoCurves curves = kernels::make_albedo_curves(roughness);
        double loss = 0.0;
        double grazing = 0.0;
        double largest = 0.0;
        constexpr int kSteps = 4000;
        for (int i = 0; i < kSteps; ++i) {
            const double s = (i + 0.5) / kSteps;
            const kernels::Albedos a = kernels::albedos_at(curves, static_cast<float>(s * s));
            loss += static_cast<double>(a.loss) * 2.0 * s * s * 2.0 * s / kSteps;
            grazing += static_cast<double>(a.grazing) * 2.0 * s * s * 2.0 * s / kSteps;
            largest = std::max(largest, static_cast<double>(a.loss));
        }
        const kernels::Albedos mean = kernels::mean_albedos(roughness);
        EXPECT_LT(std::abs(loss / static_cast<double>(mean.loss) - 1.0) * largest, 0.005) << "roughness " << roughness;
        EXPECT_NEAR(grazing, static_cast<double>(mean.grazing), 0.0006) << "roughness " << roughness;
    }
}

TEST(BrdfKernel, WhiteSurfacesReflectAllLight) {
    float least = 2.0F;
    float most = 0.0F;
    for (const float metallic : {0.0F, 0.5F, 1.0F}) {
        for (const float roughness : {0.0F, 0.045F, 0.08F, 0.12F, 0.2F, 0.3F, 0.45F, 0.6F, 0.75F, 0.9F, 1.0F}) {
            for (const double cosine : {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0}) {
                const float a = white_albedo(metallic, roughness, cosine);
                EXPECT_NEAR(a, 1.0F, 0.01F)
                    << "metallic " << metallic << " roughness " << roughness << " n.v " << cosine;
                least = std::min(least, a);
                most = std::max(most, a);
            }
        }
    }
    std::printf("white furnace: %.4f to %.4f\n", static_cast<double>(least), static_cast<double>(most));
}

// Closer to the horizon the fits' error grows, as microfacet.h says.
TEST(BrdfKernel, GrazingViewsOfWhiteSurfacesStayNearOne) {
    for (const float metallic : {0.0F, 1.0F}) {
        for (const float roughness : {0.1F, 0.3F, 0.6F, 1.0F}) {
            for (const double cosine : {0.003, 0.01})
                EXPECT_NEAR(white_albedo(metallic, roughness, cosine), 1.0F, 0.025F)
                    << "metallic " << metallic << " roughness " << roughness << " n.v " << cosine;
        }
    }
}

TEST(BrdfKernel, UniformLightIsWhatTheIntegralSays) {
    for (const float metallic : {0.0F, 0.4F, 1.0F}) {
        for (const float roughness : {0.1F, 0.5F, 1.0F}) {
            for (const double cosine : {0.1, 0.5, 1.0}) {
                const vec3 view = direction_at(cosine);
                const auto surface = kernels::make_surface(vec3(0.9F, 0.4F, 0.05F), metallic, roughness, view.z);
                const vec3 integral = albedo(surface, view);
                const vec3 shortcut = kernels::reflect_uniform_light(surface);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(shortcut[c], integral[c], 0.006F);
            }
        }
    }
}

TEST(BrdfKernel, UniformLightOfWhiteSurfacesIsExact) {
    for (const float metallic : {0.0F, 0.3F, 1.0F}) {
        for (const float cosine : {0.05F, 0.4F, 1.0F}) {
            const vec3 share =
                kernels::reflect_uniform_light(kernels::make_surface(vec3(1.0F), metallic, 0.5F, cosine));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], 1.0F, 1e-5F);
        }
    }
}

// Without the light between microfacets, rough metal would be dark: Kulla and Conty 2017 show a loss of more than half.
TEST(BrdfKernel, SingleScatteringAloneLosesMost) {
    const double single = integrate_over_lights(kUp, [&](const vec3& light) {
        const kernels::Bounce b = kernels::bounce_angles(kUp, kUp, light);
        return kernels::ggx_lobe(b, 1.0F) * b.n_dot_l;
    });
    EXPECT_NEAR(single, 0.307, 0.002);
}

TEST(BrdfKernel, ColouredMetalIsMoreSaturatedByMultipleBounces) {
    const vec3 color(0.9F, 0.6F, 0.3F);
    const auto surface = kernels::make_surface(color, 1.0F, 1.0F, 1.0F);
    const vec3 a = kernels::reflect_uniform_light(surface);
    EXPECT_LT(a.z / a.x, color.z / color.x);
    EXPECT_LT(a.x, color.x);
}

TEST(BrdfKernel, IsTheMixOfMetalAndDielectric) {
    const vec3 view = direction_at(0.6);
    const vec3 light = direction_at(0.7, 2.0);
    const auto reflect = [&](float metallic) {
        return kernels::reflect_light(kernels::make_surface(vec3(0.7F, 0.4F, 0.2F), metallic, 0.4F, view.z), kUp, view,
                                      light);
    };
    const vec3 mixed = glm::mix(reflect(0.0F), reflect(1.0F), 0.3F);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(reflect(0.3F)[c], mixed[c], 1e-6F);
}

// Ashikhmin and Shirley's dielectric base, an approximation of the same coupling for smooth dielectrics.
TEST(BrdfKernel, BaseReflectsWhatTheLobesLetThrough) {
    for (const double cosine : {1.0, 0.6, 0.2}) {
        const vec3 view = direction_at(cosine);
        const auto white = kernels::make_surface(vec3(1.0F), 0.0F, 0.045F, view.z);
        const auto black = kernels::make_surface(vec3(0.0F), 0.0F, 0.045F, view.z);
        const double base = integrate_over_lights(view, [&](const vec3& light) {
            return kernels::reflect_light(white, kUp, view, light).x -
                   kernels::reflect_light(black, kUp, view, light).x;
        });
        const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
        EXPECT_NEAR(base, 1.0 - fresnel, 0.005) << "n.v " << cosine;
    }
}

TEST(BrdfKernel, TransmissionTakesFromTheBaseAlone) {
    const auto opaque = kernels::make_surface(vec3(0.8F), 0.0F, 0.4F, vec3(0.04F), 1.0F, 1.0F, 0.7F);
    const auto glass = kernels::make_surface(vec3(0.8F), 0.0F, 0.4F, vec3(0.04F), 1.0F, 0.25F, 0.7F);
    EXPECT_NEAR(glass.base.x, 0.25F * opaque.base.x, 1e-7F);
    EXPECT_EQ(glass.specular_albedo, opaque.specular_albedo);
    EXPECT_EQ(glass.scatter, opaque.scatter);
}

TEST(BrdfKernel, NothingComesFromBelow) {
    const kernels::Surface surface = kernels::make_surface(vec3(1.0F), 0.5F, 0.5F, 1.0F);
    EXPECT_EQ(kernels::reflect_light(surface, kUp, kUp, vec3(0.0F, 0.6F, -0.8F)), vec3(0.0F));
    // Opposite directions have no half vector; the result is still a number.
    EXPECT_EQ(kernels::reflect_light(surface, kUp, kUp, -kUp), vec3(0.0F));
}

TEST(GlossyKernel, MirrorDirectionReflects) {
    const vec3 view = direction_at(0.6);
    const vec3 mirrored = kernels::mirror_direction(view, kUp);
    EXPECT_NEAR(glm::length(mirrored - vec3(-view.x, 0.0F, view.z)), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::length(kernels::dominant_direction(kUp, mirrored, 0.0F) - mirrored), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::length(kernels::dominant_direction(kUp, mirrored, 1.0F) - kUp), 0.0F, 1e-6F);
}

// The share of a GGX distribution within the cone's half of an angle, integrated.
TEST(GlossyKernel, ConeHoldsHalfOfTheNormals) {
    for (const float alpha : {0.01F, 0.1F, 0.4F, 0.7F}) {
        const double half_angle = 0.5 * std::atan(static_cast<double>(kernels::lobe_half_width_tan(alpha)));
        const double within = integrate_over_lights(
            kUp,
            [&](const vec3& h) {
                const bool inside = std::acos(std::min(1.0, static_cast<double>(h.z))) < half_angle;
                return inside ? kernels::ggx_distribution(h.z, h.x * h.x + h.y * h.y, alpha) * h.z : 0.0F;
            },
            2000, 8);
        EXPECT_NEAR(within, 0.5, 0.01) << "alpha " << alpha;
    }
    EXPECT_EQ(kernels::lobe_half_width_tan(1.0F), 8.0F);
}

}  // namespace
}  // namespace macula
