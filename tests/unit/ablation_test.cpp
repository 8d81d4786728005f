// Switching a model off changes what it says, and nothing else.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "client/present/taa_settings.h"
#include "server/method_parts.h"
#include "server/render/texture_levels.h"
#include "tests/pipeline/ablation.h"
#include "tests/support/small_display.h"
#include "tests/support/texture_image.h"
#include "tests/support/trace_scene.h"

namespace macula::test {
namespace {

using glm::vec3;

double opening_deg(float low, float high) {
    return (std::atan(high) - std::atan(low)) * 180.0 / std::numbers::pi;
}

bool same(const EyeDisplay& a, const EyeDisplay& b) {
    return a.tangents.left == b.tangents.left && a.tangents.right == b.tangents.right &&
           a.tangents.bottom == b.tangents.bottom && a.tangents.top == b.tangents.top &&
           a.head_from_eye.position_m == b.head_from_eye.position_m && a.visible_outline == b.visible_outline;
}

bool same(const kernels::TaaWeights& a, const kernels::TaaWeights& b) {
    return a.traced == b.traced && a.interpolated == b.interpolated && a.limit == b.limit &&
           a.moving_loss == b.moving_loss && a.disparity_px == b.disparity_px && a.knows_motion == b.knows_motion;
}

bool same(const TracerOptions& a, const TracerOptions& b) {
    return a.bounces == b.bounces && a.bounce_bound == b.bounce_bound && a.light_samples == b.light_samples &&
           a.normal_roughness == b.normal_roughness && a.forced_features == b.forced_features;
}

TEST(Ablation, OfNothingOrOfAModelElsewhereChangesNothing) {
    const Display display = small_display();
    for (const std::string& name : ablation_names()) {
        SCOPED_TRACE(name);
        const std::set<std::string> without = {name};
        ASSERT_TRUE(check_ablation(without));
        if (name != "hidden-area") {
            EXPECT_TRUE(same(ablated_display(display, without).eyes[kRightEye], display.eyes[kRightEye]));
        }
        if (name != "hidden-area" && name != "true-tangents") {
            EXPECT_TRUE(same(ablated_sampler_display(display, without).eyes[kLeftEye], display.eyes[kLeftEye]));
        }
        if (name != "hysteresis") {
            EXPECT_EQ(ablated_sampler_options(without).hysteresis, TileSamplerOptions{}.hysteresis);
        }
        if (name != "normal-roughness" && name != "bounce-bound") {
            EXPECT_TRUE(same(ablated_tracer_options(without), {}));
        }
        if (name != "eccentricity-weight") {
            EXPECT_TRUE(same(ablated_taa_weights(default_taa_weights(), without), default_taa_weights()));
        }
    }
}

TEST(Ablation, RefusesAModelThatDoesNotExist) {
    const auto checked = check_ablation({"hysteresis", "hysterics"});
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().code, ErrorCode::option);
    EXPECT_NE(checked.error().message.find("'hysterics'"), std::string::npos) << checked.error().message;
    EXPECT_NE(checked.error().message.find("bounce-bound"), std::string::npos) << checked.error().message;
}

TEST(Ablation, OfTheHiddenAreaShowsAllPixels) {
    const Display display = ablated_display(small_display(), {"hidden-area"});
    for (const Eye eye : {kLeftEye, kRightEye}) {
        const auto hidden = hidden_pixels(display, eye);
        EXPECT_EQ(std::count(hidden.begin(), hidden.end(), 1), 0);
    }
    EXPECT_EQ(ablated_sampler_display(small_display(), {"hidden-area"}).eyes[kLeftEye].visible_outline.size(), 0U);
}

TEST(Ablation, OfTrueTangentsCentresTheSamplersFrustum) {
    const Display display = small_display();
    const Display centred = ablated_sampler_display(display, {"true-tangents"});
    for (const Eye eye : {kLeftEye, kRightEye}) {
        const Tangents& from = display.eyes[eye].tangents;
        const Tangents& to = centred.eyes[eye].tangents;
        EXPECT_EQ(to.left, -to.right);
        EXPECT_EQ(to.bottom, -to.top);
        EXPECT_NEAR(opening_deg(to.left, to.right), opening_deg(from.left, from.right), 1e-4);
        EXPECT_NEAR(opening_deg(to.bottom, to.top), opening_deg(from.bottom, from.top), 1e-4);
        // The same pixels are hidden, but for those whose centres are on the outline to the last digits.
        const auto before = hidden_pixels(display, eye);
        const auto after = hidden_pixels(centred, eye);
        const auto differing =
            std::count_if(before.begin(), before.end(),
                          [&, i = std::size_t{0}](std::uint8_t hidden) mutable { return hidden != after[i++]; });
        EXPECT_LE(differing, 4);
        EXPECT_GT(std::count(before.begin(), before.end(), 1), 1000);
    }
}

/// Levels of the tiles after the gaze went along a path.
std::vector<std::uint8_t> levels_after(const Display& display, const TileSamplerOptions& options,
                                       std::span<const vec3> gaze_path) {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    MeshShelf meshes({}, {});
    const auto sampler = make_sampler(parse_method("27").value(), display, kLeftEye, kTables, meshes, options).value();
    SamplePlan plan;
    for (const vec3& gaze : gaze_path) sampler->plan({glm::normalize(gaze), glm::ivec2(0)}, plan);
    return plan.level;
}

TEST(Ablation, OfHysteresisForgetsWhereTheGazeWas) {
    const Display display = small_display(376, 416);
    const std::array<vec3, 2> path = {vec3(-0.1F, 0.0F, -1.0F), vec3(0.0F, 0.0F, -1.0F)};
    const auto levels = [&](const std::set<std::string>& without, std::size_t from) {
        return levels_after(display, ablated_sampler_options(without), std::span(path).subspan(from));
    };
    EXPECT_EQ(levels({"hysteresis"}, 0), levels({"hysteresis"}, 1));
    EXPECT_NE(levels({}, 0), levels({}, 1));
    EXPECT_EQ(levels({}, 1), levels({"hysteresis"}, 1));
}

TEST(Ablation, OfTheWeightsLeavesTheOthersAsTheyAre) {
    kernels::TaaWeights weights = ablated_taa_weights(default_taa_weights(), {"eccentricity-weight"});
    for (const int rank : {0, 200}) {
        // A settled history takes a tenth of what is new, wherever that comes from.
        const float now = kernels::new_precision(weights, rank, 100, true, false);
        EXPECT_NEAR(now / (now + weights.limit), 0.1F, 1e-6F);
    }
    weights.traced = default_taa_weights().traced;
    weights.interpolated = default_taa_weights().interpolated;
    EXPECT_TRUE(same(weights, default_taa_weights()));

    // The paper's TAA tells neither apart.
    EXPECT_TRUE(same(ablated_taa_weights(paper_taa_weights(), {"eccentricity-weight"}), paper_taa_weights()));
}

constexpr int kSize = 16;
constexpr float kRoughness = 0.4F;

/// Slopes of the bumps below, along both axes.
constexpr float kSlope = 0.3F;

/// A metal wall that fills the picture, lit from the eye's side. With bumps, a normal map turns faster than pixels
/// tell.
Scene metal_wall(bool bumpy, float roughness) {
    Scene scene;
    Mesh mesh = wall(vec3(0.0F, 0.0F, -10.0F), 20.0F);
    mesh.tangent.assign(mesh.position_m.size(), glm::vec4(1.0F, 0.0F, 0.0F, 1.0F));
    Material metal = white();
    metal.metallic = 1.0F;
    metal.roughness = roughness;
    if (bumpy) {
        metal.normal_texture.image = 0;
        metal.normal_texture.uv_scale_rotation = glm::vec4(4000.0F, 0.0F, 0.0F, 4000.0F);
        scene.images.push_back(make_image(8, 8, 3, TexelType::f32, [](int x, int y) {
            const vec3 normal =
                glm::normalize(vec3(x % 2 == 0 ? kSlope : -kSlope, y % 2 == 0 ? kSlope : -kSlope, 1.0F));
            return glm::vec4(normal * 0.5F + 0.5F, 1.0F);
        }));
    }
    Light light;
    light.intensity = vec3(2.0F);
    scene.lights.push_back(light);
    add(scene, std::move(mesh), metal);
    return scene;
}

Samples samples_of(const Tracer& tracer, float footprint_scale = 1.0F, TraceCounts* counts = nullptr) {
    const EyeView view = square_view(kSize);
    const SamplePlan plan = full_plan(kSize, kSize);
    Samples samples;
    samples.keep_radiance = true;
    TraceTask task{&view, &plan, &samples};
    task.footprint_scale = footprint_scale;
    const TraceCounts found = tracer.trace({&task, 1});
    if (counts != nullptr) *counts = found;
    return samples;
}

std::vector<vec3> radiance_of(const Scene& scene, const std::set<std::string>& without) {
    TracerOptions options = ablated_tracer_options(without);
    options.bounces = 0;
    return samples_of(*ablated_tracer(tracer_of(scene, options), without)).radiance;
}

/// rms difference in parts of the rms of `b`.
double difference(const std::vector<vec3>& a, const std::vector<vec3>& b) {
    double apart = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        apart += glm::dot(a[i] - b[i], a[i] - b[i]);
        all += glm::dot(b[i], b[i]);
    }
    return std::sqrt(apart / all);
}

TEST(Ablation, OfNormalRoughnessLosesBumpsThatAreNotResolved) {
    const std::vector<vec3> smooth = radiance_of(metal_wall(false, kRoughness), {});
    const std::vector<vec3> bumpy = radiance_of(metal_wall(true, kRoughness), {});
    const std::vector<vec3> lost = radiance_of(metal_wall(true, kRoughness), {"normal-roughness"});
    // Normals of all texels are one length from their mean, so its length is the cosine of their tilt.
    const float added = lost_variance(1.0F / std::sqrt(1.0F + 2.0F * kSlope * kSlope));
    const float wider = std::pow(std::pow(kRoughness, 4.0F) + added, 0.25F);
    // A byte for each axis tilts the mean normal by up to 1/255; GGX's lobe falls by at most 2 / alpha of itself for
    // each radian.
    constexpr double kTilt = 2.0 / (kRoughness * kRoughness) / 255.0;
    EXPECT_LT(difference(lost, smooth), kTilt);
    EXPECT_LT(difference(bumpy, radiance_of(metal_wall(false, wider), {})), kTilt);
    EXPECT_GT(difference(bumpy, smooth), 0.3);
    EXPECT_EQ(radiance_of(metal_wall(false, kRoughness), {"normal-roughness"}), smooth);
}

TEST(Ablation, OfFootprintMipsReadsTexturesThemselves) {
    const std::shared_ptr<const Tracer> tracer = tracer_of(metal_wall(true, kRoughness));
    const Samples filtered = samples_of(*tracer);
    const Samples unfiltered = samples_of(*ablated_tracer(tracer, {"footprint-mips"}));
    EXPECT_EQ(unfiltered.radiance, samples_of(*tracer, 0.0F).radiance);
    EXPECT_GT(difference(unfiltered.radiance, filtered.radiance), 0.1);
    EXPECT_EQ(unfiltered.inverse_depth_per_m, filtered.inverse_depth_per_m);
    EXPECT_EQ(unfiltered.object_id, filtered.object_id);
    EXPECT_EQ(ablated_tracer(tracer, {"hysteresis"}), tracer);
}

TEST(Ablation, OfTheBounceBoundTracesEveryReflection) {
    // Head-on it reflects .8 % of what comes.
    Scene scene;
    Material varnish = white();
    varnish.roughness = 0.05F;
    varnish.specular = 0.2F;
    add(scene, wall(vec3(0.0F, 0.0F, -1.0F), 2.0F), varnish);
    const auto counts_of = [&](const std::set<std::string>& without) {
        TraceCounts counts;
        samples_of(*tracer_of(scene, ablated_tracer_options(without)), 1.0F, &counts);
        return counts;
    };
    const TraceCounts bounded = counts_of({});
    const TraceCounts all = counts_of({"bounce-bound"});
    EXPECT_EQ(bounded.primary, std::uint64_t{kSize} * kSize);
    EXPECT_EQ(bounded.reflection, 0U);
    EXPECT_EQ(all.primary, bounded.primary);
    EXPECT_EQ(all.reflection, all.primary);
}

}  // namespace
}  // namespace macula::test
