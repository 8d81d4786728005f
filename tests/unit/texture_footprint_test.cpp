// Footprints of rays on textures against the projection itself, and the taps that stand for them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "server/kernels/texture_footprint.h"

namespace macula {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

kernels::Texture texture(int width, int height) {
    return {vec4(1.0F, 0.0F, 0.0F, 1.0F), vec2(0.0F), glm::ivec2(width, height), glm::ivec2(0), 0};
}

/// Texture coordinates where a ray from the origin meets the plane of a triangle.
dvec2 uv_seen(const dvec3& direction, const dvec3 corner[3], const dvec2 uv[3]) {
    const dvec3 e1 = corner[1] - corner[0];
    const dvec3 e2 = corner[2] - corner[0];
    const dvec3 n = glm::cross(e1, e2);
    const dvec3 p = direction * (glm::dot(corner[0], n) / glm::dot(direction, n)) - corner[0];
    const double b1 = glm::dot(glm::cross(p, e2), n) / glm::dot(n, n);
    const double b2 = glm::dot(glm::cross(e1, p), n) / glm::dot(n, n);
    return uv[0] + (uv[1] - uv[0]) * b1 + (uv[2] - uv[0]) * b2;
}

/// Greatest and least length of a a^T + b b^T, as of an ellipse with the conjugate diameters a and b.
dvec2 ellipse_axes(const dvec2& a, const dvec2& b) {
    const double trace = glm::dot(a, a) + glm::dot(b, b);
    const double determinant = a.x * b.y - a.y * b.x;
    const double root = std::sqrt(std::max(0.0, trace * trace / 4.0 - determinant * determinant));
    return {std::sqrt(trace / 2.0 + root), std::sqrt(std::max(0.0, trace / 2.0 - root))};
}

TEST(TextureFootprint, IsTheDerivativeOfTheProjection) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto point = [&] { return dvec3(uniform(random), uniform(random), uniform(random)); };
    int checked = 0;
    while (checked < 300) {
        const dvec3 corner[3] = {point() + dvec3(0, 0, -3), point() + dvec3(0, 0, -3), point() + dvec3(0, 0, -3)};
        const dvec2 uv[3] = {dvec2(point()), dvec2(point()), dvec2(point())};
        const dvec3 centre = (corner[0] + corner[1] + corner[2]) / 3.0;
        const dvec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const dvec3 direction = glm::normalize(centre);
        if (std::abs(glm::dot(glm::normalize(n), direction)) < 0.05 || glm::length(n) < 0.05) continue;
        ++checked;
        // Two rays beside the middle one, perpendicular to it and to each other: their images are conjugate diameters.
        const double step = 1e-6;
        const dvec3 side = glm::normalize(glm::cross(direction, dvec3(0.3, 1.0, 0.1)));
        const dvec3 up = glm::cross(side, direction);
        const dvec2 here = uv_seen(direction, corner, uv);
        const dvec2 da = (uv_seen(direction + side * step, corner, uv) - here) / step;
        const dvec2 db = (uv_seen(direction + up * step, corner, uv) - here) / step;
        const double angle = 0.01;
        const dvec2 wanted = ellipse_axes(da * angle, db * angle);
        const kernels::UvFootprint f = kernels::uv_footprint(
            static_cast<float>(angle * glm::length(centre)), vec3(direction), vec3(corner[1] - corner[0]),
            vec3(corner[2] - corner[0]), vec2(uv[1] - uv[0]), vec2(uv[2] - uv[0]));
        const dvec2 got = ellipse_axes(dvec2(f.across), dvec2(f.along));
        EXPECT_NEAR(got.x, wanted.x, 1e-3 * wanted.x);
        EXPECT_NEAR(got.y, wanted.y, 1e-3 * wanted.x);
    }
}

TEST(TextureFootprint, OfAFloorIsStretchedAwayFromTheEye) {
    // A floor 1 m below the eye, one texture a metre: at the angle a below the horizon, the width w becomes w across
    // and w / sin(a) along.
    for (const float angle : {1.5F, 0.8F, 0.3F, 0.1F, 0.02F}) {
        const vec3 direction(0.0F, -std::sin(angle), -std::cos(angle));
        const kernels::UvFootprint f =
            kernels::uv_footprint(0.01F, direction, vec3(1, 0, 0), vec3(0, 0, -1), vec2(1, 0), vec2(0, 1));
        EXPECT_NEAR(std::abs(f.across.x), 0.01F, 1e-6F);
        EXPECT_NEAR(f.across.y, 0.0F, 1e-6F);
        EXPECT_NEAR(f.along.x, 0.0F, 1e-6F);
        EXPECT_NEAR(std::abs(f.along.y), 0.01F / std::sin(angle), 2e-6F / std::sin(angle));
    }
}

TEST(TextureFootprint, DegenerateTrianglesHaveNone) {
    for (const vec3 e2 : {vec3(0.0F), vec3(2.0F, 0.0F, 0.0F)}) {
        const kernels::UvFootprint f =
            kernels::uv_footprint(0.1F, vec3(0, 0, -1), vec3(1, 0, 0), e2, vec2(1, 0), vec2(0, 1));
        EXPECT_EQ(f.across, vec2(0.0F));
        EXPECT_EQ(f.along, vec2(0.0F));
        EXPECT_EQ(kernels::plan_taps(texture(64, 64), f).count, 1);
    }
}

TEST(TextureFootprint, TrianglesOfAnySizeKeepTheirFootprint) {
    for (const float scale : {1e-6F, 1e-3F, 1.0F, 1e5F}) {
        const kernels::UvFootprint f = kernels::uv_footprint(0.01F * scale, vec3(0, 0, -1), vec3(scale, 0, 0),
                                                             vec3(0, scale, 0), vec2(1, 0), vec2(0, 1));
        EXPECT_NEAR(glm::length(f.across), 0.01F, 1e-5F) << scale;
        EXPECT_NEAR(glm::length(f.along), 0.01F, 1e-5F) << scale;
    }
}

TEST(TapPlan, ReadsTheTextureItselfWhereItIsMagnified) {
    for (const float size : {0.0F, 0.3F, 0.99F}) {
        const kernels::TapPlan plan = kernels::plan_taps(texture(64, 32), {vec2(size / 64, 0), vec2(0, size / 32)});
        EXPECT_EQ(plan.count, 1);
        EXPECT_EQ(plan.level, 0.0F);
    }
}

TEST(TapPlan, TheShorterAxisDecidesTheLevelAndTheLongerOneTheTaps) {
    for (const float minor : {1.0F, 3.0F, 8.0F})
        for (const float ratio : {1.0F, 2.0F, 4.0F, 8.0F, 50.0F})
            for (const float angle : {0.0F, 0.4F, 1.5F, 2.5F}) {
                const vec2 axis(std::cos(angle), std::sin(angle));
                const vec2 other(-axis.y, axis.x);
                // Conjugate diameters of the ellipse that are not its axes.
                const vec2 a = axis * (minor * ratio) * 0.6F + other * minor * 0.8F;
                const vec2 b = axis * (minor * ratio) * -0.8F + other * minor * 0.6F;
                const kernels::TapPlan plan = kernels::plan_taps(texture(256, 256), {a / 256.0F, b / 256.0F});
                const float taps = std::min(ratio, static_cast<float>(kernels::kMaxTaps));
                EXPECT_EQ(plan.count, static_cast<int>(taps));
                EXPECT_NEAR(plan.level, std::log2(minor * ratio / taps), 2e-3F);
                if (plan.count == 1) continue;
                const vec2 step = plan.step * 256.0F;
                EXPECT_NEAR(glm::length(step), minor * ratio / taps, 5e-3F * minor * ratio / taps);
                EXPECT_NEAR(std::abs(glm::dot(glm::normalize(step), axis)), 1.0F, 1e-3F);
                const vec2 last = plan.first + plan.step * static_cast<float>(plan.count - 1);
                EXPECT_LT(glm::length(plan.first + last) * 256.0F, 1e-3F) << "the taps lie around the middle";
            }
}

TEST(TapPlan, FollowsTheTexturesTransformAndShape) {
    kernels::Texture t = texture(512, 64);
    t.uv_scale_rotation = vec4(0.0F, 2.0F, -4.0F, 0.0F);  // u' = -4 v, v' = 2 u
    const kernels::TapPlan plan = kernels::plan_taps(t, {vec2(1.0F / 64, 0), vec2(0, 1.0F / 512)});
    // In texels: 2 down the columns, 4 along the rows.
    EXPECT_EQ(plan.count, 2);
    EXPECT_NEAR(plan.level, 1.0F, 1e-4F);
    EXPECT_NEAR(std::abs(plan.step.x) * 512.0F, 2.0F, 1e-3F);
    EXPECT_NEAR(plan.step.y, 0.0F, 1e-6F);
}

TEST(TapPlan, FootprintsThatAreNoNumbersAreBounded) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {inf, -inf, std::numeric_limits<float>::quiet_NaN(), 1e30F}) {
        const kernels::TapPlan plan = kernels::plan_taps(texture(64, 64), {vec2(bad, 0), vec2(0, bad)});
        EXPECT_GE(plan.count, 1);
        EXPECT_LE(plan.count, kernels::kMaxTaps);
        EXPECT_GE(plan.level, 0.0F);
        EXPECT_LT(plan.level, 100.0F);
        EXPECT_TRUE(std::isfinite(plan.first.x) && std::isfinite(plan.step.y));
    }
}

}  // namespace
}  // namespace macula
