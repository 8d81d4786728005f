// Scenes that another renderer measured, Mitsuba 3: for which both renderers gather the same light, so that what
// differs is an error of one of them, or of a model, and then the model's part is said beside the bound. The measured
// values lie in independent_renderer_values.h; independent_renderer.py made them and makes them again for anyone who
// has that renderer (`pip install mitsuba==3.9.1 numpy`). Nothing here needs it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "server/kernels/brdf.h"
#include "tests/golden/independent_renderer_values.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;
using test::Measured;

constexpr int kPatch = 8;  ///< edge of a ray's picture, px

/// Who looks from where.
struct Probe {
    const Tracer& tracer;
    vec3 eye_m;
    /// Half the width of a ray's picture, as a tangent, over which the noise of light samples averages out.
    float half_width = 1e-4F;
};

EyeView patch_around(const Probe& probe, const vec3& point) {
    EyeView view = test::square_view(kPatch, probe.eye_m);
    view.tangents = {-probe.half_width, probe.half_width, -1e-4F, 1e-4F};
    const vec3 forward = glm::normalize(point - probe.eye_m);
    view.world_from_eye.orientation = glm::quatLookAt(forward, vec3(0.0F, 1.0F, 0.0F));
    return view;
}

vec3 mean_radiance(const test::Traced& traced) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < kPatch; ++y) {
        for (int x = 0; x < kPatch; ++x) sum += glm::dvec3(traced.radiance(x, y));
    }
    return sum / static_cast<double>(kPatch * kPatch);
}

/// The tracer's radiance where the other renderer measured.
vec3 traced_at(const Probe& probe, const vec3& point) {
    const SamplePlan plan = test::full_plan(kPatch, kPatch);
    test::Traced traced{patch_around(probe, point), {}};
    traced.samples.keep_radiance = true;
    const TraceTask task{&traced.view, &plan, &traced.samples};
    probe.tracer.trace({&task, 1});
    return mean_radiance(traced);
}

/// `bound` is a share of the measured radiance; four standard errors are added to it.
void expect_measured(const Probe& probe, std::span<const Measured> measured, float bound) {
    for (const Measured& m : measured) {
        const vec3 found = traced_at(probe, m.point);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], m.radiance[c], 4.0F * m.standard_error + bound * m.radiance[c])
                << "channel " << c << " through " << m.point.x << ", " << m.point.y << ", " << m.point.z;
        }
    }
}

/// Reflects by Lambert's law alone: no specular lobe takes a share.
Material lambertian(float albedo) {
    Material material = test::white();
    material.base_color = glm::vec4(vec3(albedo), 1.0F);
    material.specular = 0.0F;
    return material;
}

/// A square of 20 m at y = 0, facing up.
Mesh floor_mesh() {
    return make_quad({-10.0F, 0.0F, -10.0F}, {20.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 20.0F});
}

/// A square of 1 m and radiance 10 above the origin that shines down, tilted about +Z.
Light square_lamp(float height_m, float tilt_rad) {
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0F), tilt_rad, vec3(0.0F, 0.0F, 1.0F));
    Light lamp;
    lamp.kind = LightKind::rectangle;
    lamp.position_m = vec3(0.0F, height_m, 0.0F);
    lamp.direction = vec3(turn * glm::vec4(0.0F, -1.0F, 0.0F, 0.0F));
    lamp.half_u_m = vec3(turn * glm::vec4(0.5F, 0.0F, 0.0F, 0.0F));
    lamp.half_v_m = vec3(0.0F, 0.0F, 0.5F);
    lamp.intensity = vec3(10.0F);
    return lamp;
}

Scene lit_floor(const Light& light) {
    Scene scene;
    scene.lights.push_back(light);
    test::add(scene, floor_mesh(), lambertian(0.5F));
    return scene;
}

TracerOptions best_shadows() {
    TracerOptions options;
    options.light_samples = 64;
    return options;
}

TEST(IndependentRenderer, SquareLampAboveALambertFloor) {
    const Scene scene = lit_floor(square_lamp(2.0F, 0.0F));
    expect_measured({*test::tracer_of(scene, best_shadows()), {0.0F, 1.0F, 4.0F}}, test::kLampAbove, 1e-3F);
}

TEST(IndependentRenderer, TiltedSquareLampNearALambertFloor) {
    const Scene scene = lit_floor(square_lamp(0.8F, glm::radians(40.0F)));
    expect_measured({*test::tracer_of(scene, best_shadows()), {0.0F, 0.3F, 4.0F}}, test::kLampNear, 1e-3F);
}

TEST(IndependentRenderer, PenumbraOfASquare) {
    Scene scene = lit_floor(square_lamp(2.0F, 0.0F));
    Material blocker = lambertian(0.0F);
    blocker.double_sided = true;
    test::add(scene, make_quad({-0.3F, 1.0F, -0.4F}, {0.8F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.8F}), blocker);
    // 64 samples from 64 points leave errors of .15 % of the unshadowed light, .8 % of what the darkest point receives.
    expect_measured({*test::tracer_of(scene, best_shadows()), {0.0F, 0.6F, 4.0F}, 5e-3F}, test::kPenumbra, 0.012F);
}

constexpr vec3 kGold(1.0F, 0.77F, 0.34F);

/// A floor of gold under a point light.
struct GoldFloor {
    float roughness;
    vec3 light_m;
    vec3 eye_m;

    [[nodiscard]] Scene scene() const {
        Scene scene;
        Light light;
        light.kind = LightKind::point;
        light.position_m = light_m;
        light.intensity = vec3(10.0F);
        scene.lights.push_back(light);
        Material gold = test::white();
        gold.metallic = 1.0F;
        gold.roughness = roughness;
        gold.base_color = glm::vec4(kGold, 1.0F);
        test::add(scene, floor_mesh(), gold);
        return scene;
    }

    /// What Mitsuba's metal loses: the light that bounces between microfacets, which the furnace tests account for.
    /// Next to nothing near the highlight (at most .15 % of it here), but up to 70 % of what there is far beside it.
    [[nodiscard]] vec3 between_microfacets(const vec3& point) const {
        const vec3 to_light = light_m - point;
        const float n_dot_l = glm::normalize(to_light).y;
        const kernels::Surface gold = kernels::make_surface(kGold, 1.0F, roughness, glm::normalize(eye_m - point).y);
        const float lost = kernels::albedos_at(gold.curves, n_dot_l).loss;
        return gold.scatter * (lost * n_dot_l * 10.0F / glm::dot(to_light, to_light));
    }

    void expect(std::span<const Measured> measured, float bound) const {
        std::vector<Measured> whole(measured.begin(), measured.end());
        for (Measured& m : whole) m.radiance += between_microfacets(m.point);
        TracerOptions direct;
        direct.bounces = 0;
        expect_measured({*test::tracer_of(scene(), direct), eye_m}, whole, bound);
    }
};

TEST(IndependentRenderer, GlossyMetalUnderAPointLight) {
    GoldFloor{0.2F, {0.0F, 2.0F, 0.0F}, {0.0F, 2.0F, 4.0F}}.expect(test::kSmootherSteep, 1e-4F);
    GoldFloor{0.3F, {0.0F, 2.0F, 0.0F}, {0.0F, 2.0F, 4.0F}}.expect(test::kRougherSteep, 1e-4F);
    GoldFloor{0.2F, {0.0F, 0.5F, 0.0F}, {0.0F, 0.5F, 4.0F}}.expect(test::kSmootherFlat, 1e-4F);
    // Mitsuba multiplies masking and shadowing as if they were independent, 1 / (1 + L)^2 instead of 1 / (1 + 2 L):
    // at 76 degrees L is .03, and that makes it darker by L^2 = .0009.
    GoldFloor{0.3F, {0.0F, 0.5F, 0.0F}, {0.0F, 0.5F, 4.0F}}.expect(test::kRougherFlat, 1.1e-3F);
}

/// A ball of glass, 100 m in radius, before a chart whose red grows with x and whose green grows with y.
Scene glass_ball(float ior) {
    Scene scene;
    scene.background_radiance = vec3(0.2F, 0.4F, 0.6F);
    Material glass = test::white();
    glass.roughness = 0.0F;
    glass.transmission = 1.0F;
    glass.ior = ior;
    glass.thickness_m = 1.0F;
    test::add(scene, make_sphere(100.0F, 512), glass);
    Mesh chart = test::wall({0.0F, 0.0F, -400.0F}, 1000.0F);
    for (const vec3& p : chart.position_m) chart.color.emplace_back(glm::vec2(p) / 2000.0F + 0.5F, 1.0F, 1.0F);
    test::add(scene, std::move(chart), test::unlit());
    return scene;
}

TEST(IndependentRenderer, GlassBallBeforeAChart) {
    TracerOptions options;
    options.bounces = 1;
    options.bounce_bound = 0.0F;
    expect_measured({*test::tracer_of(glass_ball(1.5F), options), {0.0F, 0.0F, 400.0F}}, test::kGlass, 5e-4F);
    expect_measured({*test::tracer_of(glass_ball(1.33F), options), {0.0F, 0.0F, 400.0F}}, test::kWater, 5e-4F);
}

/// Radiance of the sky from a unit direction.
vec3 sky(const vec3& direction) {
    const float sun = std::max(glm::dot(direction, vec3(1.0F, 2.0F, 2.0F) / 3.0F), 0.0F);
    const float window = std::max(glm::dot(direction, vec3(-2.0F, 1.0F, 2.0F) / 3.0F), 0.0F);
    return {0.3F + 0.2F * direction.y + 3.0F * std::pow(sun, 4.0F), 1.0F, 0.1F + 5.0F * std::pow(window, 16.0F)};
}

/// A lat-long map of it, by the directions that scene.h gives.
TextureImage sky_map() {
    constexpr int kHeight = 256;
    constexpr int kWidth = 2 * kHeight;
    std::vector<vec3> texel;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float turn = (static_cast<float>(x) + 0.5F) / kWidth * glm::two_pi<float>();
            const float from_top = (static_cast<float>(y) + 0.5F) / kHeight * glm::pi<float>();
            const float level = std::sin(from_top);
            texel.push_back(sky({-level * std::sin(turn), std::cos(from_top), level * std::cos(turn)}));
        }
    }
    TextureImage image{"sky", kWidth, kHeight, 3, TexelType::f32, false, {}};
    image.texels.resize(texel.size() * sizeof(vec3));
    std::memcpy(image.texels.data(), texel.data(), image.texels.size());
    return image;
}

/// How far reflections of the sky may be from what was measured.
struct ReflectionBounds {
    float lost;  ///< share of the albedo that the measuring renderer may lose; none may be missing here
    /// Of the sky's mean radiance over the lobe, where the sky reaches 3.4 (red) and 5.1 (blue). The tracer reads one
    /// value of a map that was averaged over round lobes; a lobe seen at a slant is longer than wide.
    float radiance;
};

void expect_reflected(const Probe& probe, std::span<const Measured> measured, const ReflectionBounds& bounds) {
    for (const Measured& m : measured) {
        const vec3 found = traced_at(probe, m.point);
        const float noise = 4.0F * m.standard_error;
        EXPECT_GE(found.y, m.radiance.y - noise);
        EXPECT_LE(found.y, m.radiance.y * (1.0F + bounds.lost) + noise);
        EXPECT_NEAR(found.x / found.y, m.radiance.x / m.radiance.y, bounds.radiance + noise) << m.point.x;
        EXPECT_NEAR(found.z / found.y, m.radiance.z / m.radiance.y, bounds.radiance + noise) << m.point.x;
    }
}

TEST(IndependentRenderer, BallsUnderASky) {
    Scene scene;
    scene.images.push_back(sky_map());
    scene.environment.image = 0;
    const auto add_ball = [&](float x, const Material& material) {
        const glm::mat4 place = glm::translate(glm::mat4(1.0F), vec3(x, 0.0F, 0.0F));
        test::add(scene, make_sphere(1.0F, 256), material, place);
    };
    // So far apart that they do not see each other.
    add_ball(-1000.0F, lambertian(0.5F));
    Material metal;
    metal.base_color = glm::vec4(vec3(0.8F), 1.0F);
    metal.roughness = 0.2F;
    add_ball(0.0F, metal);
    metal.roughness = 0.4F;
    add_ball(1000.0F, metal);
    const auto tracer = test::tracer_of(scene);
    expect_measured({*tracer, {500.0F, 0.0F, 4.0F}}, test::kSky, 5e-4F);
    // Nine harmonics leave an error of up to 3.2 % where the light comes from the narrow window, 1 % from the sun.
    expect_measured({*tracer, {-1000.0F, 0.0F, 4.0F}}, test::kMattBall, 0.035F);
    // What a metal reflects of the uniform green is its albedo, of which Mitsuba loses .2 to .5 % at roughness .2 and
    // 2.5 to 7 % at .4 for want of bounces between microfacets. By that the other channels are divided.
    expect_reflected({*tracer, {0.0F, 0.0F, 4.0F}}, test::kSmoothBall, {0.005F, 0.05F});
    expect_reflected({*tracer, {1000.0F, 0.0F, 4.0F}}, test::kRoughBall, {0.07F, 0.18F});
}

}  // namespace
}  // namespace macula
