#include "scenes/mesh_attributes.h"

#include <cmath>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace macula {
namespace {

/// Twice the area times the unit normal, in double: float loses small triangles far from the origin.
glm::dvec3 area_normal(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.position_m[t.x]);
    return glm::cross(glm::dvec3(mesh.position_m[t.y]) - a, glm::dvec3(mesh.position_m[t.z]) - a);
}

/// Unit vector, or `fallback` where the length is zero.
glm::vec3 unit_or(const glm::dvec3& v, const glm::vec3& fallback) {
    const double length = glm::length(v);
    return length > 0.0 ? glm::vec3(v / length) : fallback;
}

/// Any unit vector orthogonal to the unit vector `n`.
glm::vec3 any_orthogonal(const glm::vec3& n) {
    const glm::vec3 axis = std::abs(n.x) < 0.5F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    return glm::normalize(glm::cross(axis, n));
}

template <class T>
void unweld(std::vector<T>& attribute, const std::vector<glm::uvec3>& triangles) {
    if (attribute.empty()) return;
    std::vector<T> out;
    out.reserve(triangles.size() * 3);
    for (const glm::uvec3& t : triangles)
        for (int c = 0; c < 3; ++c) out.push_back(attribute[t[c]]);
    attribute = std::move(out);
}

}  // namespace

void add_smooth_normals(Mesh& mesh) {
    std::vector<glm::dvec3> sum(mesh.position_m.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh.triangle) {
        const glm::dvec3 normal(unit_or(area_normal(mesh, t), glm::vec3(0.0F)));
        for (int c = 0; c < 3; ++c) {
            const glm::vec3& corner = mesh.position_m[t[c]];
            const glm::vec3 a = unit_or(mesh.position_m[t[(c + 1) % 3]] - corner, glm::vec3(0.0F));
            const glm::vec3 b = unit_or(mesh.position_m[t[(c + 2) % 3]] - corner, glm::vec3(0.0F));
            sum[t[c]] += normal * static_cast<double>(std::acos(glm::clamp(glm::dot(a, b), -1.0F, 1.0F)));
        }
    }
    mesh.normal.clear();
    mesh.normal.reserve(sum.size());
    for (const glm::dvec3& s : sum) mesh.normal.push_back(unit_or(s, glm::vec3(0.0F, 1.0F, 0.0F)));
}

void add_flat_normals(Mesh& mesh) {
    std::vector<glm::vec3> normal;
    normal.reserve(mesh.triangle.size() * 3);
    for (const glm::uvec3& t : mesh.triangle)
        normal.insert(normal.end(), 3, unit_or(area_normal(mesh, t), glm::vec3(0.0F, 1.0F, 0.0F)));
    unweld(mesh.position_m, mesh.triangle);
    unweld(mesh.tangent, mesh.triangle);
    unweld(mesh.uv0, mesh.triangle);
    unweld(mesh.uv1, mesh.triangle);
    unweld(mesh.color, mesh.triangle);
    mesh.normal = std::move(normal);
    for (std::size_t i = 0; i < mesh.triangle.size(); ++i) {
        const auto first = static_cast<unsigned>(3 * i);
        mesh.triangle[i] = {first, first + 1, first + 2};
    }
}

void add_tangents(Mesh& mesh, const std::vector<glm::vec2>& uv) {
    std::vector<glm::dvec3> along_u(mesh.position_m.size(), glm::dvec3(0.0));
    std::vector<glm::dvec3> along_v(mesh.position_m.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh.triangle) {
        const glm::dvec3 e1(mesh.position_m[t.y] - mesh.position_m[t.x]);
        const glm::dvec3 e2(mesh.position_m[t.z] - mesh.position_m[t.x]);
        const glm::dvec2 d1(uv[t.y] - uv[t.x]);
        const glm::dvec2 d2(uv[t.z] - uv[t.x]);
        // Multiplied by the determinant's sign instead of divided by it: large triangles weigh more, none explodes.
        const double sign = d1.x * d2.y - d2.x * d1.y < 0.0 ? -1.0 : 1.0;
        for (int c = 0; c < 3; ++c) {
            along_u[t[c]] += sign * (e1 * d2.y - e2 * d1.y);
            along_v[t[c]] += sign * (e2 * d1.x - e1 * d2.x);
        }
    }
    mesh.tangent.clear();
    mesh.tangent.reserve(mesh.position_m.size());
    for (std::size_t i = 0; i < mesh.position_m.size(); ++i) {
        const glm::dvec3 n(mesh.normal[i]);
        const glm::vec3 tangent = unit_or(along_u[i] - n * glm::dot(n, along_u[i]), any_orthogonal(mesh.normal[i]));
        const double side = glm::dot(glm::cross(n, glm::dvec3(tangent)), along_v[i]);
        // v runs down the image: glTF's bitangent points along -v, towards the top of the normal map.
        mesh.tangent.emplace_back(tangent, side > 0.0 ? -1.0F : 1.0F);
    }
}

std::size_t drop_degenerate_triangles(Mesh& mesh) {
    return std::erase_if(mesh.triangle, [&mesh](const glm::uvec3& t) {
        return t.x == t.y || t.y == t.z || t.z == t.x || glm::length(area_normal(mesh, t)) == 0.0;
    });
}

}  // namespace macula
