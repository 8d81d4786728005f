// Light through glass and coverage, against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

Material clear_glass(float ior) {
    Material material = test::white();
    material.roughness = 0.0F;
    material.transmission = 1.0F;
    material.ior = ior;
    material.thickness_m = 1.0F;
    return material;
}

/// Unlit colour that says where on a wall a point lies: red is x over 20 m.
Mesh chart(const vec3& centre) {
    Mesh mesh = test::wall(centre, 10.0F);
    for (const vec3& p : mesh.position_m) mesh.color.emplace_back(p.x / 20.0F + 0.5F, p.y / 20.0F + 0.5F, 1.0F, 1.0F);
    return mesh;
}

/// Box whose faces lie at +-half around the centre.
glm::mat4 around(const vec3& centre, float height) {
    return glm::translate(glm::mat4(1.0F), centre - vec3(0.0F, 0.5F * height, 0.0F));
}

/// Exact unpolarised reflectance (Fresnel's equations by way of both angles).
double fresnel(double cosine, double eta) {
    const double behind = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
    const double s = (cosine - eta * behind) / (cosine + eta * behind);
    const double p = (eta * cosine - behind) / (eta * cosine + behind);
    return 0.5 * (s * s + p * p);
}

TEST(GlassSlab, ShiftsRaysInParallelAndDimsThemByFresnel) {
    constexpr float kIor = 1.5F;
    Scene scene;
    test::add(scene, make_box({30.0F, 30.0F, 0.8F}), clear_glass(kIor), around({0.0F, 0.0F, -2.0F}, 30.0F));
    test::add(scene, chart({0.0F, 0.0F, -4.0F}), test::unlit());
    TracerOptions options;
    options.bounces = 0;  // nothing but what goes through
    options.bounce_bound = 0.0F;
    TraceCounts counts;
    const test::Traced traced = test::trace(scene, test::square_view(33), options, 0.0, &counts);
    EXPECT_EQ(counts.transmission, 2U * 33U * 33U);
    for (int x = 0; x < 33; x += 4) {
        const double tangent = traced.tangents(x, 16).x;
        const double cosine = 1.0 / std::hypot(1.0, tangent);
        const double sine_in = tangent * cosine / kIor;
        const double tangent_in = sine_in / std::sqrt(1.0 - sine_in * sine_in);
        const double seen = tangent * (4.0 - 0.8) + tangent_in * 0.8;
        const vec3 radiance = traced.radiance(x, 16);
        EXPECT_NEAR(radiance.x / radiance.z, seen / 20.0 + 0.5, 1e-4);
        EXPECT_NEAR(radiance.z, std::pow(1.0 - fresnel(cosine, kIor), 2.0), 1e-3);
        const double path = (4.0 - 0.8) / cosine + 0.8 * std::hypot(1.0, tangent_in);
        EXPECT_NEAR(traced.image_inverse_depth(x, 16), 1.0 / (path * cosine), 1e-4);
    }
}

TEST(GlassSlab, AbsorbsByBeersLaw) {
    Scene scene;
    Material material = clear_glass(1.0F);  // bends and reflects nothing
    material.attenuation_distance_m = 0.5F;
    material.attenuation_color = vec3(0.5F, 0.8F, 1.0F);
    test::add(scene, make_box({30.0F, 30.0F, 0.8F}), material, around({0.0F, 0.0F, -2.0F}, 30.0F));
    scene.background_radiance = vec3(1.0F);
    const test::Traced traced = test::trace(scene, test::square_view(9));
    for (int x = 0; x < 9; ++x) {
        const double way = 0.8 * std::hypot(1.0, traced.tangents(x, 4).x);
        EXPECT_NEAR(traced.radiance(x, 4).x, std::pow(0.5, way / 0.5), 1e-3);
        EXPECT_NEAR(traced.radiance(x, 4).y, std::pow(0.8, way / 0.5), 1e-3);
        EXPECT_NEAR(traced.radiance(x, 4).z, 1.0, 1e-3);
    }
}

TEST(GlassSlab, AbsorbsAlsoFromAnEyeInsideAndBeforeAnObjectInside) {
    Scene scene;
    Material material = clear_glass(1.0F);
    material.attenuation_distance_m = 1.0F;
    material.attenuation_color = vec3(0.5F);
    test::add(scene, make_box({30.0F, 30.0F, 4.0F}), material, around({0.0F, 0.0F, -3.0F}, 30.0F));
    scene.background_radiance = vec3(1.0F);
    // From the middle, 2 m before the far face.
    EXPECT_NEAR(test::trace(scene, test::square_view(1, {0.0F, 0.0F, -3.0F})).radiance(0, 0).x, 0.25F, 1e-3F);
    // From before the glass a white wall 1.5 m inside.
    test::add(scene, test::wall({0.0F, 0.0F, -2.5F}, 10.0F), test::unlit());
    EXPECT_NEAR(test::trace(scene, test::square_view(1)).radiance(0, 0).x, std::pow(0.5F, 1.5F), 1e-3F);
}

TEST(GlassPrism, ReflectsTotallyBeyondTheCriticalAngle) {
    // A box turned by 45 degrees and seen along -Z has no such face, but its side faces do: a ray that enters through
    // the front meets them at an angle whose sine in glass is cos(asin(sin(a) / n)), for n = 1.5 always beyond 1 / n.
    Scene scene;
    scene.background_radiance = vec3(1.0F);
    test::add(scene, make_box({1.0F, 30.0F, 10.0F}), clear_glass(1.5F), around({0.0F, 0.0F, -7.0F}, 30.0F));
    TracerOptions options;
    options.bounces = 0;
    options.bounce_bound = 0.0F;
    EyeView view = test::square_view(33);
    view.tangents = {-0.24F, 0.24F, -0.01F, 0.01F};
    const test::Traced traced = test::trace(scene, view, options);
    for (int x = 0; x < 33; ++x) {
        const double tangent = std::abs(traced.tangents(x, 16).x);
        if (2.0 * tangent > 0.499) continue;  // beside the front
        const double cosine = 1.0 / std::hypot(1.0, tangent);
        // Total reflection loses nothing; only front and back take their share.
        EXPECT_NEAR(traced.radiance(x, 16).x, std::pow(1.0 - fresnel(cosine, 1.5), 2.0), 2e-3) << x;
    }
}

TEST(GlassPane, ThinWallsDoNotBendAndTintOnce) {
    Scene scene;
    Material pane = clear_glass(1.5F);
    pane.thickness_m = 0.0F;
    pane.base_color = glm::vec4(0.5F, 1.0F, 1.0F, 1.0F);
    test::add(scene, test::wall({0.0F, 0.0F, -1.0F}, 5.0F), pane);
    test::add(scene, chart({0.0F, 0.0F, -4.0F}), test::unlit());
    TracerOptions options;
    options.bounces = 0;
    const test::Traced traced = test::trace(scene, test::square_view(33), options);
    for (int x = 0; x < 33; x += 4) {
        const double tangent = traced.tangents(x, 16).x;
        const double r = fresnel(1.0 / std::hypot(1.0, tangent), 1.5);
        const vec3 radiance = traced.radiance(x, 16);
        EXPECT_NEAR(radiance.z, (1.0 - r) / (1.0 + r), 1e-3);  // both faces, with what goes to and fro between them
        EXPECT_NEAR(radiance.x / radiance.z, 0.5 * (tangent * 4.0 / 20.0 + 0.5), 1e-4);
    }
}

Material film(const vec3& color, float alpha) {
    Material material = test::unlit(glm::vec4(color, alpha));
    material.alpha_mode = AlphaMode::blend;
    return material;
}

TEST(Coverage, LayersCoverEachOtherInTheirOrder) {
    const std::array<vec3, 5> color{vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 1, 0), vec3(0, 1, 1)};
    const std::array<float, 5> alpha{0.5F, 0.3F, 0.7F, 0.2F, 0.4F};
    const vec3 background(0.3F, 0.6F, 0.9F);
    vec3 expected = background;
    Scene scene;
    scene.background_radiance = background;
    for (const std::size_t i : {3U, 0U, 4U, 2U, 1U})  // not in their order
        test::add(scene, test::wall({0.0F, 0.0F, -1.0F - static_cast<float>(i)}, 9.0F), film(color[i], alpha[i]));
    for (std::size_t i = 5; i-- > 0;) expected = glm::mix(expected, color[i], alpha[i]);
    TracerOptions options;
    options.bounce_bound = 0.0F;
    const test::Traced traced = test::trace(scene, test::square_view(16), options);
    for (int i = 0; i < 16; ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(traced.radiance(i, i)[c], expected[c], 1e-5F);
    }
    EXPECT_EQ(traced.object(3, 3), 2U);  // the first surface, which was added second
}

TEST(Coverage, BeyondTheBoundOfLayersIsWhatSurrounds) {
    Scene scene;
    scene.background_radiance = vec3(1.0F);
    scene.ambient_radiance = vec3(0.0F, 0.5F, 0.0F);
    constexpr int kLayers = 20;
    for (int i = 0; i < kLayers; ++i)
        test::add(scene, test::wall({0.0F, 0.0F, -1.0F - 0.1F * static_cast<float>(i)}, 9.0F), film(vec3(0.0F), 0.1F));
    TracerOptions options;
    options.bounce_bound = 0.0F;
    TraceCounts counts;
    const test::Traced traced = test::trace(scene, test::square_view(1), options, 0.0, &counts);
    EXPECT_EQ(counts.transmission, 10U);
    EXPECT_NEAR(traced.radiance(0, 0).x, 0.0F, 1e-5F);
    EXPECT_NEAR(traced.radiance(0, 0).y, 0.5F * std::pow(0.9F, 11.0F), 1e-4F);
}

TEST(ColoredShadow, CoverageAndGlassTakeTheirShare) {
    const auto lit = [](const Material* between) {
        Scene scene;
        scene.lights.emplace_back();  // shines along -Z
        test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 8.0F), test::white());
        if (between != nullptr) test::add(scene, test::wall({0.0F, 0.0F, 1.0F}, 8.0F), *between);
        return test::trace(scene, test::square_view(4)).radiance(1, 2);
    };
    const vec3 free = lit(nullptr);
    const Material half = film(vec3(1.0F), 0.25F);
    EXPECT_NEAR(lit(&half).x, 0.75F * free.x, 1e-5F);
    Material pane = clear_glass(1.5F);
    pane.thickness_m = 0.0F;
    pane.base_color = glm::vec4(0.2F, 0.4F, 1.0F, 1.0F);
    const float passes = (1.0F - 0.04F) / (1.0F + 0.04F);
    EXPECT_NEAR(lit(&pane).x, 0.2F * passes * free.x, 1e-5F);
    EXPECT_NEAR(lit(&pane).z, passes * free.z, 1e-5F);
}

TEST(ColoredShadow, VolumesAbsorbByTheWayThroughThem) {
    Scene scene;
    scene.lights.emplace_back();
    Material material = clear_glass(1.0F);
    material.attenuation_distance_m = 1.0F;
    material.attenuation_color = vec3(0.25F, 0.5F, 1.0F);
    test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 8.0F), test::white());
    const vec3 free = test::trace(scene, test::square_view(4)).radiance(1, 2);
    test::add(scene, make_box({20.0F, 20.0F, 1.5F}), material, around({0.0F, 0.0F, 5.0F}, 20.0F));
    const vec3 shaded = test::trace(scene, test::square_view(4)).radiance(1, 2);
    EXPECT_NEAR(shaded.x / free.x, std::pow(0.25F, 1.5F), 1e-3F);
    EXPECT_NEAR(shaded.y / free.y, std::pow(0.5F, 1.5F), 1e-3F);
    EXPECT_NEAR(shaded.z / free.z, 1.0F, 1e-3F);
}

}  // namespace
}  // namespace macula
