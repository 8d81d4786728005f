#pragma once

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace macula::test {

/// Unit vector in the plane of incidence of a surface whose normal is +Z.
inline glm::vec3 direction_at(double cosine, double phi = 0.0) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// Integral of `f(light)` over the directions of the upper hemisphere, for an f that is symmetric about the plane of
/// incidence of `view` (the xz plane) and may peak where a mirror in the xy plane reflects to. Midpoint rule in polar
/// coordinates about that direction, whose polar angle is the cube of what is divided evenly: the first ring of 240 has
/// a radius of 3e-8 rad; azimuths are dense about the plane of incidence, across which lobes at grazing angles are
/// narrow. So lobes of any roughness from .045 are resolved.
template <class F>
double integrate_over_lights(const glm::vec3& view, F&& f, int rings = 240, int sectors = 120) {
    const glm::dvec3 axis(-view.x, 0.0, view.z);
    const glm::dvec3 side(axis.z, 0.0, -axis.x);
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double s = (i + 0.5) / rings;
        const double theta = std::numbers::pi * s * s * s;
        const double area = std::sin(theta) * 3.0 * std::numbers::pi * s * s / rings * 2.0 * std::numbers::pi / sectors;
        for (int j = 0; j < sectors; ++j) {
            const double y = (j + 0.5) / sectors;
            const double phi = std::numbers::pi * y * y * (3.0 - 2.0 * y);
            const double share = 6.0 * y * (1.0 - y);
            const glm::dvec3 light = axis * std::cos(theta) + side * (std::sin(theta) * std::cos(phi)) +
                                     glm::dvec3(0.0, std::sin(theta) * std::sin(phi), 0.0);
            if (light.z > 0.0) sum += static_cast<double>(f(glm::vec3(light))) * area * share;
        }
    }
    return sum;
}

}  // namespace macula::test
