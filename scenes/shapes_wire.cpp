#include "scenes/shapes_wire.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/mesh_edit.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// The point `distance_m` along a polyline; beyond its end the end.
glm::vec3 point_along(std::span<const glm::vec3> path, float distance_m) {
    for (std::size_t i = 1; i < path.size(); ++i) {
        const float piece = glm::length(path[i] - path[i - 1]);
        if (distance_m <= piece) return glm::mix(path[i - 1], path[i], distance_m / piece);
        distance_m -= piece;
    }
    return path.back();
}

float path_length(std::span<const glm::vec3> path) {
    float length_m = 0.0F;
    for (std::size_t i = 1; i < path.size(); ++i) length_m += glm::length(path[i] - path[i - 1]);
    return length_m;
}

}  // namespace

Mesh make_chain(std::span<const glm::vec3> path, float wire_m) {
    std::vector<glm::vec3> oval;
    for (int i = 0; i < 10; ++i) {
        const float a = kTau * (static_cast<float>(i) + 0.5F) / 10.0F;
        const float half_straight = 1.5F * wire_m;
        oval.emplace_back(2.5F * wire_m * std::cos(a),
                          2.5F * wire_m * std::sin(a) + (std::sin(a) > 0.0F ? half_straight : -half_straight), 0.0F);
    }
    const Mesh link = make_pipe(oval, wire_m, 5, true);
    const float step_m = 6.2F * wire_m;
    const int links = std::max(1, static_cast<int>(path_length(path) / step_m));
    Mesh chain;
    for (int i = 0; i < links; ++i) {
        const glm::vec3 at = point_along(path, (static_cast<float>(i) + 0.5F) * step_m);
        const glm::vec3 next = point_along(path, (static_cast<float>(i) + 0.6F) * step_m);
        const glm::vec3 ahead = glm::length(next - at) > 1e-6F ? next : at + glm::vec3(0.0F, 1.0F, 0.0F);
        append(chain, link, along(at, ahead) * turned(glm::vec3(0.0F), i % 2 == 0 ? 40.0F : 130.0F, {0, 1, 0}));
    }
    return chain;
}

Mesh make_rope(std::span<const glm::vec3> path, float radius_m, float turns_per_m) {
    const float length_m = path_length(path);
    const int pieces = std::max(4, static_cast<int>(length_m * turns_per_m * 5.0F));
    Mesh rope;
    for (int strand = 0; strand < 3; ++strand) {
        std::vector<glm::vec3> wound;
        for (int i = 0; i <= pieces; ++i) {
            const float s = length_m * static_cast<float>(i) / static_cast<float>(pieces);
            const glm::vec3 at = point_along(path, s);
            const glm::vec3 before = point_along(path, std::max(0.0F, s - 0.01F));
            const glm::vec3 after = point_along(path, std::min(length_m, s + 0.01F));
            const glm::mat4 frame = along(at, at + glm::normalize(after - before), {0.37F, 0.21F, 0.9F});
            const float a = kTau * (s * turns_per_m + static_cast<float>(strand) / 3.0F);
            wound.emplace_back(frame *
                               glm::vec4(0.5F * radius_m * std::cos(a), 0.0F, 0.5F * radius_m * std::sin(a), 1.0F));
        }
        append(rope, make_pipe(wound, 0.52F * radius_m, 4));
    }
    return rope;
}

Mesh make_ring(float ring_radius_m, float wire_radius_m, int segments, int sides) {
    std::vector<glm::vec3> path;
    for (int i = 0; i < segments; ++i) {
        const float a = kTau * static_cast<float>(i) / static_cast<float>(segments);
        path.emplace_back(ring_radius_m * std::sin(a), 0.0F, ring_radius_m * std::cos(a));
    }
    return make_pipe(path, wire_radius_m, sides, true);
}

Mesh make_coil(float ring_radius_m, float wire_radius_m, float height_m, float turns, int pieces_per_turn) {
    std::vector<glm::vec3> path;
    const int pieces = static_cast<int>(turns * static_cast<float>(pieces_per_turn));
    for (int i = 0; i <= pieces; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(pieces);
        const float a = kTau * turns * t;
        path.emplace_back(ring_radius_m * std::cos(a), height_m * t, ring_radius_m * std::sin(a));
    }
    return make_pipe(path, wire_radius_m, 6);
}

Mesh make_railing(std::span<const glm::vec3> path, float height_m, float pipe_radius_m, bool closed) {
    Mesh railing;
    const auto at_height = [&](float h) {
        std::vector<glm::vec3> rail(path.begin(), path.end());
        for (glm::vec3& p : rail) p.y += h;
        return rail;
    };
    append(railing, make_pipe(at_height(height_m), pipe_radius_m, 10, closed));
    append(railing, make_pipe(at_height(0.5F * height_m), 0.8F * pipe_radius_m, 10, closed));
    const std::size_t pieces = closed ? path.size() : path.size() - 1;
    for (std::size_t i = 0; i < pieces; ++i) {
        const glm::vec3 a = path[i];
        const glm::vec3 b = path[(i + 1) % path.size()];
        const float length_m = glm::length(b - a);
        const int posts = std::max(1, static_cast<int>(std::ceil(length_m / 1.3F)));
        for (int p = i == 0 && !closed ? 0 : 1; p <= posts; ++p) {
            const glm::vec3 foot = glm::mix(a, b, static_cast<float>(p) / static_cast<float>(posts));
            append(railing, make_pipe({foot, foot + glm::vec3(0.0F, height_m, 0.0F)}, pipe_radius_m, 10));
            append(railing, make_block({5.0F * pipe_radius_m, 0.008F, 5.0F * pipe_radius_m}),
                   place(foot + glm::vec3(0.0F, 0.004F, 0.0F)));
        }
        append(railing, make_block({0.1F, length_m, 0.004F}),
               along(a + glm::vec3(0.0F, 0.06F, 0.0F), b + glm::vec3(0.0F, 0.06F, 0.0F), {0.0F, 1.0F, 0.0F}) *
                   place({0.0F, 0.5F * length_m, 0.0F}));
    }
    return railing;
}

}  // namespace macula
