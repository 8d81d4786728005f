#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scenes/scene.h"

namespace macula::test {

/// What a ray sees, as the slow tracer finds it.
struct SlowSight {
    glm::dvec3 radiance{};
    glm::dvec3 open{};    ///< the same if nothing stood in the way of any light: what tolerances are shares of
    double margin = 1.0;  ///< how far, in barycentric coordinates, the path keeps from any edge; 0..1
};

/// A recursive tracer of a few lines: one ray at a time, every triangle, double precision, formulas of its own. Knows
/// flat surfaces that are unlit; perfectly smooth metals (Schlick's reflectance); smooth volumes of clear glass
/// (Fresnel and Snell); otherwise Lambert's (a Material of specular 0); with vertex colours, factors and blending, no
/// textures. Lights are points, cones, directions and rectangles, the latter integrated on a fixed grid.
class SlowRadiance {
public:
    /// A rectangle's grid has `light_side`^2 points. The scene outlives this.
    SlowRadiance(const Scene& scene, int light_side);

    /// `direction` has any length. Reflections take one of `bounces`, unless total; what goes through, past or is
    /// totally reflected takes one of `layers`. Paths end in black.
    [[nodiscard]] SlowSight along(const glm::dvec3& origin, const glm::dvec3& direction, int bounces,
                                  int layers = 10) const;

private:
    struct Triangle {
        glm::dvec3 a, b, c;
        glm::dvec3 normal;  ///< unit, of the front
        std::array<glm::dvec4, 3> color;
        const Material* material;
    };
    struct Hit {
        double distance = std::numeric_limits<double>::infinity();
        const Triangle* triangle = nullptr;
        glm::dvec4 color{};
    };
    /// Where a line crosses a triangle's plane.
    struct Crossing {
        double distance = -1.0;
        double u = 0.0;
        double v = 0.0;
        [[nodiscard]] double inside() const { return std::min({u, v, 1.0 - u - v}); }
    };

    [[nodiscard]] static Crossing cross(const Triangle& t, const glm::dvec3& origin, const glm::dvec3& direction);
    [[nodiscard]] static glm::dvec4 color_at(const Triangle& t, const Crossing& c) {
        return t.color[0] * (1.0 - c.u - c.v) + t.color[1] * c.u + t.color[2] * c.v;
    }
    [[nodiscard]] static bool is_glass(const Material& m) { return m.transmission > 0.0F; }
    /// Exact unpolarised reflectance by way of both angles; 1 under total reflection. `eta` is the index behind the
    /// interface over that before it.
    [[nodiscard]] static double fresnel(double cosine, double eta);

    [[nodiscard]] Hit nearest(const glm::dvec3& origin, const glm::dvec3& direction, double& margin) const;
    /// Share of light that arrives along `way`.
    [[nodiscard]] double passes(const glm::dvec3& point, const glm::dvec3& way, double far, double& margin) const;
    [[nodiscard]] SlowSight through_glass(const Hit& hit, const glm::dvec3& point, const glm::dvec3& direction,
                                          int bounces, int layers) const;
    [[nodiscard]] SlowSight lit(const Hit& hit, const glm::dvec3& point) const;
    void add_light(const Light& light, const glm::dvec3& point, const glm::dvec3& normal, SlowSight& irradiance) const;

    const Scene& scene_;
    int light_side_;
    std::vector<Triangle> triangles_;
};

inline SlowRadiance::SlowRadiance(const Scene& scene, int light_side) : scene_(scene), light_side_(light_side) {
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
        const glm::dmat4 world_from_mesh(instance.world_from_mesh);
        const auto place = [&](unsigned k) {
            return glm::dvec3(world_from_mesh * glm::dvec4(glm::dvec3(mesh.position_m[k]), 1.0));
        };
        const auto color = [&](unsigned k) {
            return glm::dvec4(material.base_color) * (mesh.color.empty() ? glm::dvec4(1.0) : glm::dvec4(mesh.color[k]));
        };
        const double side = glm::determinant(glm::dmat3(world_from_mesh)) < 0.0 ? -1.0 : 1.0;
        for (const glm::uvec3& t : mesh.triangle) {
            const glm::dvec3 a = place(t.x);
            const glm::dvec3 b = place(t.y);
            const glm::dvec3 c = place(t.z);
            triangles_.push_back({a,
                                  b,
                                  c,
                                  glm::normalize(glm::cross(b - a, c - a)) * side,
                                  {color(t.x), color(t.y), color(t.z)},
                                  &material});
        }
    }
}

inline SlowRadiance::Crossing SlowRadiance::cross(const Triangle& t, const glm::dvec3& origin,
                                                  const glm::dvec3& direction) {
    const glm::dvec3 e1 = t.b - t.a;
    const glm::dvec3 e2 = t.c - t.a;
    const glm::dvec3 p = glm::cross(direction, e2);
    const double det = glm::dot(e1, p);
    if (det == 0.0) return {};
    const glm::dvec3 s = origin - t.a;
    const glm::dvec3 q = glm::cross(s, e1);
    return {glm::dot(e2, q) / det, glm::dot(s, p) / det, glm::dot(direction, q) / det};
}

inline double SlowRadiance::fresnel(double cosine, double eta) {
    const double sine_behind_sq = (1.0 - cosine * cosine) / (eta * eta);
    if (sine_behind_sq >= 1.0) return 1.0;
    const double behind = std::sqrt(1.0 - sine_behind_sq);
    const double s = (cosine - eta * behind) / (cosine + eta * behind);
    const double p = (eta * cosine - behind) / (eta * cosine + behind);
    return 0.5 * (s * s + p * p);
}

inline SlowRadiance::Hit SlowRadiance::nearest(const glm::dvec3& origin, const glm::dvec3& direction,
                                               double& margin) const {
    Hit best;
    for (const Triangle& t : triangles_) {
        const bool both_sides = t.material->double_sided || is_glass(*t.material);
        if (!both_sides && glm::dot(t.normal, direction) >= 0.0) continue;
        const Crossing c = cross(t, origin, direction);
        if (c.distance <= 0.0) continue;
        margin = std::min(margin, std::abs(c.inside()));
        if (c.inside() < 0.0) continue;
        margin = std::min(margin, std::abs(c.distance - best.distance));
        if (c.distance < best.distance) best = {c.distance, &t, color_at(t, c)};
    }
    return best;
}

inline double SlowRadiance::passes(const glm::dvec3& point, const glm::dvec3& way, double far, double& margin) const {
    double share = 1.0;
    for (const Triangle& t : triangles_) {
        const Crossing c = cross(t, point, way);
        if (c.distance <= 0.0 || c.distance >= far) continue;
        margin = std::min(margin, std::abs(c.inside()));
        if (c.inside() < 0.0) continue;
        const Material& m = *t.material;
        if (is_glass(m)) {
            share *= 1.0 - fresnel(std::abs(glm::dot(t.normal, glm::normalize(way))), static_cast<double>(m.ior));
        } else {
            share *= m.alpha_mode == AlphaMode::blend ? 1.0 - color_at(t, c).w : 0.0;
        }
        if (share == 0.0) return 0.0;
    }
    return share;
}

inline SlowSight SlowRadiance::along(const glm::dvec3& origin, const glm::dvec3& any_direction, int bounces,
                                     int layers) const {
    const glm::dvec3 direction = glm::normalize(any_direction);
    SlowSight sight;
    const Hit hit = nearest(origin, direction, sight.margin);
    const auto add = [&sight](const SlowSight& more, const glm::dvec3& share) {
        sight.radiance += more.radiance * share;
        sight.open += more.open * share;
        sight.margin = std::min(sight.margin, more.margin);
    };
    if (hit.triangle == nullptr) {
        sight.radiance = sight.open = glm::dvec3(scene_.background_radiance);
        return sight;
    }
    const Material& m = *hit.triangle->material;
    const glm::dvec3 point = origin + direction * hit.distance;
    const glm::dvec3 normal = hit.triangle->normal * (glm::dot(hit.triangle->normal, direction) > 0.0 ? -1.0 : 1.0);
    constexpr double kLift = 1e-9;
    const double coverage = m.alpha_mode == AlphaMode::blend ? hit.color.w : 1.0;
    if (coverage < 1.0 && layers > 0)
        add(along(point - normal * kLift, direction, bounces, layers - 1), glm::dvec3(1.0 - coverage));
    if (m.unlit) {
        add({glm::dvec3(hit.color), glm::dvec3(hit.color)}, glm::dvec3(coverage));
        return sight;
    }
    add({glm::dvec3(m.emissive), glm::dvec3(m.emissive)}, glm::dvec3(coverage));
    if (is_glass(m)) {
        add(through_glass(hit, point, direction, bounces, layers), glm::dvec3(coverage));
    } else if (m.metallic > 0.0F) {
        const double cosine = -glm::dot(normal, direction);
        const glm::dvec3 reflectance =
            glm::dvec3(hit.color) + (1.0 - glm::dvec3(hit.color)) * std::pow(1.0 - cosine, 5.0);
        if (bounces > 0)
            add(along(point + normal * kLift, glm::reflect(direction, normal), bounces - 1, layers),
                reflectance * coverage);
    } else {
        add(lit(hit, point + normal * kLift), glm::dvec3(hit.color) * (coverage * std::numbers::inv_pi));
    }
    return sight;
}

inline SlowSight SlowRadiance::through_glass(const Hit& hit, const glm::dvec3& point, const glm::dvec3& direction,
                                             int bounces, int layers) const {
    const bool leaves = glm::dot(hit.triangle->normal, direction) > 0.0;
    const glm::dvec3 normal = hit.triangle->normal * (leaves ? -1.0 : 1.0);
    const double ior = static_cast<double>(hit.triangle->material->ior);
    const double eta = leaves ? 1.0 / ior : ior;
    const double reflectance = fresnel(-glm::dot(normal, direction), eta);
    const bool total = reflectance >= 1.0;
    constexpr double kLift = 1e-9;
    SlowSight sight;
    if (layers > 0 && (total || bounces > 0)) {
        const SlowSight mirrored = along(point + normal * kLift, glm::reflect(direction, normal),
                                         total ? bounces : bounces - 1, total ? layers - 1 : layers);
        sight = {mirrored.radiance * reflectance, mirrored.open * reflectance, mirrored.margin};
    }
    if (total || layers == 0) return sight;
    const SlowSight behind =
        along(point - normal * kLift, glm::refract(direction, normal, 1.0 / eta), bounces, layers - 1);
    sight.radiance += behind.radiance * (1.0 - reflectance);
    sight.open += behind.open * (1.0 - reflectance);
    sight.margin = std::min(sight.margin, behind.margin);
    return sight;
}

/// Irradiance.
inline SlowSight SlowRadiance::lit(const Hit& hit, const glm::dvec3& point) const {
    SlowSight irradiance;
    // The point lies on the side from which the surface is seen.
    const double side = glm::dot(hit.triangle->normal, point - hit.triangle->a) < 0.0 ? -1.0 : 1.0;
    for (const Light& light : scene_.lights) add_light(light, point, hit.triangle->normal * side, irradiance);
    return irradiance;
}

/// Falloffs of KHR_lights_punctual.
inline void SlowRadiance::add_light(const Light& light, const glm::dvec3& point, const glm::dvec3& normal,
                                    SlowSight& irradiance) const {
    const glm::dvec3 direction(light.direction);
    const auto add = [&](const glm::dvec3& way, double far, double weight, double& margin) {
        const double facing = glm::dot(glm::normalize(way), normal);
        if (facing <= 0.0 || weight <= 0.0) return;
        const glm::dvec3 open = glm::dvec3(light.intensity) * (weight * facing);
        irradiance.open += open;
        irradiance.radiance += light.casts_shadow ? open * passes(point, way, far, margin) : open;
    };
    if (light.kind == LightKind::directional) {
        add(-direction, std::numeric_limits<double>::infinity(), 1.0, irradiance.margin);
        return;
    }
    const glm::dvec3 to_center = glm::dvec3(light.position_m) - point;
    if (light.kind == LightKind::rectangle) {
        const glm::dvec3 u(light.half_u_m);
        const glm::dvec3 v(light.half_v_m);
        const double area = 4.0 * glm::length(glm::cross(u, v));
        double unused = 1.0;  // shadows have no edges
        for (int i = 0; i < light_side_ * light_side_; ++i) {
            const double x = (2.0 * (i % light_side_) + 1.0) / light_side_ - 1.0;
            const double y = (2.0 * (i / light_side_) + 1.0) / light_side_ - 1.0;
            const glm::dvec3 way = to_center + u * x + v * y;
            const double distance_sq = glm::dot(way, way);
            const double cosine = -glm::dot(way, direction) / std::sqrt(distance_sq);
            add(way, 0.999, area * cosine / (distance_sq * light_side_ * light_side_), unused);
        }
        return;
    }
    const double distance = glm::length(to_center);
    const double range = static_cast<double>(light.range_m);
    const double window = range > 0.0 ? std::clamp(1.0 - std::pow(distance / range, 4.0), 0.0, 1.0) : 1.0;
    double cone = 1.0;
    if (light.kind == LightKind::spot) {
        const double outer = static_cast<double>(light.spot_cos_outer);
        const double inner = static_cast<double>(light.spot_cos_inner);
        const double ramp =
            std::clamp((-glm::dot(to_center, direction) / distance - outer) / (inner - outer), 0.0, 1.0);
        cone = ramp * ramp;
    }
    add(to_center, 1.0, window * cone / (distance * distance), irradiance.margin);
}

}  // namespace macula::test
