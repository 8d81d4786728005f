#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "tests/support/trace_scene.h"
#include "tests/support/wrong_pixels.h"

namespace macula::test {

/// White without any reflection but the diffuse one, which traces no rays of its own.
inline Material matte() {
    Material material = white();
    material.specular = 0.0F;
    return material;
}

/// A triangle in world space whose corners turn counter-clockwise on its front.
struct SlowTriangle {
    glm::dvec3 a, b, c;
    std::uint32_t object = 0;
};

/// Every triangle of a scene. Corners are the scene's floats where the instance is not placed.
inline std::vector<SlowTriangle> slow_triangles(const Scene& scene) {
    std::vector<SlowTriangle> result;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const bool mirrored = glm::determinant(glm::mat3(instance.world_from_mesh)) < 0.0F;
        const auto world = [&](unsigned k) {
            return glm::dvec3(instance.world_from_mesh * glm::vec4(mesh.position_m[k], 1.0F));
        };
        for (const glm::uvec3& t : mesh.triangle)
            result.push_back({world(t.x), world(mirrored ? t.z : t.y), world(mirrored ? t.y : t.z),
                              static_cast<std::uint32_t>(i + 1)});
    }
    return result;
}

/// What a ray meets first.
struct SlowHit {
    double distance = std::numeric_limits<double>::infinity();  ///< in lengths of the ray's direction
    std::uint32_t object = 0;
    glm::dvec3 normal{};  ///< unit, on the front
    const SlowTriangle* triangle = nullptr;
};

/// Nearest hit of either side in double precision, every triangle asked (Möller and Trumbore, Fast, Minimum Storage
/// Ray-Triangle Intersection, 1997).
inline SlowHit slow_trace(const std::vector<SlowTriangle>& triangles, const glm::dvec3& origin,
                          const glm::dvec3& direction) {
    SlowHit best;
    for (const SlowTriangle& t : triangles) {
        const glm::dvec3 e1 = t.b - t.a;
        const glm::dvec3 e2 = t.c - t.a;
        const glm::dvec3 p = glm::cross(direction, e2);
        const double det = glm::dot(e1, p);
        if (det == 0.0) continue;
        const glm::dvec3 s = origin - t.a;
        const double u = glm::dot(s, p) / det;
        const glm::dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(direction, q) / det;
        const double distance = glm::dot(e2, q) / det;
        if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= 0.0 || distance >= best.distance) continue;
        best = {distance, t.object, glm::normalize(glm::cross(e1, e2)), &t};
    }
    return best;
}

/// How far floats may put a hit off its triangle: some units in the last place of the greatest of its coordinates, of
/// the path to it, and of the triangle's extent across its plane, which is what cancels when the plane's distance is
/// computed. It includes the step by which the tracer lifts shadow rays off the surface.
inline double rounding_m(const SlowHit& hit, const glm::dvec3& point, double path_m) {
    const SlowTriangle& t = *hit.triangle;
    const glm::dvec3 extent = glm::max(glm::max(t.a, t.b), t.c) - glm::min(glm::min(t.a, t.b), t.c);
    const glm::dvec3 size = glm::abs(point);
    return 6e-7 * std::max({size.x, size.y, size.z, path_m, glm::dot(glm::abs(hit.normal), extent)});
}

/// A picture against the slow tracer's.
struct Comparison {
    WrongPixels seen;         ///< another object, or its surface farther off its plane than rounding allows
    WrongPixels shadowed;     ///< lit instead of dark or dark instead of lit, of those that are right otherwise
    int beyond_rounding = 0;  ///< of `shadowed`: not even right for a point within rounding of the hit
    int compared_lit = 0;     ///< of `shadowed`: pixels that should be lit
    void add(const Comparison& other);
};

inline void Comparison::add(const Comparison& other) {
    seen.wrong += other.seen.wrong;
    seen.compared += other.seen.compared;
    shadowed.wrong += other.shadowed.wrong;
    shadowed.compared += other.shadowed.compared;
    beyond_rounding += other.beyond_rounding;
    compared_lit += other.compared_lit;
}

/// Whether the light reaches a point above the surface that a ray met.
inline bool slow_lit(const std::vector<SlowTriangle>& triangles, const Light& light, const SlowHit& hit,
                     const glm::dvec3& point) {
    const bool local = light.kind == LightKind::point;
    const glm::dvec3 to_light = local ? glm::dvec3(light.position_m) - point : -glm::dvec3(light.direction);
    const double far = local ? 1.0 : std::numeric_limits<double>::infinity();
    return glm::dot(to_light, hit.normal) > 0.0 && slow_trace(triangles, point, to_light).distance >= far;
}

/// The same in one of the places, above the surface, where rounding may put the point.
inline bool may_be(bool lit, const std::vector<SlowTriangle>& triangles, const Light& light, const SlowHit& hit,
                   const glm::dvec3& point, double rounding) {
    const glm::dvec3 a = glm::normalize(glm::cross(hit.normal, glm::dvec3(0.36, 0.48, 0.8)));
    const glm::dvec3 b = glm::cross(hit.normal, a);
    for (const glm::dvec3& across : {a, -a, b, -b})
        if (slow_lit(triangles, light, hit, point + (hit.normal + across) * rounding) == lit) return true;
    return false;
}

/// Traces a scene of flat surfaces with one light, and compares every pixel.
inline Comparison compare_with_slow(const Scene& scene, const EyeView& view) {
    const Traced traced = trace(scene, view);
    const std::vector<SlowTriangle> triangles = slow_triangles(scene);
    const Light& light = scene.lights.front();
    const glm::dvec3 origin(view.world_from_eye.position_m);
    Comparison result;
    for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) {
            const glm::dvec3 direction(view.world_from_eye.direction(glm::vec3(traced.tangents(x, y), -1.0F)));
            const SlowHit hit = slow_trace(triangles, origin, direction);
            if (hit.object == 0) {
                result.seen.count(traced.object(x, y) != 0);
                continue;
            }
            const glm::dvec3 point = origin + direction * hit.distance;
            const double path = glm::length(point - origin);
            const double off_plane =
                std::abs(1.0 / traced.inverse_depth(x, y) - hit.distance) * std::abs(glm::dot(direction, hit.normal));
            const double rounding = rounding_m(hit, point, path);
            const bool same = traced.object(x, y) == hit.object && off_plane <= rounding;
            result.seen.count(!same);
            if (!same) continue;
            const bool lit = traced.radiance(x, y).x > 0.0F;
            // Doubles, too, must leave the surface, by much less than floats.
            const bool wrong = lit != slow_lit(triangles, light, hit, point + hit.normal * (1e-11 * path));
            result.shadowed.count(wrong);
            result.compared_lit += lit != wrong ? 1 : 0;
            if (wrong && !may_be(lit, triangles, light, hit, point, rounding)) ++result.beyond_rounding;
        }
    }
    return result;
}

/// Traces a scene in which nothing shades anything: pixels that shadow rays darken nevertheless.
inline WrongPixels falsely_shaded(Scene scene, const EyeView& view) {
    const Traced shaded = trace(scene, view);
    for (Light& light : scene.lights) light.casts_shadow = false;
    const Traced open = trace(scene, view);
    WrongPixels result;
    for (std::size_t i = 0; i < open.samples.radiance.size(); ++i)
        if (open.samples.object_id[i] != 0) result.count(shaded.samples.radiance[i] != open.samples.radiance[i]);
    return result;
}

}  // namespace macula::test
