#include "scenes/shapes_steel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// Face of a block: centre, and half edges whose cross product looks outward.
void add_face(Mesh& mesh, const glm::vec3& centre, const glm::vec3& half_u, const glm::vec3& half_v) {
    const auto base = static_cast<unsigned>(mesh.position_m.size());
    const glm::vec3 normal = glm::normalize(glm::cross(half_u, half_v));
    const float u_m = 2.0F * glm::length(half_u);
    const float v_m = 2.0F * glm::length(half_v);
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        mesh.position_m.push_back(centre + corner.x * half_u + corner.y * half_v);
        mesh.normal.push_back(normal);
        const glm::vec2 at(0.5F * (corner.x + 1.0F) * u_m, 0.5F * (1.0F - corner.y) * v_m);
        mesh.uv0.push_back(u_m >= v_m ? at : glm::vec2(at.y, at.x));
    }
    mesh.triangle.emplace_back(base, base + 1, base + 2);
    mesh.triangle.emplace_back(base, base + 2, base + 3);
}

glm::vec3 axis(int i, float length) {
    glm::vec3 v(0.0F);
    v[i] = length;
    return v;
}

}  // namespace

Mesh make_block(const glm::vec3& size_m) {
    return make_bevelled_block(size_m, 0.0F);
}

Mesh make_bevelled_block(const glm::vec3& size_m, float bevel_m) {
    Mesh mesh;
    const glm::vec3 half = 0.5F * size_m;
    const glm::vec3 inner = half - bevel_m;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        for (const float side : {-1.0F, 1.0F}) {
            add_face(mesh, axis(i, side * half[i]), axis(j, side * inner[j]), axis(k, inner[k]));
            if (bevel_m <= 0.0F) continue;
            for (const float other : {-1.0F, 1.0F}) {  // the edge along axis k between the faces of i and j
                const glm::vec3 centre =
                    axis(i, side * (half[i] - 0.5F * bevel_m)) + axis(j, other * (half[j] - 0.5F * bevel_m));
                const glm::vec3 across = axis(i, -0.5F * side * bevel_m) + axis(j, 0.5F * other * bevel_m);
                add_face(mesh, centre, across, axis(k, side * other * inner[k]));
            }
        }
    }
    if (bevel_m <= 0.0F) return mesh;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 s((corner & 1) != 0 ? 1.0F : -1.0F, (corner & 2) != 0 ? 1.0F : -1.0F,
                          (corner & 4) != 0 ? 1.0F : -1.0F);
        const auto base = static_cast<unsigned>(mesh.position_m.size());
        for (int i = 0; i < 3; ++i) {
            glm::vec3 p = s * inner;
            p[i] = s[i] * half[i];
            mesh.position_m.push_back(p);
            mesh.normal.push_back(glm::normalize(s));
            mesh.uv0.emplace_back(0.0F, 0.0F);
        }
        const bool flip = s.x * s.y * s.z < 0.0F;
        mesh.triangle.emplace_back(base, base + (flip ? 2 : 1), base + (flip ? 1 : 2));
    }
    return mesh;
}

Mesh make_angle_bar(const glm::vec2& size_m, float thick_m, float length_m) {
    const float middle = 0.5F * length_m;
    Mesh bar = moved(make_block({size_m.x, length_m, thick_m}), place({0.5F * size_m.x, middle, 0.5F * thick_m}));
    append(bar, make_block({thick_m, length_m, size_m.y - thick_m}),
           place({0.5F * thick_m, middle, 0.5F * (size_m.y + thick_m)}));
    return bar;
}

Mesh make_i_beam(const glm::vec2& size_m, float thick_m, float length_m) {
    const float middle = 0.5F * length_m;
    Mesh beam = moved(make_block({size_m.x - 2.0F * thick_m, length_m, thick_m}), place({0.0F, middle, 0.0F}));
    for (const float side : {-1.0F, 1.0F})
        append(beam, make_block({thick_m, length_m, size_m.y}),
               place({side * 0.5F * (size_m.x - thick_m), middle, 0.0F}));
    return beam;
}

Mesh make_channel(const glm::vec2& size_m, float thick_m, float length_m) {
    const float middle = 0.5F * length_m;
    Mesh bar = moved(make_block({thick_m, length_m, size_m.y}), place({0.5F * (thick_m - size_m.x), middle, 0.0F}));
    for (const float side : {-1.0F, 1.0F})
        append(bar, make_block({size_m.x - thick_m, length_m, thick_m}),
               place({0.5F * thick_m, middle, side * 0.5F * (size_m.y - thick_m)}));
    return bar;
}

Mesh make_rivet(float radius_m, int sides) {
    const Mesh dome =
        make_turned({{radius_m, 0.0F}, {0.75F * radius_m, 0.45F * radius_m}, {0.0F, 0.65F * radius_m}}, sides);
    return moved(dome, turned(glm::vec3(0.0F), 90.0F, {1.0F, 0.0F, 0.0F}));
}

Mesh make_bolt(float radius_m) {
    Mesh bolt =
        make_turned({{1.35F * radius_m, 0.0F}, {1.35F * radius_m, 0.2F * radius_m}, {0.0F, 0.2F * radius_m}}, 12);
    append(bolt, make_turned({{radius_m, 0.2F * radius_m}, {radius_m, 0.9F * radius_m}, {0.0F, 0.95F * radius_m}}, 6));
    return moved(bolt, turned(glm::vec3(0.0F), 90.0F, {1.0F, 0.0F, 0.0F}));
}

Mesh make_gusset(const glm::vec2& size_m, float thick_m, int columns, int rows, float rivet_m) {
    const glm::vec2 h = 0.5F * size_m;
    const glm::vec2 cut = 0.3F * size_m;
    const std::array<glm::vec2, 8> corners = {{{-h.x + cut.x, -h.y},
                                               {h.x - cut.x, -h.y},
                                               {h.x, -h.y + cut.y},
                                               {h.x, h.y - cut.y},
                                               {h.x - cut.x, h.y},
                                               {-h.x + cut.x, h.y},
                                               {-h.x, h.y - cut.y},
                                               {-h.x, -h.y + cut.y}}};
    std::array<glm::vec3, 8> back;
    std::array<glm::vec3, 8> front;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        back[i] = glm::vec3(corners[i], -0.5F * thick_m);
        front[i] = glm::vec3(corners[i], 0.5F * thick_m);
    }
    Mesh plate = make_prism(back, front);
    const Mesh rivet = make_rivet(rivet_m);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const glm::vec2 at(columns > 1 ? static_cast<float>(x) / static_cast<float>(columns - 1) - 0.5F : 0.0F,
                               rows > 1 ? static_cast<float>(y) / static_cast<float>(rows - 1) - 0.5F : 0.0F);
            if (std::abs(at.x) > 0.45F && std::abs(at.y) > 0.45F) continue;  // the cut corners
            const glm::vec2 p = at * size_m * 0.78F;
            append(plate, rivet, place({p.x, p.y, 0.5F * thick_m}));
            append(plate, rivet, turned({p.x, p.y, -0.5F * thick_m}, 180.0F, {0.0F, 1.0F, 0.0F}));
        }
    return plate;
}

Mesh make_double_angle(const glm::vec3& from, const glm::vec3& to, const glm::vec3& flange, float leg_m,
                       float thick_m) {
    const float length_m = glm::length(to - from);
    const glm::mat4 frame = along(from, to, flange);  // x towards `flange`
    const Mesh one = make_angle_bar({leg_m, leg_m}, thick_m, length_m);
    Mesh pair = moved(one, frame * place({-0.5F * leg_m, 0.0F, 0.5F * thick_m}));
    append(pair, one, frame * glm::scale(place({-0.5F * leg_m, 0.0F, -0.5F * thick_m}), {1.0F, 1.0F, -1.0F}));
    return pair;
}

Mesh make_girder(const glm::vec3& from, const glm::vec3& to, const glm::vec3& up, const GirderShape& shape) {
    const glm::vec3 rise = up * shape.depth_m;
    Mesh girder = make_double_angle(from, to, up, shape.chord_m, shape.plate_m);
    append(girder, make_double_angle(from + rise, to + rise, -up, shape.chord_m, shape.plate_m));
    const glm::vec3 run = glm::normalize(to - from);
    const glm::mat4 plane(glm::vec4(run, 0.0F), glm::vec4(up, 0.0F), glm::vec4(glm::cross(run, up), 0.0F),
                          glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
    const Mesh gusset = make_gusset({2.6F * shape.chord_m, 2.0F * shape.chord_m}, shape.plate_m, shape.rivets ? 4 : 0,
                                    shape.rivets ? 3 : 0, 0.011F);
    const auto brace = [&](const glm::vec3& a, const glm::vec3& b) {
        const glm::vec3 trim = glm::normalize(b - a) * 0.6F * shape.chord_m;
        const glm::vec3 side = glm::cross(run, up) * (0.5F * shape.plate_m);
        append(girder, make_angle_bar({shape.brace_m, shape.brace_m}, shape.plate_m, glm::length(b - a - 2.0F * trim)),
               along(a + trim + side, b - trim + side, glm::cross(glm::normalize(b - a), glm::cross(run, up))));
    };
    for (int i = 0; i <= shape.panels; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(shape.panels);
        const glm::vec3 low = glm::mix(from, to, t);
        glm::mat4 at = plane;
        at[3] = glm::vec4(low, 1.0F);
        append(girder, gusset, at);
        at[3] = glm::vec4(low + rise, 1.0F);
        append(girder, gusset, at);
        brace(low, low + rise);
        if (i == shape.panels) break;
        const glm::vec3 next = glm::mix(from, to, static_cast<float>(i + 1) / static_cast<float>(shape.panels));
        if (i % 2 == 0) {
            brace(low, next + rise);
        } else {
            brace(low + rise, next);
        }
    }
    return girder;
}

Mesh make_grating(const glm::vec2& size_m, float pitch_m, float bar_depth_m) {
    constexpr float kBar_m = 0.004F;
    constexpr float kRod_m = 0.006F;
    Mesh grating;
    const float middle = -0.5F * bar_depth_m;
    for (const float side : {-1.0F, 1.0F}) {
        append(grating, make_block({0.006F, bar_depth_m, size_m.y}), place({side * 0.5F * size_m.x, middle, 0.0F}));
        append(grating, make_block({size_m.x, bar_depth_m, 0.006F}), place({0.0F, middle, side * 0.5F * size_m.y}));
    }
    const int bars = static_cast<int>(size_m.x / pitch_m);
    const Mesh bar = make_block({kBar_m, bar_depth_m, size_m.y});
    for (int i = 1; i < bars; ++i)
        append(grating, bar,
               place({(static_cast<float>(i) / static_cast<float>(bars) - 0.5F) * size_m.x, middle, 0.0F}));
    const int rods = static_cast<int>(size_m.y / (3.0F * pitch_m));
    const Mesh rod = make_block({size_m.x, kRod_m, kRod_m});
    for (int i = 1; i < rods; ++i)
        append(grating, rod,
               place({0.0F, -0.5F * kRod_m - 0.001F,
                      (static_cast<float>(i) / static_cast<float>(rods) - 0.5F) * size_m.y}));
    return grating;
}

Mesh make_corrugated_sheet(const glm::vec2& size_m, const CorrugationShape& shape) {
    const float waves = std::round(size_m.x / shape.pitch_m);
    const int columns = static_cast<int>(waves) * shape.pieces;
    const float offset = 61.7F * hash01(shape.seed, 1, 3);
    Mesh sheet = make_surface(columns, shape.rows, false, [&](float u, float v) {
        const float wave = 0.5F * shape.depth_m * std::cos(kTau * waves * u);
        const float dent = shape.dent_m * (value_noise(offset + 3.0F * u, offset + 2.5F * v, 4096, 17) - 0.5F) * 2.0F;
        return glm::vec3((u - 0.5F) * size_m.x, (v - 0.5F) * size_m.y, wave + dent);
    });
    for (glm::vec2& uv : sheet.uv0) uv *= size_m;
    return sheet;
}

}  // namespace macula
