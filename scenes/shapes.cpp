#include "scenes/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "scenes/mesh_attributes.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// Triangles of a grid of vertices, row by row; a cell's corners turn counter-clockwise when the columns run to the
/// right and the rows run up.
void add_grid_triangles(Mesh& mesh, int columns, int row) {
    const auto width = static_cast<unsigned>(columns + 1);
    for (unsigned x = 0; x < static_cast<unsigned>(columns); ++x) {
        const unsigned a = static_cast<unsigned>(row) * width + x;
        mesh.triangle.emplace_back(a, a + 1, a + 1 + width);
        mesh.triangle.emplace_back(a, a + 1 + width, a + width);
    }
}

void append(Mesh& to, const Mesh& from) {
    const auto base = static_cast<unsigned>(to.position_m.size());
    to.position_m.insert(to.position_m.end(), from.position_m.begin(), from.position_m.end());
    to.normal.insert(to.normal.end(), from.normal.begin(), from.normal.end());
    to.uv0.insert(to.uv0.end(), from.uv0.begin(), from.uv0.end());
    for (const glm::uvec3& t : from.triangle) to.triangle.push_back(t + base);
}

}  // namespace

Mesh make_quad(const glm::vec3& top_left, const glm::vec3& right, const glm::vec3& down) {
    Mesh mesh;
    const glm::vec3 normal = glm::normalize(glm::cross(down, right));
    mesh.position_m = {top_left, top_left + down, top_left + down + right, top_left + right};
    mesh.normal.assign(4, normal);
    mesh.uv0 = {{0.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}};
    mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh make_box(const glm::vec3& size_m) {
    const float x = 0.5F * size_m.x;
    const float y = size_m.y;
    const float z = 0.5F * size_m.z;
    const glm::vec3 right(size_m.x, 0.0F, 0.0F);
    const glm::vec3 down(0.0F, -y, 0.0F);
    const glm::vec3 depth(0.0F, 0.0F, size_m.z);
    Mesh mesh = make_quad({-x, y, z}, right, down);         // +Z
    append(mesh, make_quad({x, y, -z}, -right, down));      // -Z
    append(mesh, make_quad({x, y, z}, -depth, down));       // +X
    append(mesh, make_quad({-x, y, -z}, depth, down));      // -X
    append(mesh, make_quad({-x, y, -z}, right, depth));     // +Y
    append(mesh, make_quad({-x, 0.0F, z}, right, -depth));  // -Y
    return mesh;
}

Mesh make_lathe(std::span<const ProfilePoint> profile, int segments) {
    std::vector<float> arc(profile.size(), 0.0F);
    for (std::size_t i = 1; i < profile.size(); ++i)
        arc[i] = arc[i - 1] + glm::length(glm::vec2(profile[i].radius_m - profile[i - 1].radius_m,
                                                    profile[i].height_m - profile[i - 1].height_m));
    Mesh mesh;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const ProfilePoint& p = profile[i];
        for (int s = 0; s <= segments; ++s) {
            const float u = static_cast<float>(s) / static_cast<float>(segments);
            const float sine = std::sin(kTau * u);
            const float cosine = std::cos(kTau * u);
            mesh.position_m.emplace_back(p.radius_m * sine, p.height_m, p.radius_m * cosine);
            mesh.normal.emplace_back(p.normal.x * sine, p.normal.y, p.normal.x * cosine);
            mesh.uv0.emplace_back(u, 1.0F - arc[i] / arc.back());
        }
    }
    for (std::size_t i = 1; i < profile.size(); ++i)
        if (arc[i] > arc[i - 1]) add_grid_triangles(mesh, segments, static_cast<int>(i) - 1);
    drop_degenerate_triangles(mesh);  // around a pole
    return mesh;
}

Mesh make_sphere(float radius_m, int segments) {
    std::vector<ProfilePoint> profile;
    const int rows = segments / 2;
    for (int i = 0; i <= rows; ++i) {
        const float angle = 0.5F * kTau * (static_cast<float>(i) / static_cast<float>(rows) - 0.5F);
        const bool pole = i == 0 || i == rows;  // where the float cosine is not quite zero
        const glm::vec2 normal(pole ? 0.0F : std::cos(angle), std::sin(angle));
        profile.push_back({radius_m * normal.x, radius_m * normal.y, normal});
    }
    return make_lathe(profile, segments);
}

Mesh make_cylinder(float bottom_radius_m, float top_radius_m, float height_m, int segments) {
    const glm::vec2 side = glm::normalize(glm::vec2(height_m, bottom_radius_m - top_radius_m));
    const std::array<ProfilePoint, 6> profile = {{{0.0F, 0.0F, {0.0F, -1.0F}},
                                                  {bottom_radius_m, 0.0F, {0.0F, -1.0F}},
                                                  {bottom_radius_m, 0.0F, side},
                                                  {top_radius_m, height_m, side},
                                                  {top_radius_m, height_m, {0.0F, 1.0F}},
                                                  {0.0F, height_m, {0.0F, 1.0F}}}};
    return make_lathe(profile, segments);
}

Mesh make_tube(const std::function<glm::vec3(float)>& curve, float radius_m, int segments, int sides) {
    Mesh mesh;
    const float step = 1.0F / static_cast<float>(segments);
    for (int s = 0; s <= segments; ++s) {
        const float u = static_cast<float>(s) * step;
        const glm::vec3 centre = curve(u);
        const glm::vec3 along = glm::normalize(curve(u + 0.1F * step) - curve(u - 0.1F * step));
        // The frame leans on the direction from the origin, so it closes without a twist.
        const glm::vec3 side = glm::normalize(glm::cross(along, centre));
        const glm::vec3 out = glm::cross(side, along);
        for (int t = 0; t <= sides; ++t) {
            const float v = static_cast<float>(t) / static_cast<float>(sides);
            const glm::vec3 normal = std::cos(kTau * v) * out + std::sin(kTau * v) * side;
            mesh.position_m.push_back(centre + radius_m * normal);
            mesh.normal.push_back(normal);
            mesh.uv0.emplace_back(u, v);
        }
    }
    for (int s = 0; s < segments; ++s) add_grid_triangles(mesh, sides, s);
    return mesh;
}

Mesh make_torus(float ring_radius_m, float tube_radius_m) {
    const auto ring = [=](float u) { return ring_radius_m * glm::vec3(std::sin(kTau * u), 0.0F, std::cos(kTau * u)); };
    return make_tube(ring, tube_radius_m, 96, 40);
}

Mesh make_torus_knot(int p, int q, float ring_radius_m, float tube_radius_m) {
    const auto knot = [=](float u) {
        const float a = kTau * static_cast<float>(p) * u;
        const float b = kTau * static_cast<float>(q) * u;
        const float r = ring_radius_m * (1.0F + 0.4F * std::cos(b));
        return glm::vec3(r * std::sin(a), 0.4F * ring_radius_m * std::sin(b), r * std::cos(a));
    };
    return make_tube(knot, tube_radius_m, 512, 32);
}

}  // namespace macula
