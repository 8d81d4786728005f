#include "scenes/mesh_edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace macula {

void append(Mesh& to, const Mesh& part, const glm::mat4& to_from_part) {
    const auto base = static_cast<unsigned>(to.position_m.size());
    const glm::mat3 linear(to_from_part);
    const bool mirrored = glm::determinant(linear) < 0.0F;
    const glm::mat3 normals = glm::transpose(glm::inverse(linear));
    for (const glm::vec3& p : part.position_m) to.position_m.emplace_back(to_from_part * glm::vec4(p, 1.0F));
    for (const glm::vec3& n : part.normal) to.normal.push_back(glm::normalize(normals * n));
    to.uv0.insert(to.uv0.end(), part.uv0.begin(), part.uv0.end());
    if (!to.color.empty() || !part.color.empty()) {
        to.color.resize(base, glm::vec4(1.0F));
        to.color.insert(to.color.end(), part.color.begin(), part.color.end());
        to.color.resize(to.position_m.size(), glm::vec4(1.0F));
    }
    for (const glm::uvec3& t : part.triangle) to.triangle.push_back(base + (mirrored ? glm::uvec3(t.x, t.z, t.y) : t));
}

Mesh moved(const Mesh& part, const glm::mat4& to_from_part) {
    Mesh result;
    append(result, part, to_from_part);
    return result;
}

void tint(Mesh& mesh, const glm::vec3& factor) {
    mesh.color.resize(mesh.position_m.size(), glm::vec4(1.0F));
    for (glm::vec4& c : mesh.color) c *= glm::vec4(factor, 1.0F);
}

void shift_uv(Mesh& mesh, const glm::vec2& by) {
    for (glm::vec2& uv : mesh.uv0) uv += by;
}

void scale_uv(Mesh& mesh, const glm::vec2& by) {
    for (glm::vec2& uv : mesh.uv0) uv *= by;
}

bool is_closed(const Mesh& mesh) {
    // Seams of round shapes meet to a rounding error only.
    using Point = std::array<long, 3>;
    const auto point = [&mesh](unsigned i) {
        const glm::vec3 p = mesh.position_m[i] * 1e5F;
        return Point{std::lround(p.x), std::lround(p.y), std::lround(p.z)};
    };
    std::vector<std::pair<Point, Point>> edges;
    for (const glm::uvec3& t : mesh.triangle)
        for (int c = 0; c < 3; ++c) edges.emplace_back(point(t[c]), point(t[(c + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
    return std::all_of(edges.begin(), edges.end(), [&edges](const auto& edge) {
        return std::binary_search(edges.begin(), edges.end(), std::pair(edge.second, edge.first));
    });
}

glm::mat4 place(const glm::vec3& at, float yaw_deg, float scale) {
    return glm::scale(turned(at, yaw_deg, glm::vec3(0.0F, 1.0F, 0.0F)), glm::vec3(scale));
}

glm::mat4 turned(const glm::vec3& at, float angle_deg, const glm::vec3& axis) {
    return glm::rotate(glm::translate(glm::mat4(1.0F), at), glm::radians(angle_deg), axis);
}

glm::mat4 along(const glm::vec3& from, const glm::vec3& to, const glm::vec3& to_side) {
    const glm::vec3 y = glm::normalize(to - from);
    glm::vec3 z = glm::cross(to_side, y);
    if (glm::dot(z, z) < 1e-8F) z = glm::cross(std::abs(y.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1), y);
    z = glm::normalize(z);
    return {glm::vec4(glm::cross(y, z), 0.0F), glm::vec4(y, 0.0F), glm::vec4(z, 0.0F), glm::vec4(from, 1.0F)};
}

}  // namespace macula
