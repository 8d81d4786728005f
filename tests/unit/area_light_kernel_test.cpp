// Lights with an extent against closed forms, and the error of few samples.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "server/kernels/area_light.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

/// Irradiance of a uniform polygon of radiance 1 that lies wholly above the surface (Lambert 1760): half of the sum
/// over edges of the angle that the edge subtends times the cosine of the normal of its plane with the point.
double polygon_irradiance(const std::array<dvec3, 4>& corners, const dvec3& point, const dvec3& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const dvec3 a = glm::normalize(corners[i] - point);
        const dvec3 b = glm::normalize(corners[(i + 1) % 4] - point);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
    }
    return std::abs(0.5 * sum);
}

/// Mean over the samples of irradiance times cosine.
template <class AnyLight>
double irradiance(const AnyLight& light, const vec3& point, const vec3& normal, int side, vec2 offset) {
    double sum = 0.0;
    for (int i = 0; i < side * side; ++i) {
        const auto s = kernels::sample_light(light, point, kernels::stratified_place(i, side, offset));
        sum += static_cast<double>(s.irradiance.x * std::max(glm::dot(s.direction, normal), 0.0F));
    }
    return sum / (side * side);
}

kernels::RectangleLight panel() {
    return {vec3(0.2F, -0.1F, 2.0F), vec3(0.0F, 0.5F, 0.0F), vec3(0.8F, 0.0F, 0.1F), vec3(1.0F)};
}

std::array<dvec3, 4> corners(const kernels::RectangleLight& r) {
    return {dvec3(r.center - r.half_u - r.half_v), dvec3(r.center + r.half_u - r.half_v),
            dvec3(r.center + r.half_u + r.half_v), dvec3(r.center - r.half_u + r.half_v)};
}

TEST(RectangleLight, IrradianceIsLamberts) {
    const vec3 normal = glm::normalize(vec3(0.2F, 0.1F, 1.0F));
    for (const vec3 point : {vec3(0.0F), vec3(1.5F, 0.3F, 0.5F), vec3(-2.0F, 1.0F, 0.0F), vec3(0.2F, 0.0F, 1.2F)}) {
        const double exact = polygon_irradiance(corners(panel()), point, normal);
        double mean = 0.0;  // of what 4 x 4 pixels see
        for (int i = 0; i < 16; ++i)
            mean += irradiance(panel(), point, normal, 16, kernels::light_offset(i % 4, i / 4)) / 16.0;
        EXPECT_NEAR(mean, exact, 1e-3 * exact);
    }
}

// Relative error of N stratified samples, root mean square over offsets; the figures are what the header refers to.
TEST(RectangleLight, ErrorOfFewSamples) {
    constexpr std::uint32_t kSeed = 5;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    const kernels::RectangleLight square{vec3(0.0F, 0.0F, 1.0F), vec3(0.0F, 0.5F, 0.0F), vec3(0.5F, 0.0F, 0.0F),
                                         vec3(1.0F)};
    const vec3 up(0.0F, 0.0F, 1.0F);
    struct Bound {
        float distance;  ///< in sides of the square
        double at_1;
        double at_4;
        double at_64;
    };
    for (const Bound bound : {Bound{0.5F, 0.85, 0.21, 0.019}, Bound{1.0F, 0.35, 0.082, 0.007},
                              Bound{2.0F, 0.115, 0.027, 0.0018}, Bound{4.0F, 0.032, 0.008, 0.0006}}) {
        const vec3 point(0.3F, 0.2F, 1.0F - bound.distance);
        const double exact = polygon_irradiance(corners(square), point, up);
        std::array<double, 3> error{};
        const std::array<int, 3> sides{1, 2, 8};
        for (std::size_t k = 0; k < sides.size(); ++k) {
            double sum = 0.0;
            constexpr int kOffsets = 400;
            for (int i = 0; i < kOffsets; ++i) {
                const double e =
                    irradiance(square, point, up, sides[k], vec2(unit(random), unit(random))) / exact - 1.0;
                sum += e * e;
            }
            error[k] = std::sqrt(sum / kOffsets);
        }
        std::printf("square light at %.1f sides: rms error %.3f, %.3f, %.4f with 1, 4, 64 samples\n",
                    static_cast<double>(bound.distance), error[0], error[1], error[2]);
        EXPECT_LT(error[0], bound.at_1);
        EXPECT_LT(error[1], bound.at_4);
        EXPECT_LT(error[2], bound.at_64);
    }
}

TEST(RectangleLight, ShinesToOneSide) {
    const kernels::RectangleLight light = panel();
    EXPECT_GT(kernels::sample_light(light, vec3(0.0F), vec2(0.5F)).irradiance.x, 0.0F);
    EXPECT_EQ(kernels::sample_light(light, vec3(0.0F, 0.0F, 4.0F), vec2(0.5F)).irradiance.x, 0.0F);
}

TEST(RectangleLight, FarAwayItIsAPointLight) {
    const kernels::RectangleLight light = panel();
    const vec3 point(0.0F, 0.0F, -300.0F);
    const vec3 to_center = light.center - point;
    const auto s = kernels::sample_light(light, point, vec2(0.1F, 0.9F));
    const double area = 4.0 * static_cast<double>(glm::length(glm::cross(light.half_u, light.half_v)));
    const double d2 = static_cast<double>(glm::dot(to_center, to_center));
    const double cosine = static_cast<double>(
        std::abs(glm::dot(glm::normalize(glm::cross(light.half_u, light.half_v)), glm::normalize(to_center))));
    EXPECT_NEAR(static_cast<double>(s.irradiance.x), area * cosine / d2, 5e-3 * area / d2);
}

kernels::Light bulb(float radius) {
    kernels::Light light{};
    light.position = vec4(0.0F, 0.0F, 2.0F, 1.0F);
    light.direction = vec3(0.0F, 0.0F, -1.0F);
    light.intensity = vec3(10.0F, 5.0F, 1.0F);
    light.spot_offset = 1.0F;
    light.radius = radius;
    return light;
}

// A sphere above the horizon brings I cos / d^2 whatever its size, exactly (its cosine-weighted solid angle is pi
// sin^2 of its half angle times the cosine of its centre).
TEST(SphereLight, FallsWithTheSquareOfTheDistance) {
    for (const float radius : {0.0F, 0.01F, 0.3F, 0.9F}) {
        for (const vec3 point : {vec3(0.0F), vec3(0.5F, 0.2F, 0.4F), vec3(0.0F, 0.0F, -20.0F)}) {
            const vec3 to_center = vec3(0.0F, 0.0F, 2.0F) - point;
            const double d2 = static_cast<double>(glm::dot(to_center, to_center));
            const double cosine = static_cast<double>(to_center.z) / std::sqrt(d2);
            const double exact = 10.0 * cosine / d2;
            EXPECT_NEAR(irradiance(bulb(radius), point, vec3(0.0F, 0.0F, 1.0F), 64, vec2(0.5F)), exact, 1e-3 * exact)
                << "radius " << radius;
            EXPECT_NEAR(irradiance(bulb(radius), point, vec3(0.0F, 0.0F, 1.0F), 2, vec2(0.3F, 0.8F)), exact,
                        0.1 * exact);
        }
    }
}

TEST(SphereLight, RadiusZeroIsThePointLight) {
    for (const vec3 point : {vec3(0.0F), vec3(3.0F, -1.0F, 0.5F)}) {
        kernels::Light light = bulb(0.0F);
        light.inverse_range = 0.1F;
        light.spot_scale = 2.0F;
        light.spot_offset = -0.5F;
        const auto hard = kernels::sample_light(light, point);
        const auto soft = kernels::sample_light(light, point, vec2(0.2F, 0.9F));
        EXPECT_EQ(soft.irradiance, hard.irradiance);
        EXPECT_NEAR(glm::length(soft.direction - hard.direction), 0.0F, 1e-6F);
        EXPECT_NEAR(glm::length(soft.to_light - hard.to_light), 0.0F, 1e-5F);
    }
}

TEST(SphereLight, RaysEndOnTheSphereWithinItsCone) {
    const kernels::Light light = bulb(0.5F);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    for (int i = 0; i < 1000; ++i) {
        const vec3 point(unit(random), unit(random), unit(random));
        const auto s = kernels::sample_light(light, point, vec2(unit(random), unit(random)));
        EXPECT_NEAR(glm::distance(point + s.to_light, vec3(0.0F, 0.0F, 2.0F)), 0.5F, 2e-3F);
        EXPECT_NEAR(glm::length(s.direction), 1.0F, 1e-5F);
    }
    // Within the sphere there is still a number.
    EXPECT_TRUE(std::isfinite(kernels::sample_light(light, vec3(0.0F, 0.0F, 1.9F), vec2(0.4F)).irradiance.x));
}

TEST(SunLight, SpreadsOverItsDisc) {
    kernels::Light sun{};
    sun.position = vec4(0.6F, 0.0F, 0.8F, 0.0F);
    sun.direction = vec3(-0.6F, 0.0F, -0.8F);
    sun.intensity = vec3(3.0F);
    sun.spot_offset = 1.0F;
    for (const float radius : {0.0F, 0.00465F, 0.2F}) {
        sun.radius = radius;
        EXPECT_NEAR(irradiance(sun, vec3(5.0F), vec3(0.0F, 0.0F, 1.0F), 32, vec2(0.5F)), 3.0 * 0.8, 2e-3);
        double widest = 0.0;
        for (int i = 0; i < 1024; ++i) {
            const auto s = kernels::sample_light(sun, vec3(0.0F), kernels::stratified_place(i, 32, vec2(0.51F)));
            EXPECT_NEAR(glm::length(s.to_light), 1.0F, 1e-5F);
            widest =
                std::max(widest, static_cast<double>(glm::length(glm::cross(s.direction, vec3(0.6F, 0.0F, 0.8F)))));
        }
        EXPECT_LE(widest, static_cast<double>(radius) + 1e-6);
        EXPECT_GE(widest, 0.97 * static_cast<double>(radius));
    }
}

TEST(DiscFromSquare, KeepsAreas) {
    std::array<int, 8> sectors{};
    std::array<int, 4> rings{};
    constexpr int kSide = 400;
    for (int i = 0; i < kSide * kSide; ++i) {
        const vec2 p = kernels::disc_from_square(kernels::stratified_place(i, kSide, vec2(0.37F, 0.71F)));
        const float share = glm::dot(p, p);
        ASSERT_LE(share, 1.00001F);
        const double angle = std::atan2(static_cast<double>(p.y), static_cast<double>(p.x)) + std::numbers::pi;
        ++sectors[static_cast<std::size_t>(std::min(7.0, angle / (2.0 * std::numbers::pi) * 8.0))];
        ++rings[static_cast<std::size_t>(std::min(3.0F, share * 4.0F))];
    }
    for (const int count : sectors) EXPECT_NEAR(count, kSide * kSide / 8, kSide * kSide / 400);
    for (const int count : rings) EXPECT_NEAR(count, kSide * kSide / 4, kSide * kSide / 400);
}

TEST(StratifiedPlace, HasOneSampleInEachStratumRowAndColumn) {
    for (const int side : {1, 2, 4, 8}) {
        const int count = side * side;
        std::vector<int> strata(count);
        std::vector<int> columns(count);
        std::vector<int> rows(count);
        for (int i = 0; i < count; ++i) {
            const vec2 p = kernels::stratified_place(i, side, vec2(0.0F));
            const auto cell = [&](float at, int cells) { return static_cast<int>(at * static_cast<float>(cells)); };
            ++strata[cell(p.y, side) * side + cell(p.x, side)];
            ++columns[cell(p.x, count)];
            ++rows[cell(p.y, count)];
        }
        for (int i = 0; i < count; ++i) EXPECT_EQ(strata[i] * columns[i] * rows[i], 1) << "side " << side;
    }
    EXPECT_EQ(kernels::stratified_place(0, 1, vec2(0.0F)), vec2(0.5F));
    const vec2 moved = kernels::stratified_place(3, 2, vec2(0.5F, 1.25F));
    EXPECT_NEAR(moved.x, 0.375F, 1e-6F);
    EXPECT_NEAR(moved.y, 0.125F, 1e-6F);
}

TEST(LightOffset, HasSixteenInEveryFourByFourPixels) {
    for (const int corner : {0, 3, 21}) {
        std::array<int, 16> columns{};
        std::array<int, 16> rows{};
        for (int y = corner; y < corner + 4; ++y) {
            for (int x = 2 * corner; x < 2 * corner + 4; ++x) {
                const vec2 offset = kernels::light_offset(x, y);
                ++columns[static_cast<std::size_t>(offset.x * 16.0F)];
                ++rows[static_cast<std::size_t>(offset.y * 16.0F)];
            }
        }
        for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(columns[i] * rows[i], 1);
    }
}

}  // namespace
}  // namespace macula
