#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_shell.h"
#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

using Size = AirShedSize;

/// Rectangle of bars in the plane z = 0, its lower edge's middle in the origin.
Mesh make_frame(const glm::vec2& size_m, float bar_m, float depth_m) {
    Mesh frame;
    for (const float side : {-1.0F, 1.0F}) {
        append(frame, make_block({bar_m, size_m.y, depth_m}),
               place({side * 0.5F * (size_m.x - bar_m), 0.5F * size_m.y, 0.0F}));
        append(frame, make_block({size_m.x - 2.0F * bar_m, bar_m, depth_m}),
               place({0.0F, 0.5F * size_m.y + side * 0.5F * (size_m.y - bar_m), 0.0F}));
    }
    return frame;
}

/// A leaf of the sliding doors in the plane z = 0, standing on y = 0, seen from inside along -Z.
Model make_door_leaf(const AirShedMaterials& m, float width_m, float height_m, int seed) {
    Model leaf;
    constexpr float kBar = 0.12F;
    constexpr float kSill = 4.4F;
    constexpr float kHead = 5.7F;
    const float foot = 0.12F;
    leaf.add(m.green, make_frame({width_m, height_m - foot}, kBar, 0.10F), place({0.0F, foot, 0.0F}));
    for (const float y : {1.6F, 3.0F, kSill - 0.05F, kHead + 0.05F})
        leaf.add(m.green, make_block({width_m - 2.0F * kBar, 0.08F, 0.08F}), place({0.0F, y, 0.0F}));
    const float half = 0.5F * width_m - kBar;
    for (const float way : {-1.0F, 1.0F}) {
        const glm::vec3 a(-way * half, 1.65F, 0.0F);
        const glm::vec3 b(way * half, kSill - 0.1F, 0.0F);
        leaf.add(m.green, make_block({0.07F, glm::length(b - a), 0.03F}),
                 along(a, b, {0.0F, 0.0F, 1.0F}) * turned({0.0F, 0.5F * glm::length(b - a), 0.0F}, 90.0F, {0, 1, 0}));
    }
    CorrugationShape shape;
    shape.pieces = 6;
    shape.dent_m = 0.02F;
    shape.rows = 6;
    const auto sheet = [&](float low, float high, int own) {
        shape.seed = seed + own;
        Mesh part = make_corrugated_sheet({width_m - 0.1F, high - low}, shape);
        shift_uv(part, {3.0F * hash01(seed, own, 9), 0.0F});
        leaf.add(m.door_sheet, part, place({0.0F, 0.5F * (low + high), -0.07F}));
    };
    sheet(foot, kSill, 1);
    sheet(kHead, height_m, 2);
    leaf.add(make_steel_window(m, {width_m - 2.0F * kBar, kHead - kSill}, 8, 2, seed), place({0.0F, kSill, -0.02F}));
    // Gusset corners, bolts, wheels, handle.
    const Mesh gusset = make_gusset({0.5F, 0.5F}, 0.012F, 4, 4, 0.013F);
    for (const float x : {-half, half})
        for (const float y : {foot + 0.15F, height_m - 0.2F}) leaf.add(m.green, gusset, place({x, y, 0.06F}));
    const Mesh wheel = make_turned({{0.0F, -0.03F},
                                    {0.13F, -0.03F},
                                    {0.13F, -0.02F},
                                    {0.11F, -0.015F},
                                    {0.11F, 0.015F},
                                    {0.13F, 0.02F},
                                    {0.13F, 0.03F},
                                    {0.0F, 0.03F}},
                                   28);
    for (const float x : {-0.35F, 0.35F})
        leaf.add(m.black_iron, wheel, turned({x * width_m, 0.13F, 0.0F}, 90.0F, {1.0F, 0.0F, 0.0F}));
    leaf.add(m.steel, make_pipe(round_corners({{half - 0.2F, 1.0F, 0.05F},
                                               {half - 0.2F, 1.0F, 0.14F},
                                               {half - 0.2F, 1.45F, 0.14F},
                                               {half - 0.2F, 1.45F, 0.05F}},
                                              0.05F, 4),
                                0.014F, 8));
    return leaf;
}

void build_doors(SceneBuilder& builder, const AirShedMaterials& m) {
    constexpr float kWidth = 4.7F;
    const ModelMeshes plain = builder.add_model("door leaf", make_door_leaf(m, kWidth, Size::kDoorHeight + 0.45F, 1));
    const ModelMeshes other =
        builder.add_model("second door leaf", make_door_leaf(m, kWidth, Size::kDoorHeight + 0.45F, 2));
    struct Leaf {
        float x;
        int track;
    };
    const std::vector<Leaf> leaves = {{Size::kDoorGapLow - 0.5F * kWidth, 0},
                                      {-Size::kDoorHalfWidth + 0.5F * kWidth, 1},
                                      {Size::kDoorGapHigh + 0.5F * kWidth, 1},
                                      {Size::kDoorHalfWidth - 0.5F * kWidth, 0},
                                      {Size::kDoorGapHigh + 1.1F * kWidth, 2}};
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const float z = -Size::kHalfLength - 0.22F - 0.24F * static_cast<float>(leaves[i].track);
        builder.place_model("door " + std::to_string(i + 1), i % 2 == 0 ? plain : other, place({leaves[i].x, 0.0F, z}));
    }
    Mesh rails;
    for (int track = 0; track < 3; ++track) {
        const float z = -Size::kHalfLength - 0.22F - 0.24F * static_cast<float>(track);
        append(rails, make_block({2.0F * Size::kHalfWidth, 0.03F, 0.05F}), place({0.0F, 0.012F, z}));
        append(rails, make_block({2.0F * Size::kHalfWidth, 0.22F, 0.05F}), place({0.0F, Size::kDoorHeight + 0.6F, z}));
    }
    builder.place_mesh("door rails", builder.add_mesh(std::move(rails), m.black_iron));
    GirderShape shape;
    shape.depth_m = 0.8F;
    shape.panels = 24;
    Mesh header = make_girder({-Size::kHalfWidth + 0.6F, Size::kDoorHeight + 0.35F, -Size::kHalfLength + 0.2F},
                              {Size::kHalfWidth - 0.6F, Size::kDoorHeight + 0.35F, -Size::kHalfLength + 0.2F},
                              {0.0F, 1.0F, 0.0F}, shape);
    builder.place_mesh("door header", builder.add_mesh(std::move(header), m.girder));
}

}  // namespace

Model make_steel_window(const AirShedMaterials& m, const glm::vec2& size_m, int columns, int rows, int seed) {
    constexpr float kBar = 0.035F;
    constexpr float kDepth = 0.05F;
    Model window;
    window.add(m.window_frame, make_frame(size_m, 0.06F, 0.09F));
    const glm::vec2 pane(size_m.x / static_cast<float>(columns), size_m.y / static_cast<float>(rows));
    for (int i = 1; i < columns; ++i)
        window.add(
            m.window_frame, make_block({kBar, size_m.y, kDepth}),
            place({(static_cast<float>(i) - 0.5F * static_cast<float>(columns)) * pane.x, 0.5F * size_m.y, 0.0F}));
    for (int i = 1; i < rows; ++i)
        window.add(m.window_frame, make_block({size_m.x, kBar, kDepth}),
                   place({0.0F, static_cast<float>(i) * pane.y, 0.001F}));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const glm::vec3 low((static_cast<float>(x) - 0.5F * static_cast<float>(columns)) * pane.x,
                                static_cast<float>(y) * pane.y, -0.008F);
            const float fate = hash01(x, y, seed);
            if (fate < 0.035F) continue;  // the pane is out
            if (fate < 0.06F) {
                window.add(m.plywood, make_block({pane.x, pane.y, 0.012F}), place(low + glm::vec3(0.5F * pane, 0.0F)));
                continue;
            }
            Mesh glass = make_quad(low + glm::vec3(0.0F, pane.y, 0.0F), {pane.x, 0.0F, 0.0F}, {0.0F, -pane.y, 0.0F});
            if (hash01(x, y, seed + 1) < 0.5F)
                for (glm::vec2& uv : glass.uv0) uv.x = 1.0F - uv.x;
            window.add(m.pane, glass);
        }
    // One wing in the middle is tilted open on its upper edge.
    if (rows < 3) return window;
    const glm::vec3 hinge(0.5F * (columns % 2 == 0 ? pane.x : 0.0F), pane.y * static_cast<float>(rows - 1), 0.04F);
    const glm::mat4 tilt = turned(hinge, -28.0F, {1.0F, 0.0F, 0.0F}) * place({0.0F, -pane.y, 0.0F});
    window.add(m.window_frame, make_frame({1.9F * pane.x, pane.y}, 0.03F, 0.03F), tilt);
    window.add(m.steel, make_pipe({hinge + glm::vec3(0.0F, -0.8F * pane.y, 0.02F),
                                   hinge + glm::vec3(0.0F, -0.85F * pane.y, 0.4F)},
                                  0.006F, 6));
    return window;
}

void build_openings(SceneBuilder& builder, const AirShedMaterials& m) {
    const glm::vec2 high(Size::kBay - 0.1F, Size::kClerestoryHigh - Size::kClerestoryLow);
    const glm::vec2 low(Size::kBay - 0.4F, 2.8F);
    std::vector<ModelMeshes> clerestory;
    std::vector<ModelMeshes> windows;
    for (int i = 0; i < 3; ++i) {
        const std::string number = std::to_string(i + 1);
        clerestory.push_back(builder.add_model("clerestory " + number, make_steel_window(m, high, 8, 4, 11 + i)));
        windows.push_back(builder.add_model("window " + number, make_steel_window(m, low, 7, 5, 21 + i)));
    }
    for (const float side : {-1.0F, 1.0F})
        for (int bay = 0; bay < Size::kBays; ++bay) {
            // Bays are counted as build_cladding() does: from +Z on the left wall, from -Z on the right one.
            const float z = side * (-Size::kHalfLength + Size::kBay * (static_cast<float>(bay) + 0.5F));
            const std::string name = std::string(side < 0.0F ? "left" : "right") + " bay " + std::to_string(bay + 1);
            const float yaw = side < 0.0F ? 90.0F : -90.0F;
            const float x = side * (Size::kHalfWidth - 0.02F);
            builder.place_model(name + " clerestory",
                                clerestory[static_cast<std::size_t>((bay * 2 + (side < 0 ? 0 : 1)) % 3)],
                                place({x, Size::kClerestoryLow, z}, yaw));
            if (bay % 2 == 1)
                builder.place_model(name + " window", windows[static_cast<std::size_t>((bay / 2) % 3)],
                                    place({x, 1.6F, z}, yaw));
        }
    Mesh boards;  // beside the lower windows
    for (const float side : {-1.0F, 1.0F})
        for (int bay = 1; bay < Size::kBays; bay += 2)
            for (const float edge : {-1.0F, 1.0F}) {
                const float z = side * (-Size::kHalfLength + Size::kBay * (static_cast<float>(bay) + 0.5F)) +
                                edge * (0.5F * Size::kBay - 0.1F);
                append(boards, make_block({0.04F, 2.8F, 0.2F}), place({side * Size::kHalfWidth, 3.0F, z}));
            }
    builder.place_mesh("window boards", builder.add_mesh(std::move(boards), m.window_frame));
    build_doors(builder, m);
}

}  // namespace macula
