// Lights with an extent as the tracer samples them, against Lambert's polygon formula and the geometry of penumbrae.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr int kSize = 64;
constexpr double kAlbedo = 0.8;
constexpr float kWall_m = -2.0F;  ///< z of the wall that is lit, all that the eye at the origin sees
constexpr float kEdge_m = 1.0F;   ///< z of the blocker behind the eye, which covers x > 0
constexpr float kLight_m = 2.0F;  ///< z of the light
constexpr double kToEdge_m = 3.0;
constexpr double kToLight_m = 4.0;

TracerOptions best() {
    TracerOptions options;
    options.light_samples = 64;
    return options;
}

/// A wall that Lambert's law alone describes.
Scene lit_wall(const Light& light) {
    Scene scene;
    Material matt = test::white();
    matt.specular = 0.0F;
    matt.base_color = glm::vec4(vec3(static_cast<float>(kAlbedo)), 1.0F);
    test::add(scene, test::wall({0.0F, 0.0F, kWall_m}, 10.0F), matt);
    scene.lights.push_back(light);
    return scene;
}

Scene with_edge(Scene scene) {
    test::add(scene, make_quad({0.0F, 50.0F, kEdge_m}, {50.0F, 0.0F, 0.0F}, {0.0F, -100.0F, 0.0F}), test::white());
    return scene;
}

/// Shines along -Z.
Light panel(float half_x_m, float half_y_m) {
    Light light;
    light.kind = LightKind::rectangle;
    light.position_m = vec3(0.0F, 0.0F, kLight_m);
    light.half_u_m = vec3(0.0F, half_y_m, 0.0F);
    light.half_v_m = vec3(half_x_m, 0.0F, 0.0F);
    light.intensity = vec3(6.0F, 3.0F, 1.0F);
    return light;
}

/// Irradiance at a point of the wall of the part of a panel of radiance 1 that lies between two x (Lambert 1760): half
/// of the sum over edges of the angle that the edge subtends times the cosine of the normal of its plane.
double irradiance(const dvec3& point, double left, double right, double half_y) {
    if (left >= right) return 0.0;
    const double z = static_cast<double>(kLight_m);
    const std::array<dvec3, 4> corner{dvec3(left, -half_y, z), dvec3(right, -half_y, z), dvec3(right, half_y, z),
                                      dvec3(left, half_y, z)};
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const dvec3 a = glm::normalize(corner[i] - point);
        const dvec3 b = glm::normalize(corner[(i + 1) % 4] - point);
        sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b)).z;
    }
    return std::abs(0.5 * sum);
}

dvec3 wall_point(const test::Traced& traced, int x, int y) {
    return dvec3(traced.tangents(x, y), -1.0F) * static_cast<double>(-kWall_m);
}

TEST(AreaLight, PanelIsLambertsPolygon) {
    constexpr float kHalfX = 1.0F;
    constexpr float kHalfY = 0.7F;
    const test::Traced traced = test::trace(lit_wall(panel(kHalfX, kHalfY)), test::square_view(kSize), best());
    double sum_of_error = 0.0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double exact = kAlbedo * std::numbers::inv_pi *
                                 irradiance(wall_point(traced, x, y), -double{kHalfX}, double{kHalfX}, double{kHalfY});
            const vec3 found = traced.radiance(x, y);
            ASSERT_NEAR(found.x / (6.0 * exact), 1.0, 0.005) << x << ", " << y;
            ASSERT_FLOAT_EQ(found.y, 0.5F * found.x);
            sum_of_error += found.x / (6.0 * exact) - 1.0;
        }
    }
    EXPECT_NEAR(sum_of_error / (kSize * kSize), 0.0, 3e-4);
}

TEST(AreaLight, PenumbraOfAPanelIsThePartOfItThatIsSeen) {
    constexpr double kHalfX = 0.3;
    constexpr double kHalfY = 0.5;
    const Scene scene = lit_wall(panel(static_cast<float>(kHalfX), static_cast<float>(kHalfY)));
    const test::Traced open = test::trace(scene, test::square_view(kSize), best());
    const test::Traced traced = test::trace(with_edge(scene), test::square_view(kSize), best());
    // The edge's shadow of the point x of the light lies at -x (to edge) / (light to edge).
    constexpr double kStretch = kToEdge_m / (kToLight_m - kToEdge_m);
    for (int x = 0; x < kSize; ++x) {
        const double at = wall_point(traced, x, 0).x;
        double found = 0.0;
        double expected = 0.0;
        for (int y = 0; y < kSize; ++y) {
            if (at > kHalfX * kStretch) {
                ASSERT_EQ(traced.radiance(x, y), vec3(0.0F)) << x << ", " << y;
            }
            if (at < -kHalfX * kStretch) {
                ASSERT_EQ(traced.radiance(x, y), open.radiance(x, y)) << x << ", " << y;
            }
            const double seen = std::min(-at / kStretch, kHalfX);
            const double part = irradiance(wall_point(traced, x, y), -kHalfX, seen, kHalfY);
            const double whole = irradiance(wall_point(traced, x, y), -kHalfX, kHalfX, kHalfY);
            found += traced.radiance(x, y).x;
            expected += 6.0 * kAlbedo * std::numbers::inv_pi * part;
            ASSERT_NEAR(traced.radiance(x, y).x / (6.0 * kAlbedo * std::numbers::inv_pi * whole), part / whole, 0.09)
                << x << ", " << y;
        }
        EXPECT_NEAR(found, expected,
                    0.01 * 6.0 * kAlbedo * std::numbers::inv_pi * kSize *
                        irradiance(wall_point(traced, x, 32), -kHalfX, kHalfX, kHalfY))
            << x;
    }
}

/// Share of a disc of radius 1 on the far side of a line at a distance from its centre, -1..1 and beyond.
double disc_share(double distance) {
    const double t = std::clamp(distance, -1.0, 1.0);
    return (std::acos(t) - t * std::sqrt(1.0 - t * t)) * std::numbers::inv_pi;
}

/// Compares each column of a shadow with the share of a disc; `edge_in_radii` is the blocker's edge seen from a wall
/// point in radii of the light, positive where the blocker covers the centre.
template <class Edge>
void expect_disc(const Scene& scene, Edge&& edge_in_radii) {
    const test::Traced open = test::trace(scene, test::square_view(kSize), best());
    const test::Traced traced = test::trace(with_edge(scene), test::square_view(kSize), best());
    int within = 0;
    for (int x = 0; x < kSize; ++x) {
        const double edge = edge_in_radii(wall_point(traced, x, 0).x);
        double share = 0.0;
        for (int y = 0; y < kSize; ++y) {
            if (edge > 1.001) {
                ASSERT_EQ(traced.radiance(x, y), vec3(0.0F)) << x << ", " << y;
            }
            if (edge < -1.001) {
                ASSERT_EQ(traced.radiance(x, y), open.radiance(x, y)) << x << ", " << y;
            }
            share += static_cast<double>(traced.radiance(x, y).x / open.radiance(x, y).x) / kSize;
        }
        EXPECT_NEAR(share, disc_share(edge), 0.025) << x;
        within += std::abs(edge) < 1.0 ? 1 : 0;
    }
    EXPECT_GT(within, 4);
}

TEST(AreaLight, PenumbraOfABall) {
    constexpr double kRadius = 0.2;
    Light ball;
    ball.kind = LightKind::point;
    ball.position_m = vec3(0.0F, 0.0F, kLight_m);
    ball.radius_m = static_cast<float>(kRadius);
    // Distance of the ball's centre from the plane through the wall's point and the edge.
    expect_disc(lit_wall(ball),
                [](double x) { return x * (kToLight_m / kToEdge_m - 1.0) / std::hypot(1.0, x / kToEdge_m) / kRadius; });
}

TEST(AreaLight, PenumbraOfASun) {
    constexpr double kAngle = 0.1;
    Light sun;
    sun.angular_radius_rad = static_cast<float>(kAngle);
    expect_disc(lit_wall(sun), [](double x) { return std::sin(std::atan(x / kToEdge_m)) / std::sin(kAngle); });
}

/// Adds the surface that shines in a panel's place.
Scene with_luminous_quad(Scene scene) {
    Light& light = scene.lights.front();
    Material lamp = test::white();
    lamp.base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    lamp.specular = 0.0F;
    lamp.emissive = light.intensity;
    const vec3 top_left = light.position_m + light.half_u_m + light.half_v_m;
    light.instance =
        static_cast<int>(test::add(scene, make_quad(top_left, -2.0F * light.half_v_m, -2.0F * light.half_u_m), lamp)) -
        1;
    return scene;
}

TEST(AreaLight, ALuminousQuadIsSeenAndDoesNotShadeItself) {
    for (const int samples : {1, 4, 16, 64}) {
        TracerOptions options;
        options.light_samples = samples;
        const Scene bare = lit_wall(panel(0.8F, 0.6F));
        const Scene scene = with_luminous_quad(bare);
        const test::Traced expected = test::trace(bare, test::square_view(kSize), options);
        const test::Traced traced = test::trace(scene, test::square_view(kSize), options);
        EXPECT_GT(traced.radiance(kSize / 2, kSize / 2).x, 0.1F);
        EXPECT_EQ(traced.samples.radiance, expected.samples.radiance);
        EyeView back = test::square_view(kSize);
        back.world_from_eye.orientation = glm::angleAxis(std::numbers::pi_v<float>, vec3(0.0F, 1.0F, 0.0F));
        const test::Traced seen = test::trace(scene, back, options);
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const glm::vec2 t = seen.tangents(x, y);
                const bool on = std::abs(t.x) * kLight_m < 0.8F && std::abs(t.y) * kLight_m < 0.6F;
                ASSERT_EQ(seen.radiance(x, y), on ? scene.lights.front().intensity : vec3(0.0F)) << x << ", " << y;
            }
        }
    }
}

TEST(AreaLight, AMirrorShowsALuminousQuadOnce) {
    Scene scene = with_luminous_quad(lit_wall(panel(0.8F, 0.6F)));
    Material& mirror = scene.materials.front();
    mirror = test::white();
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    const test::Traced traced = test::trace(scene, test::square_view(kSize));
    const vec3 light = scene.lights.front().intensity;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const glm::vec2 at = traced.tangents(x, y) * (kLight_m - 2.0F * kWall_m);
            const bool on = std::abs(at.x) < 0.8F && std::abs(at.y) < 0.6F;
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(traced.radiance(x, y)[c], on ? light[c] : 0.0F, 1e-3F * light[c]);
        }
    }
}

TEST(AreaLight, AStillHeadSeesNoFlicker) {
    Scene scene = with_edge(lit_wall(panel(0.3F, 0.5F)));
    Light ball;
    ball.kind = LightKind::point;
    ball.position_m = vec3(0.5F, 0.0F, kLight_m);
    ball.radius_m = 0.2F;
    scene.lights.push_back(ball);
    const auto tracer = test::tracer_of(scene);
    const EyeView view = test::square_view(kSize);
    const SamplePlan plan = test::full_plan(kSize, kSize);
    std::array<Samples, 2> frames;
    for (std::size_t i = 0; i < 2; ++i) {
        frames[i].keep_radiance = true;
        const TraceTask task{&view, &plan, &frames[i]};
        tracer->trace({&task, 1}, 0.7 * static_cast<double>(i));
    }
    EXPECT_EQ(frames[0].radiance, frames[1].radiance);
    EXPECT_EQ(frames[0].color, frames[1].color);
}

}  // namespace
}  // namespace macula
