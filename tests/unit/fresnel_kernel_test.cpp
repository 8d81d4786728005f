// Interfaces against Fresnel's equations in double, published values, Snell's law and series that are summed here.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "server/kernels/fresnel.h"

namespace macula {
namespace {

using glm::vec3;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Reflectances across (s) and along (p) the plane of incidence, by sines and tangents of the angles (Fresnel 1823).
struct Polarised {
    double s;
    double p;
};

Polarised fresnel_1823(double angle, double eta) {
    const double refracted = std::asin(std::sin(angle) / eta);
    if (angle < 1e-6) return {std::pow((eta - 1.0) / (eta + 1.0), 2.0), std::pow((eta - 1.0) / (eta + 1.0), 2.0)};
    return {std::pow(std::sin(angle - refracted) / std::sin(angle + refracted), 2.0),
            std::pow(std::tan(angle - refracted) / std::tan(angle + refracted), 2.0)};
}

double reflectance(double angle, double eta) {
    return static_cast<double>(
        kernels::fresnel_dielectric(static_cast<float>(std::cos(angle)), static_cast<float>(eta)));
}

TEST(FresnelKernel, AgreesWithFresnelForAllAngles) {
    for (const double eta : {1.1, 1.333, 1.5, 1.77, 2.4, 1.0 / 1.1, 1.0 / 1.5, 1.0 / 2.4}) {
        for (double degrees = 0.0; degrees < 89.6; degrees += 0.5) {
            const double angle = degrees * kDegree;
            if (std::sin(angle) / eta > 0.999) continue;  // near the critical angle the slope is infinite
            const Polarised exact = fresnel_1823(angle, eta);
            EXPECT_NEAR(reflectance(angle, eta), 0.5 * (exact.s + exact.p), 2e-5) << eta << " at " << degrees;
        }
    }
}

TEST(FresnelKernel, PublishedValues) {
    EXPECT_NEAR(reflectance(0.0, 1.5), 0.04, 1e-6);               // crown glass (Hecht, Optics, 4.6)
    EXPECT_NEAR(reflectance(60.0 * kDegree, 1.5), 0.0892, 5e-5);  //
    EXPECT_NEAR(reflectance(0.0, 1.333), 0.0204, 5e-5);           // water
    EXPECT_NEAR(reflectance(0.0, 2.417), 0.172, 5e-4);            // diamond
    EXPECT_NEAR(reflectance(90.0 * kDegree, 1.5), 1.0, 1e-5);
    // At Brewster's angle, 56.31 degrees, nothing is reflected along the plane of incidence, so that the mean is half
    // of what is reflected across it: ((n^2 - 1) / (n^2 + 1))^2 / 2.
    const double brewster = std::atan(1.5);
    EXPECT_NEAR(brewster / kDegree, 56.31, 0.005);
    EXPECT_NEAR(fresnel_1823(brewster, 1.5).p, 0.0, 1e-12);
    EXPECT_NEAR(reflectance(brewster, 1.5), 0.5 * std::pow(1.25 / 3.25, 2.0), 1e-6);
    EXPECT_NEAR(static_cast<double>(kernels::fresnel_f0(1.5F)), 0.04, 1e-7);
    EXPECT_NEAR(static_cast<double>(kernels::fresnel_f0(1.0F / 1.5F)), 0.04, 1e-7);
}

TEST(FresnelKernel, SchlickIsWithinItsKnownError) {
    double worst = 0.0;
    for (double degrees = 0.0; degrees < 90.0; degrees += 1.0) {
        const double angle = degrees * kDegree;
        const double schlick =
            static_cast<double>(kernels::schlick_fresnel(vec3(0.04F), static_cast<float>(std::cos(angle))).x);
        worst = std::max(worst, std::abs(schlick - reflectance(angle, 1.5)));
    }
    EXPECT_NEAR(worst, 0.0357, 0.0005);
    EXPECT_FLOAT_EQ(kernels::schlick_fresnel(vec3(0.04F), 1.0F).x, 0.04F);
    EXPECT_FLOAT_EQ(kernels::schlick_fresnel(vec3(0.04F), 0.0F).x, 1.0F);
}

TEST(RefractionKernel, FollowsSnell) {
    const vec3 normal = glm::normalize(vec3(0.2F, 0.9F, -0.3F));
    const vec3 along = glm::normalize(glm::cross(normal, vec3(1.0F, 0.0F, 0.0F)));
    for (const double eta : {1.1, 1.5, 2.4, 1.0 / 1.5}) {
        for (const double degrees : {0.0, 10.0, 30.0, 41.0, 60.0, 85.0}) {
            const double sine_behind = std::sin(degrees * kDegree) / eta;
            if (sine_behind >= 1.0) continue;
            const vec3 direction = along * static_cast<float>(std::sin(degrees * kDegree)) -
                                   normal * static_cast<float>(std::cos(degrees * kDegree));
            const auto bent = kernels::refract_ray(direction, normal, static_cast<float>(eta));
            EXPECT_NEAR(glm::length(bent.direction), 1.0F, 1e-6F);
            EXPECT_NEAR(static_cast<double>(glm::dot(bent.direction, along)), sine_behind, 2e-6);
            EXPECT_NEAR(static_cast<double>(glm::dot(bent.direction, normal)),
                        -std::sqrt(1.0 - sine_behind * sine_behind), 5e-6);
            EXPECT_NEAR(static_cast<double>(bent.reflectance), reflectance(degrees * kDegree, eta), 1e-5);
        }
    }
}

TEST(RefractionKernel, ReflectsTotallyBeyondTheCriticalAngle) {
    const vec3 normal(0.0F, 0.0F, 1.0F);
    const double critical = std::asin(1.0 / 1.5);
    EXPECT_NEAR(critical / kDegree, 41.81, 0.005);
    const auto at = [&](double angle) {
        return kernels::refract_ray(
            vec3(static_cast<float>(std::sin(angle)), 0.0F, static_cast<float>(-std::cos(angle))), normal, 1.0F / 1.5F);
    };
    EXPECT_LT(at(critical - 1e-3).reflectance, 1.0F);
    EXPECT_LT(at(critical - 1e-3).direction.z, 0.0F);
    for (const double beyond : {1e-3, 0.1, 0.6}) {
        const auto mirrored = at(critical + beyond);
        EXPECT_EQ(mirrored.reflectance, 1.0F);
        EXPECT_NEAR(static_cast<double>(mirrored.direction.x), std::sin(critical + beyond), 1e-6);
        EXPECT_NEAR(static_cast<double>(mirrored.direction.z), std::cos(critical + beyond), 1e-6);
    }
}

TEST(RefractionKernel, ASlabReturnsTheDirectionThatItTook) {
    const vec3 normal(0.0F, 0.0F, 1.0F);
    for (const float x : {0.0F, 0.3F, 0.8F, 0.99F}) {
        const vec3 direction(x, 0.0F, -std::sqrt(1.0F - x * x));
        const auto in = kernels::refract_ray(direction, normal, 1.5F);
        const auto out = kernels::refract_ray(in.direction, normal, 1.0F / 1.5F);
        EXPECT_NEAR(glm::length(out.direction - direction), 0.0F, 2e-6F);
        EXPECT_NEAR(out.reflectance, in.reflectance, 2e-5F);  // Stokes
    }
}

TEST(PaneKernel, SumsAllInternalReflections) {
    for (const double r : {0.0, 0.04, 0.0892, 0.5, 0.95}) {
        double through = 0.0;
        double inside = 1.0 - r;
        for (int i = 0; i < 2000; ++i) {
            through += inside * (1.0 - r);
            inside *= r * r;
        }
        EXPECT_NEAR(static_cast<double>(kernels::pane_transmittance(static_cast<float>(r))), through, 1e-6);
    }
    EXPECT_NEAR(kernels::pane_transmittance(0.04F), 0.923F, 5e-4F);  // window glass, 92 %
}

TEST(BeerKernel, TakesTheColourAtItsDistanceAndMultiplies) {
    const vec3 color(0.8F, 0.3F, 0.01F);
    const vec3 absorption = kernels::absorption_per_m(color, 0.25F);
    for (const double path : {0.0, 0.05, 0.25, 0.5, 2.0}) {
        const vec3 left = kernels::beer_transmittance(absorption, static_cast<float>(path));
        for (int c = 0; c < 3; ++c) {
            const double expected = std::pow(static_cast<double>(color[c]), path / 0.25);
            EXPECT_NEAR(static_cast<double>(left[c]), expected, 1e-5 * expected + 1e-15);
        }
    }
    EXPECT_EQ(kernels::absorption_per_m(color, 0.0F), vec3(0.0F));
    EXPECT_EQ(kernels::beer_transmittance(vec3(0.0F), 7.0F), vec3(kernels::exp_near(0.0F)));
    EXPECT_NEAR(kernels::beer_transmittance(vec3(0.0F), 7.0F).x, 1.0F, 2e-7F);
    // A black attenuation colour is dark, not undefined.
    const vec3 black = kernels::beer_transmittance(kernels::absorption_per_m(vec3(0.0F), 1.0F), 0.0F);
    EXPECT_NEAR(black.x, 1.0F, 2e-7F);
}

}  // namespace
}  // namespace macula
