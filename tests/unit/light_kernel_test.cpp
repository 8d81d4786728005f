// Falloff of the three kinds of light against KHR_lights_punctual.

#include <gtest/gtest.h>

#include <cmath>

#include "server/kernels/light.h"

namespace macula {
namespace {

using glm::vec3;
using glm::vec4;

kernels::Light point_light(const vec3& position, float range_m = 0.0F) {
    return {vec4(position, 1.0F),
            vec3(0.0F, 0.0F, -1.0F),
            vec3(10.0F, 5.0F, 1.0F),
            range_m > 0.0F ? 1.0F / range_m : 0.0F,
            0.0F,
            1.0F,
            0.0F};
}

TEST(LightKernel, DirectionalLightIsTheSameEverywhere) {
    const kernels::Light sun{
        vec4(0.6F, 0.8F, 0.0F, 0.0F), vec3(-0.6F, -0.8F, 0.0F), vec3(3.0F), 0.0F, 0.0F, 1.0F, 0.0F};
    for (const vec3 point : {vec3(0.0F), vec3(1e4F, -300.0F, 12.0F)}) {
        const kernels::LightSample s = kernels::sample_light(sun, point);
        EXPECT_NEAR(s.irradiance.x, 3.0F, 1e-5F);
        EXPECT_NEAR(glm::length(s.direction - vec3(0.6F, 0.8F, 0.0F)), 0.0F, 1e-6F);
        EXPECT_EQ(s.to_light, vec3(0.6F, 0.8F, 0.0F));
    }
}

TEST(LightKernel, PointLightFallsWithTheSquareOfTheDistance) {
    for (const float distance : {0.25F, 1.0F, 7.0F}) {
        const kernels::LightSample s = kernels::sample_light(point_light({0.0F, distance, 0.0F}), vec3(0.0F));
        EXPECT_NEAR(s.irradiance.x, 10.0F / (distance * distance), 1e-4F * s.irradiance.x);
        EXPECT_NEAR(s.irradiance.y / s.irradiance.x, 0.5F, 1e-6F);
        EXPECT_NEAR(glm::length(s.to_light), distance, 1e-6F);
    }
    EXPECT_TRUE(std::isfinite(kernels::sample_light(point_light(vec3(0.0F)), vec3(0.0F)).irradiance.x));
}

TEST(LightKernel, RangeWindowEndsAtTheRange) {
    const auto at = [](float distance) {
        return kernels::sample_light(point_light({0.0F, 0.0F, 0.0F}, 4.0F), vec3(distance, 0.0F, 0.0F)).irradiance.x;
    };
    EXPECT_NEAR(at(2.0F), 10.0F / 4.0F * (1.0F - 1.0F / 16.0F), 1e-5F);
    EXPECT_GT(at(3.99F), 0.0F);
    EXPECT_EQ(at(4.0F), 0.0F);
    EXPECT_EQ(at(5.0F), 0.0F);
}

TEST(LightKernel, SpotIsFullInsideTheInnerConeAndDarkOutsideTheOuter) {
    const float cos_inner = std::cos(0.2F);
    const float cos_outer = std::cos(0.5F);
    const float scale = 1.0F / (cos_inner - cos_outer);
    const kernels::Light spot{
        vec4(0.0F, 0.0F, 0.0F, 1.0F), vec3(0.0F, 0.0F, -1.0F), vec3(1.0F), 0.0F, scale, -cos_outer * scale, 0.0F};
    const auto at = [&](float angle_rad) {
        return kernels::sample_light(spot, vec3(std::sin(angle_rad), 0.0F, -std::cos(angle_rad))).irradiance.x;
    };
    EXPECT_NEAR(at(0.0F), 1.0F, 1e-5F);
    EXPECT_NEAR(at(0.19F), 1.0F, 1e-4F);
    const float ramp = (std::cos(0.35F) - cos_outer) / (cos_inner - cos_outer);
    EXPECT_NEAR(at(0.35F), ramp * ramp, 1e-4F);
    EXPECT_EQ(at(0.51F), 0.0F);
    EXPECT_EQ(at(3.0F), 0.0F);
}

}  // namespace
}  // namespace macula
