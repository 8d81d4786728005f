// The tracer against a slow one of a few lines: every triangle, in double precision, one ray at a time.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec3;

struct Corner3 {
    dvec3 a, b, c;
    std::uint32_t object;
};

std::vector<Corner3> world_triangles(const Scene& scene) {
    std::vector<Corner3> result;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const bool mirrored = glm::determinant(glm::mat3(instance.world_from_mesh)) < 0.0F;
        const auto world = [&](unsigned k) {
            return dvec3(instance.world_from_mesh * glm::vec4(mesh.position_m[k], 1.0F));
        };
        for (const glm::uvec3& t : mesh.triangle)
            result.push_back({world(t.x), world(mirrored ? t.z : t.y), world(mirrored ? t.y : t.z),
                              static_cast<std::uint32_t>(i + 1)});
    }
    return result;
}

struct SlowHit {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t object = 0;
    dvec3 normal{};
    double margin = 1.0;  ///< how surely the ray decides between this and anything else, 0..1
};

/// Nearest front side along the ray, by Möller and Trumbore's formulas.
SlowHit slow_trace(const std::vector<Corner3>& triangles, const dvec3& origin, const dvec3& direction) {
    SlowHit best;
    double margin = 1.0;
    for (const Corner3& t : triangles) {
        const dvec3 e1 = t.b - t.a;
        const dvec3 e2 = t.c - t.a;
        const dvec3 p = glm::cross(direction, e2);
        const double det = glm::dot(e1, p);
        const dvec3 s = origin - t.a;
        const double u = glm::dot(s, p) / det;
        const dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(direction, q) / det;
        const double distance = glm::dot(e2, q) / det;
        if (!(distance > 1e-6) || det == 0.0) continue;
        const double inside = std::min({u, v, 1.0 - u - v});
        const double facing = std::abs(det) / (glm::length(glm::cross(e1, e2)) * glm::length(direction));
        margin = std::min({margin, std::abs(inside), facing});
        if (inside < 0.0 || det < 0.0) continue;
        margin = std::min(margin, std::abs(distance - best.distance));
        if (distance < best.distance) best = {distance, t.object, glm::normalize(glm::cross(e1, e2)), 1.0};
    }
    best.margin = margin;
    return best;
}

/// Random boxes, balls and tori, some mirrored and stretched, with hardly any two alike.
Scene random_scene(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
    const auto vector = [&] { return vec3(unit(random), unit(random), unit(random)); };
    Scene scene;
    for (int i = 0; i < 12; ++i) {
        Mesh mesh = i % 3 == 0 ? make_box(vec3(0.7F) + 0.5F * vector()) : make_sphere(0.5F, i % 3 == 1 ? 8 : 13);
        const glm::quat turn = glm::normalize(glm::quat(unit(random), unit(random), unit(random), unit(random) + 2.0F));
        glm::mat4 place =
            glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -4.0F) + 2.0F * vector()) * glm::mat4_cast(turn);
        place = glm::scale(place, vec3(1.0F) + 0.4F * vector());
        if (i % 2 == 0) place = glm::scale(place, vec3(-1.0F, 1.0F, 1.0F));
        test::add(scene, std::move(mesh), test::white(), place);
    }
    return scene;
}

TEST(TracerAgainstBruteForce, SeesTheSameAndShadesTheSame) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 random(seed);
        Scene scene = random_scene(random);
        Light lamp{.kind = LightKind::point, .position_m = vec3(1.0F, 3.0F, 1.0F), .intensity = vec3(4.0F)};
        scene.lights.push_back(lamp);
        EyeView view = test::square_view(48);
        view.world_from_eye.orientation = glm::angleAxis(0.1F * static_cast<float>(seed), vec3(0.0F, 0.0F, 1.0F));
        const test::Traced traced = test::trace(scene, view);
        const std::vector<Corner3> triangles = world_triangles(scene);
        const dvec3 origin(view.world_from_eye.position_m);
        int checked = 0;
        int shadows = 0;
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
                const dvec3 direction(view.world_from_eye.direction(vec3(traced.tangents(x, y), -1.0F)));
                const SlowHit hit = slow_trace(triangles, origin, direction);
                if (hit.margin < 1e-4) continue;  // too near an edge for floats to decide
                ++checked;
                ASSERT_EQ(traced.object(x, y), hit.object) << x << ", " << y;
                ASSERT_NEAR(traced.inverse_depth(x, y), 1.0 / hit.distance, 1e-5) << x << ", " << y;
                if (hit.object == 0) continue;
                const dvec3 point = origin + direction * hit.distance + hit.normal * 1e-5;
                const dvec3 to_light = dvec3(lamp.position_m) - point;
                const double facing = glm::dot(glm::normalize(to_light), hit.normal);
                const SlowHit blocker = slow_trace(triangles, point, to_light);
                if (blocker.margin < 1e-3 || std::abs(facing) < 1e-3) continue;
                const bool lit = facing > 0.0 && blocker.distance > 1.0;
                // Interpolated normals may turn away from a light that the flat surface sees, but not the reverse.
                if (!lit) {
                    ++shadows;
                    ASSERT_EQ(traced.radiance(x, y), vec3(0.0F)) << x << ", " << y;
                } else if (facing > 0.5) {
                    ASSERT_GT(traced.radiance(x, y).x, 0.0F) << x << ", " << y;
                }
            }
        }
        EXPECT_GT(checked, 1500);
        EXPECT_GT(shadows, 20);
    }
}

}  // namespace
}  // namespace macula
