#include "scenes/shapes_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/mesh_attributes.h"
#include "scenes/shapes.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// Any unit vector at right angles to a unit vector.
glm::vec3 perpendicular(const glm::vec3& d) {
    const glm::vec3 least = std::abs(d.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    return glm::normalize(glm::cross(least, d));
}

/// Disc that closes a pipe: a fan around `centre`, its front along `normal`.
void add_end(Mesh& mesh, const std::vector<glm::vec3>& ring, const glm::vec3& normal, bool reversed) {
    const auto base = static_cast<unsigned>(mesh.position_m.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        mesh.position_m.push_back(ring[i]);
        mesh.normal.push_back(normal);
        mesh.uv0.emplace_back(0.0F, static_cast<float>(i) / static_cast<float>(ring.size()));
    }
    for (unsigned i = 1; i + 1 < ring.size(); ++i)
        mesh.triangle.push_back(reversed ? glm::uvec3(base, base + i + 1, base + i)
                                         : glm::uvec3(base, base + i, base + i + 1));
}

}  // namespace

Mesh make_surface(int columns, int rows, bool closed_u, const std::function<glm::vec3(float, float)>& at) {
    Mesh mesh;
    const int width = columns + 1;
    const auto index = [width](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(columns);
            const float v = static_cast<float>(y) / static_cast<float>(rows);
            mesh.position_m.push_back(closed_u && x == columns ? mesh.position_m[index(0, y)] : at(u, v));
            mesh.uv0.emplace_back(u, 1.0F - v);
        }
    const auto& p = mesh.position_m;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const int left = x > 0 ? x - 1 : (closed_u ? columns - 1 : 0);
            const int right = x < columns ? x + 1 : (closed_u ? 1 : columns);
            glm::vec3 du = p[index(right, y)] - p[index(left, y)];
            const int below = std::max(y - 1, 0);
            const int above = std::min(y + 1, rows);
            const glm::vec3 dv = p[index(x, above)] - p[index(x, below)];
            // At a pole the row is one point; the neighbouring row turns the same way.
            if (glm::dot(du, du) < 1e-12F) {
                const int row = y == 0 ? 1 : rows - 1;
                du = p[index(right, row)] - p[index(left, row)];
            }
            const glm::vec3 normal = glm::cross(du, dv);
            const float length = glm::length(normal);
            mesh.normal.push_back(length > 0.0F ? normal / length : glm::vec3(0.0F, 1.0F, 0.0F));
        }
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto a = static_cast<unsigned>(index(x, y));
            const auto b = static_cast<unsigned>(index(x, y + 1));
            mesh.triangle.emplace_back(a, a + 1, b + 1);
            mesh.triangle.emplace_back(a, b + 1, b);
        }
    drop_degenerate_triangles(mesh);
    return mesh;
}

Mesh make_turned(std::span<const glm::vec2> profile, int segments) {
    constexpr float kSmoothCosine = 0.82F;  // 35 degrees
    const auto piece_normal = [&profile](std::size_t i) {
        const glm::vec2 d = profile[i + 1] - profile[i];
        return glm::normalize(glm::vec2(d.y, -d.x));
    };
    std::vector<ProfilePoint> points;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const float radius = profile[i].x;
        const float height = profile[i].y;
        if (i == 0 || i + 1 == profile.size()) {
            points.push_back({radius, height, piece_normal(i == 0 ? 0 : i - 1)});
            continue;
        }
        const glm::vec2 before = piece_normal(i - 1);
        const glm::vec2 after = piece_normal(i);
        if (glm::dot(before, after) > kSmoothCosine) {
            points.push_back({radius, height, glm::normalize(before + after)});
        } else {
            points.push_back({radius, height, before});
            points.push_back({radius, height, after});
        }
    }
    return make_lathe(points, segments);
}

Mesh make_pipe(std::span<const glm::vec3> path, float radius_m, int sides, bool closed) {
    const int count = static_cast<int>(path.size());
    const auto point = [&](int i) { return path[static_cast<std::size_t>((i + count) % count)]; };
    const auto direction = [&](int i) { return glm::normalize(point(i + 1) - point(i)); };
    const int rings = closed ? count + 1 : count;

    Mesh mesh;
    glm::vec3 side = perpendicular(direction(closed ? -1 : 0));
    float length_m = 0.0F;
    std::vector<glm::vec3> first;
    std::vector<glm::vec3> last;
    for (int i = 0; i < rings; ++i) {
        const bool begin = !closed && i == 0;
        const bool end = !closed && i == count - 1;
        const glm::vec3 into = begin ? direction(0) : direction(i - 1);
        const glm::vec3 out = end ? into : direction(i);
        if (i > 0) length_m += glm::length(point(i) - point(i - 1));
        // The ring is where the pipe that comes meets the plane that halves the corner. The frame turns as little as
        // it can, as the direction does (parallel transport).
        const glm::vec3 across = glm::normalize(into + out);
        const float cosine = std::max(glm::dot(into, across), 0.3F);
        const glm::vec3 other = glm::cross(into, side);
        const auto transported = [&](const glm::vec3& n) {
            return n - (into + out) * (glm::dot(n, out) / std::max(1.0F + glm::dot(into, out), 0.05F));
        };
        std::vector<glm::vec3> ring;
        for (int s = 0; s <= sides; ++s) {
            const float v = static_cast<float>(s % sides) / static_cast<float>(sides);
            const glm::vec3 normal = std::cos(kTau * v) * side + std::sin(kTau * v) * other;
            mesh.position_m.push_back(point(i) + radius_m * (normal - into * (glm::dot(normal, across) / cosine)));
            mesh.normal.push_back(glm::normalize(normal + transported(normal)));
            mesh.uv0.emplace_back(length_m, static_cast<float>(s) / static_cast<float>(sides));
            if (s < sides) ring.push_back(mesh.position_m.back());
        }
        side = glm::normalize(transported(side));
        if (begin) first = ring;
        if (end) last = ring;
    }
    const auto width = static_cast<unsigned>(sides + 1);
    for (unsigned i = 0; i + 1 < static_cast<unsigned>(rings); ++i)
        for (unsigned s = 0; s < static_cast<unsigned>(sides); ++s) {
            const unsigned a = i * width + s;
            mesh.triangle.emplace_back(a, a + 1, a + 1 + width);
            mesh.triangle.emplace_back(a, a + 1 + width, a + width);
        }
    if (!closed) {
        add_end(mesh, first, -direction(0), true);
        add_end(mesh, last, direction(count - 2), false);
    }
    return mesh;
}

std::vector<glm::vec3> round_corners(std::span<const glm::vec3> path, float radius_m, int steps) {
    std::vector<glm::vec3> result = {path.front()};
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        const glm::vec3 before = path[i - 1] - path[i];
        const glm::vec3 after = path[i + 1] - path[i];
        const float reach = std::min({radius_m, 0.45F * glm::length(before), 0.45F * glm::length(after)});
        const glm::vec3 from = path[i] + glm::normalize(before) * reach;
        const glm::vec3 to = path[i] + glm::normalize(after) * reach;
        for (int s = 0; s <= steps; ++s) {
            const float t = static_cast<float>(s) / static_cast<float>(steps);
            result.push_back(glm::mix(glm::mix(from, path[i], t), glm::mix(path[i], to, t), t));
        }
    }
    result.push_back(path.back());
    return result;
}

std::vector<glm::vec3> hanging_path(const glm::vec3& from, const glm::vec3& to, float sag_m, int pieces) {
    std::vector<glm::vec3> path;
    for (int i = 0; i <= pieces; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(pieces);
        path.push_back(glm::mix(from, to, t) - glm::vec3(0.0F, 4.0F * sag_m * t * (1.0F - t), 0.0F));
    }
    return path;
}

Mesh make_prism(std::span<const glm::vec3> lower, std::span<const glm::vec3> upper) {
    Mesh mesh;
    const auto add_face = [&mesh](const std::vector<glm::vec3>& corners, const std::vector<glm::vec2>& uv) {
        const auto base = static_cast<unsigned>(mesh.position_m.size());
        const glm::vec3 normal =
            glm::normalize(glm::cross(corners[1] - corners[0], corners[corners.size() - 1] - corners[0]));
        for (std::size_t i = 0; i < corners.size(); ++i) {
            mesh.position_m.push_back(corners[i]);
            mesh.normal.push_back(normal);
            mesh.uv0.push_back(uv[i]);
        }
        for (unsigned i = 1; i + 1 < corners.size(); ++i) mesh.triangle.emplace_back(base, base + i, base + i + 1);
    };
    float around_m = 0.0F;
    const std::size_t count = lower.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const float width_m = glm::length(lower[next] - lower[i]);
        const float length_m = glm::length(upper[i] - lower[i]);
        add_face({lower[i], lower[next], upper[next], upper[i]},
                 {{0.0F, around_m}, {0.0F, around_m + width_m}, {length_m, around_m + width_m}, {length_m, around_m}});
        around_m += width_m;
    }
    const auto flat = [](std::span<const glm::vec3> outline) {
        std::vector<glm::vec2> uv;
        const glm::vec3 x = glm::normalize(outline[1] - outline[0]);
        const glm::vec3 normal = glm::normalize(glm::cross(x, outline[outline.size() - 1] - outline[0]));
        const glm::vec3 y = glm::cross(normal, x);
        for (const glm::vec3& p : outline) uv.emplace_back(glm::dot(p - outline[0], x), glm::dot(p - outline[0], y));
        return uv;
    };
    add_face({upper.begin(), upper.end()}, flat(upper));
    const std::vector<glm::vec3> under(lower.rbegin(), lower.rend());
    add_face(under, flat(under));
    return mesh;
}

}  // namespace macula
