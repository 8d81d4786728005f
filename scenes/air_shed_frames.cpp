#include <array>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_shell.h"
#include "scenes/mesh_edit.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

using Size = AirShedSize;

/// Height of the roof's underside at x.
float roof_height(float x) {
    return glm::mix(Size::kRidge, Size::kEaves, std::abs(x) / Size::kHalfWidth);
}

/// Truss in the plane z = 0: pitched upper chord, level tie, posts and diagonals that fall towards the middle.
Mesh make_truss() {
    constexpr int kHalfPanels = 8;
    constexpr float kPlate = 0.012F;
    Mesh truss;
    const auto lower = [](int i) {
        return glm::vec3(Size::kHalfWidth * 0.99F * static_cast<float>(i) / kHalfPanels, Size::kTie, 0.0F);
    };
    const auto upper = [&](int i) {
        const float x = lower(i).x;
        return glm::vec3(x, roof_height(x) - 0.22F, 0.0F);
    };
    append(truss, make_double_angle(lower(-kHalfPanels), lower(kHalfPanels), {0.0F, 1.0F, 0.0F}, 0.10F, kPlate));
    append(truss, make_double_angle(upper(-kHalfPanels), upper(0), {0.0F, -1.0F, 0.0F}, 0.12F, kPlate));
    append(truss, make_double_angle(upper(0), upper(kHalfPanels), {0.0F, -1.0F, 0.0F}, 0.12F, kPlate));

    const Mesh gusset = make_gusset({0.42F, 0.30F}, kPlate, 4, 2, 0.013F);
    const Mesh joint = make_gusset({0.55F, 0.42F}, kPlate, 5, 3, 0.013F);
    const auto brace = [&truss](const glm::vec3& a, const glm::vec3& b, float leg_m) {
        const glm::vec3 trim = glm::normalize(b - a) * 0.06F;
        append(truss, make_double_angle(a + trim, b - trim, {0.3F, 0.2F, 0.0F}, leg_m, 0.008F));
    };
    for (int i = -kHalfPanels; i <= kHalfPanels; ++i) {
        const bool strong = i == 0 || std::abs(i) == kHalfPanels;
        append(truss, strong ? joint : gusset, place(lower(i)));
        append(truss, strong ? joint : gusset, place(upper(i) - glm::vec3(0.0F, 0.06F, 0.0F)));
        brace(lower(i), upper(i), 0.055F);
        if (i == kHalfPanels) break;
        if (i < 0) {
            brace(upper(i), lower(i + 1), 0.065F);
        } else {
            brace(lower(i), upper(i + 1), 0.065F);
        }
    }
    return truss;
}

/// Lattice column: four angles and lacing, on a base plate with anchor bolts; x is its depth.
Mesh make_column(float height_m) {
    constexpr float kDepth = 0.50F;
    constexpr float kWidth = 0.30F;
    constexpr float kLeg = 0.09F;
    constexpr int kPanels = 15;
    Mesh column;
    const Mesh leg = make_angle_bar({kLeg, kLeg}, 0.01F, height_m - 0.03F);
    const std::array<glm::vec2, 4> corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 c = corners[static_cast<std::size_t>(i)];
        append(column, leg, place({c.x * 0.5F * kDepth, 0.03F, c.y * 0.5F * kWidth}, -90.0F * static_cast<float>(i)));
    }
    const Mesh rivet = make_rivet(0.011F);
    const float step = (height_m - 0.5F) / kPanels;
    for (int side = 0; side < 4; ++side) {
        const bool wide = side % 2 == 0;  // faces across z show the depth
        const float half = wide ? 0.5F * kDepth : 0.5F * kWidth;
        const float out = wide ? 0.5F * kWidth : 0.5F * kDepth;
        const glm::mat4 face = turned(glm::vec3(0.0F), 90.0F * static_cast<float>(side), {0.0F, 1.0F, 0.0F});
        for (int i = 0; i < kPanels; ++i) {
            const float y = 0.4F + step * static_cast<float>(i);
            const float way = i % 2 == 0 ? 1.0F : -1.0F;
            const glm::vec3 a(-way * (half - 0.05F), y, out);
            const glm::vec3 b(way * (half - 0.05F), y + step, out);
            const glm::vec3 lift(0.0F, 0.0F, 0.006F);
            append(column, make_block({0.05F, glm::length(b - a), 0.008F}),
                   face * along(a + lift, b + lift, {0.0F, 0.0F, 1.0F}) *
                       turned({0.0F, 0.5F * glm::length(b - a), 0.0F}, 90.0F, {0.0F, 1.0F, 0.0F}));
            append(column, rivet, face * place(a + glm::vec3(0.0F, 0.02F, 0.010F)));
            append(column, rivet, face * place(b + glm::vec3(0.0F, -0.02F, 0.010F)));
        }
    }
    append(column, make_block({kDepth + 0.25F, 0.03F, kWidth + 0.25F}), place({0.0F, 0.015F, 0.0F}));
    const Mesh bolt = make_bolt(0.022F);
    for (const glm::vec2 c : corners)
        append(
            column, bolt,
            turned({c.x * (0.5F * kDepth + 0.08F), 0.03F, c.y * (0.5F * kWidth + 0.08F)}, -90.0F, {1.0F, 0.0F, 0.0F}));
    append(column, make_block({kDepth + 0.06F, 0.02F, kWidth + 0.06F}), place({0.0F, height_m, 0.0F}));
    return column;
}

/// Rod with a turnbuckle.
Mesh make_tie_rod(const glm::vec3& from, const glm::vec3& to) {
    Mesh rod = make_pipe({from, to}, 0.012F, 8);
    const glm::vec3 middle = glm::mix(from, to, 0.4F);
    const glm::vec3 d = glm::normalize(to - from);
    append(rod, make_pipe({middle - 0.16F * d, middle + 0.16F * d}, 0.03F, 6));
    return rod;
}

}  // namespace

void build_frames(SceneBuilder& builder, const AirShedMaterials& m) {
    const int truss = builder.add_mesh(make_truss(), m.girder);
    const int column = builder.add_mesh(make_column(Size::kTie - 0.05F), m.girder);
    for (int i = 0; i <= Size::kBays; ++i) {
        const float z =
            -Size::kHalfLength + 0.3F + (2.0F * Size::kHalfLength - 0.6F) * static_cast<float>(i) / Size::kBays;
        const std::string name = "frame " + std::to_string(i + 1);
        builder.place_mesh(name + " truss", truss, place({0.0F, 0.0F, z}));
        builder.place_mesh(name + " left column", column, place({-Size::kHalfWidth + 0.42F, 0.0F, z}));
        builder.place_mesh(name + " right column", column, place({Size::kHalfWidth - 0.42F, 0.0F, z}, 180.0F));
    }

    Mesh purlins;
    const float length = 2.0F * Size::kHalfLength - 0.1F;
    const Mesh purlin =
        moved(make_channel({0.07F, 0.16F}, 0.008F, length), turned({0.0F, 0.0F, 0.5F * length}, -90.0F, {1, 0, 0}));
    constexpr int kPurlins = 10;
    for (int i = 0; i < kPurlins; ++i)
        for (const float side : {-1.0F, 1.0F}) {
            const float x = side * (0.4F + (Size::kHalfWidth - 0.6F) * static_cast<float>(i) / (kPurlins - 1));
            append(purlins, purlin, place({x, roof_height(x) - 0.10F, 0.0F}));
        }
    const Mesh rail =
        moved(make_channel({0.06F, 0.14F}, 0.008F, length), turned({0.0F, 0.0F, 0.5F * length}, -90.0F, {1, 0, 0}));
    for (const float side : {-1.0F, 1.0F})
        for (const float y : {1.25F, 3.1F, 5.12F, 7.48F, 8.5F})
            append(purlins, rail, place({side * (Size::kHalfWidth - 0.14F), y, 0.0F}, side > 0.0F ? 180.0F : 0.0F));
    // A lattice beam under the trusses' middle keeps them upright.
    GirderShape shape;
    shape.depth_m = 0.9F;
    shape.panels = 28;
    shape.chord_m = 0.07F;
    shape.brace_m = 0.05F;
    for (const float x : {-9.0F, 9.0F})
        append(purlins, make_girder({x, Size::kTie + 0.08F, -Size::kHalfLength + 0.2F},
                                    {x, Size::kTie + 0.08F, Size::kHalfLength - 0.2F}, {0.0F, 1.0F, 0.0F}, shape));
    builder.place_mesh("purlins", builder.add_mesh(std::move(purlins), m.girder));

    Mesh rods;
    for (const int bay : {0, 6, 7, 13}) {
        const float z0 = -Size::kHalfLength + 0.3F + Size::kBay * static_cast<float>(bay);
        const float z1 = z0 + Size::kBay - 0.1F;
        for (const float side : {-1.0F, 1.0F}) {
            for (const float x : {0.5F, 9.0F}) {
                const float outer = x + 8.5F;
                const glm::vec3 a(side * x, roof_height(x) - 0.3F, z0);
                const glm::vec3 b(side * outer, roof_height(outer) - 0.3F, z1);
                append(rods, make_tie_rod(a, b));
                append(rods, make_tie_rod({a.x, a.y, z1}, {b.x, b.y, z0}));
            }
            const float wall = side * (Size::kHalfWidth - 0.35F);
            append(rods, make_tie_rod({wall, 0.6F, z0}, {wall, 7.8F, z1}));
            append(rods, make_tie_rod({wall, 0.6F, z1}, {wall, 7.8F, z0}));
        }
    }
    builder.place_mesh("wind bracing", builder.add_mesh(std::move(rods), m.black_iron));
}

}  // namespace macula
