// Lit scenes against closed forms: the radiance of a surface whose material is known is worked out on paper.

#include <gtest/gtest.h>

#include <cmath>

#include "server/kernels/brdf.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

/// Difference of the radiance of a white and of a black wall: the Lambert part, without the specular one.
struct LambertPart {
    test::Traced white;
    test::Traced black;

    LambertPart(const Light& light, const EyeView& view, float distance_m) : white(), black() {
        for (const float albedo : {1.0F, 0.0F}) {
            Scene scene;
            scene.lights.push_back(light);
            Material material = test::white();
            material.base_color = glm::vec4(vec3(albedo), 1.0F);
            test::add(scene, test::wall({0.0F, 0.0F, -distance_m}, 4.0F * distance_m), material);
            (albedo > 0.0F ? white : black) = test::trace(scene, view);
        }
    }
    [[nodiscard]] float at(int x, int y) const { return (white.radiance(x, y) - black.radiance(x, y)).x; }
};

/// The base's share of the light of unit irradiance on a surface that faces it. What surfaces reflect is tested with
/// the kernels; here it is how much light arrives.
float lambert(float n_dot_l, float n_dot_v) {
    const kernels::Surface surface = kernels::make_surface(vec3(1.0F), 0.0F, 1.0F, n_dot_v);
    const kernels::Albedos lit = kernels::albedos_at(surface.curves, n_dot_l);
    return n_dot_l * surface.base.x * (surface.entry.x - surface.entry.y * lit.grazing - surface.entry.z * lit.loss);
}

/// Point of the wall that a pixel shows.
vec3 on_wall(const test::Traced& traced, int x, int y, float distance_m) {
    return vec3(traced.tangents(x, y), -1.0F) * distance_m;
}

float cosine(const vec3& direction) {
    return direction.z / glm::length(direction);
}

TEST(LitWall, DirectionalLightFollowsTheCosine) {
    for (const float angle : {0.0F, 0.6F, 1.2F}) {
        Light sun;
        sun.direction = vec3(std::sin(angle), 0.0F, -std::cos(angle));
        sun.intensity = vec3(3.0F);
        const LambertPart part(sun, test::square_view(17), 2.0F);
        for (const int x : {0, 8, 16}) {
            const float n_dot_v = cosine(-on_wall(part.white, x, 8, 2.0F));
            EXPECT_NEAR(part.at(x, 8), 3.0F * lambert(std::cos(angle), n_dot_v), 1e-5F) << "angle " << angle;
        }
    }
}

TEST(LitWall, LightFromBehindDoesNotShineThrough) {
    Scene scene;
    Light sun;
    sun.direction = vec3(0.0F, 0.0F, 1.0F);
    sun.casts_shadow = false;
    scene.lights.push_back(sun);
    test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 8.0F), test::white());
    const test::Traced traced = test::trace(scene, test::square_view(16));
    for (int i = 0; i < 16; ++i) EXPECT_EQ(traced.radiance(i, i), vec3(0.0F));
}

TEST(LitWall, PointLightFallsWithDistanceAndAngle) {
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position_m = vec3(0.5F, 0.25F, -1.5F);
    lamp.intensity = vec3(2.0F);
    const LambertPart part(lamp, test::square_view(33), 3.0F);
    for (int y = 0; y < 33; y += 4) {
        for (int x = 0; x < 33; x += 4) {
            const vec3 point = on_wall(part.white, x, y, 3.0F);
            const vec3 to_light = lamp.position_m - point;
            const float irradiance = 2.0F / glm::dot(to_light, to_light);
            const float expected = irradiance * lambert(cosine(to_light), cosine(-point));
            EXPECT_NEAR(part.at(x, y), expected, 1e-4F * expected + 1e-6F) << x << ", " << y;
        }
    }
}

TEST(LitWall, RangeEndsTheLight) {
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position_m = vec3(0.0F, 0.0F, -1.0F);
    lamp.range_m = 2.0F;
    const LambertPart part(lamp, test::square_view(65), 2.0F);
    for (int x = 0; x < 65; ++x) {
        const vec3 to_light = lamp.position_m - on_wall(part.white, x, 32, 2.0F);
        if (glm::length(to_light) > 2.001F) {
            EXPECT_EQ(part.at(x, 32), 0.0F);
        } else if (glm::length(to_light) < 1.95F) {
            EXPECT_GT(part.at(x, 32), 0.0F);
        }
    }
}

TEST(LitWall, SpotConeHasItsAngles) {
    Light spot;
    spot.kind = LightKind::spot;
    spot.direction = vec3(0.0F, 0.0F, -1.0F);
    spot.spot_cos_inner = std::cos(0.3F);
    spot.spot_cos_outer = std::cos(0.5F);
    const LambertPart part(spot, test::square_view(129), 2.0F);
    for (int x = 0; x < 129; ++x) {
        const vec3 point = on_wall(part.white, x, 64, 2.0F);
        const float angle = std::atan(std::hypot(point.x, point.y) / 2.0F);
        const float full = lambert(std::cos(angle), std::cos(angle)) / glm::dot(point, point);
        if (angle < 0.299F) {
            EXPECT_NEAR(part.at(x, 64), full, 1e-4F * full);
        }
        if (angle > 0.501F) {
            EXPECT_EQ(part.at(x, 64), 0.0F);
        }
        if (angle > 0.31F && angle < 0.49F) {
            const float ramp = (std::cos(angle) - spot.spot_cos_outer) / (spot.spot_cos_inner - spot.spot_cos_outer);
            EXPECT_NEAR(part.at(x, 64), full * ramp * ramp, 1e-3F * full);
        }
    }
}

TEST(LitWall, LightsAddUp) {
    Light sun;
    sun.direction = glm::normalize(vec3(1.0F, 0.0F, -1.0F));
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position_m = vec3(1.0F, 1.0F, 0.0F);
    lamp.intensity = vec3(0.5F, 1.0F, 2.0F);
    const auto radiance = [](const std::vector<Light>& lights) {
        Scene scene;
        scene.lights = lights;
        test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 8.0F), test::white());
        return test::trace(scene, test::square_view(16)).radiance(5, 9);
    };
    const vec3 both = radiance({sun, lamp});
    const vec3 sum = radiance({sun}) + radiance({lamp});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(both[c], sum[c], 1e-6F);
}

}  // namespace
}  // namespace macula
