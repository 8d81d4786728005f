#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/air_shed_shell.h"
#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

using Size = AirShedSize;

constexpr float kSheet = 1.0F;  // m, width of a sheet; sheets overlap by a wave

/// Sheet in the plane z = 0 with its lower left corner in the origin; each has its own dents, tint and piece of
/// texture.
Mesh make_own_sheet(const glm::vec2& size_m, int seed, int rows) {
    CorrugationShape shape;
    shape.pieces = 6;
    shape.rows = rows;
    shape.dent_m = 0.012F;
    shape.seed = seed;
    Mesh sheet = make_corrugated_sheet(size_m + glm::vec2(shape.pitch_m, 0.0F), shape);
    shift_uv(sheet, {3.0F * hash01(seed, 2, 9), std::floor(3.0F * hash01(seed, 4, 9)) * 1.0F});
    tint(sheet, glm::vec3(0.78F + 0.22F * hash01(seed, 3, 9)));
    // Odd sheets lie on top of their neighbours.
    return moved(sheet, place({0.5F * size_m.x, 0.5F * size_m.y, seed % 2 == 0 ? 0.0F : 0.004F}));
}

/// Wall of sheets from z to z along the side walls or x along the gables, between two heights.
void add_sheets(Mesh& wall, const glm::mat4& world_from_wall, float length_m, float low_m, float high_m, int seed) {
    const int count = static_cast<int>(std::round(length_m / kSheet));
    const int rows = std::max(2, static_cast<int>((high_m - low_m) / 1.2F));
    for (int i = 0; i < count; ++i)
        append(wall, make_own_sheet({length_m / static_cast<float>(count), high_m - low_m}, seed + i, rows),
               world_from_wall * place({length_m * static_cast<float>(i) / static_cast<float>(count), low_m, 0.0F}));
}

/// Space of a wall whose x runs along it and whose z looks inside.
glm::mat4 left_wall() {
    return place({-Size::kHalfWidth, 0.0F, Size::kHalfLength}, 90.0F);
}
glm::mat4 right_wall() {
    return place({Size::kHalfWidth, 0.0F, -Size::kHalfLength}, -90.0F);
}
glm::mat4 back_wall() {
    return place({Size::kHalfWidth, 0.0F, Size::kHalfLength}, 180.0F);
}
glm::mat4 front_wall() {
    return place({-Size::kHalfWidth, 0.0F, -Size::kHalfLength});
}

/// The triangle between the eaves and the roof: sheets whose upper ends follow the slope.
void add_gable(Mesh& wall, const glm::mat4& world_from_wall, float low_m, int seed) {
    constexpr int kCount = 36;
    for (int i = 0; i < kCount; ++i) {
        const float x0 = 2.0F * Size::kHalfWidth * static_cast<float>(i) / kCount;
        const float middle = std::abs(x0 + 0.5F - Size::kHalfWidth);
        const float high = glm::mix(Size::kRidge, Size::kEaves, middle / Size::kHalfWidth) + 0.1F;
        append(wall, make_own_sheet({1.0F, high - low_m}, seed + i, 3), world_from_wall * place({x0, low_m, 0.0F}));
    }
}

void build_roof(SceneBuilder& builder, const AirShedMaterials& m) {
    constexpr int kRows = 3;
    const int count = static_cast<int>(2.0F * Size::kHalfLength / kSheet);
    const glm::vec2 slope(Size::kHalfWidth + 0.3F, Size::kRidge - Size::kEaves);
    const float slope_m = glm::length(slope);
    const float angle = glm::degrees(std::atan2(slope.y, slope.x));
    for (const bool left : {true, false}) {
        Mesh sheets;
        Mesh skylights;
        // y of the sheet's space runs up the slope, z looks inside.
        glm::mat4 world_from_slope = left ? place({-Size::kHalfWidth - 0.3F, Size::kEaves, Size::kHalfLength}, 90.0F)
                                          : place({Size::kHalfWidth + 0.3F, Size::kEaves, -Size::kHalfLength}, -90.0F);
        world_from_slope = glm::rotate(world_from_slope, glm::radians(90.0F - angle), glm::vec3(1.0F, 0.0F, 0.0F));
        for (int row = 0; row < kRows; ++row)
            for (int i = 0; i < count; ++i) {
                const bool light = row == 1 && i % 4 == 1 && hash01(i, row, left ? 5 : 6) < 0.93F;
                const glm::mat4 at =
                    world_from_slope * place({static_cast<float>(i) * kSheet, slope_m * static_cast<float>(row) / kRows,
                                              0.006F * static_cast<float>(row)});
                const int seed = 1000 * row + 2 * i + (left ? 0 : 5000) + (i % 2);
                append(light ? skylights : sheets, make_own_sheet({kSheet, slope_m / kRows + 0.08F}, seed, 3), at);
            }
        const std::string side = left ? "left" : "right";
        for (glm::vec4& c : skylights.color) c = glm::vec4(1.0F);
        builder.place_mesh(side + " roof", builder.add_mesh(std::move(sheets), m.roof_sheet));
        builder.place_mesh(side + " skylights", builder.add_mesh(std::move(skylights), m.skylight));
    }
    Mesh ridge;
    for (const float side : {-1.0F, 1.0F})
        append(ridge, make_block({0.5F, 0.004F, 2.0F * Size::kHalfLength}),
               turned({side * 0.24F, Size::kRidge + 0.03F, 0.0F}, -side * angle, {0.0F, 0.0F, 1.0F}));
    builder.place_mesh("ridge", builder.add_mesh(std::move(ridge), m.galvanized));
}

void build_plinth(SceneBuilder& builder, const AirShedMaterials& m) {
    Mesh bricks;
    Mesh coping;
    const float length = 2.0F * Size::kHalfLength;
    constexpr float kThick = 0.24F;
    for (const float side : {-1.0F, 1.0F}) {
        const float x = side * (Size::kHalfWidth + 0.02F);
        append(bricks, make_block({kThick, Size::kPlinth, length}), place({x, 0.5F * Size::kPlinth, 0.0F}));
        append(coping, make_bevelled_block({kThick + 0.08F, 0.06F, length}, 0.01F),
               place({x, Size::kPlinth + 0.03F, 0.0F}));
        const float jamb = Size::kDoorHalfWidth + 0.5F * (Size::kHalfWidth - Size::kDoorHalfWidth);
        append(bricks, make_block({Size::kHalfWidth - Size::kDoorHalfWidth, Size::kPlinth, kThick}),
               place({side * jamb, 0.5F * Size::kPlinth, -Size::kHalfLength - 0.02F}));
    }
    append(bricks, make_block({2.0F * Size::kHalfWidth, 3.0F, kThick}), place({0.0F, 1.5F, Size::kHalfLength + 0.02F}));
    append(coping, make_bevelled_block({2.0F * Size::kHalfWidth, 0.06F, kThick + 0.08F}, 0.01F),
           place({0.0F, 3.03F, Size::kHalfLength + 0.02F}));
    builder.place_mesh("plinth", builder.add_mesh(std::move(bricks), m.brick));
    builder.place_mesh("coping", builder.add_mesh(std::move(coping), m.joint));
}

}  // namespace

void build_cladding(SceneBuilder& builder, const AirShedMaterials& m) {
    build_roof(builder, m);
    build_plinth(builder, m);
    const float length = 2.0F * Size::kHalfLength;
    const auto side_wall = [&](const std::string& name, const glm::mat4& space, int seed, bool windows_below) {
        Mesh wall;
        for (int bay = 0; bay < Size::kBays; ++bay) {
            // Every other bay of one wall has a large window below, from 1.6 m to 4.4 m: build_openings() fills it.
            const glm::mat4 at = space * place({Size::kBay * static_cast<float>(bay), 0.0F, 0.0F});
            const int own = seed + 100 * bay;
            if (windows_below && bay % 2 == 1) {
                add_sheets(wall, at, Size::kBay, Size::kPlinth, 1.6F, own);
                add_sheets(wall, at, Size::kBay, 4.4F, Size::kClerestoryLow, own + 50);
            } else {
                add_sheets(wall, at, Size::kBay, Size::kPlinth, Size::kClerestoryLow, own);
            }
        }
        add_sheets(wall, space, length, Size::kClerestoryHigh, Size::kEaves + 0.05F, seed + 2000);
        builder.place_mesh(name, builder.add_mesh(std::move(wall), m.wall_sheet));
    };
    side_wall("left wall", left_wall(), 10000, true);
    side_wall("right wall", right_wall(), 20000, true);

    Mesh back;
    add_sheets(back, back_wall(), 2.0F * Size::kHalfWidth, 3.0F, Size::kEaves, 30000);
    add_gable(back, back_wall(), Size::kEaves - 0.08F, 31000);
    builder.place_mesh("back wall", builder.add_mesh(std::move(back), m.wall_sheet));

    Mesh front;
    const float jamb = Size::kHalfWidth - Size::kDoorHalfWidth;
    add_sheets(front, front_wall(), jamb, Size::kPlinth, Size::kEaves, 40000);
    add_sheets(front, front_wall() * place({2.0F * Size::kHalfWidth - jamb, 0.0F, 0.0F}), jamb, Size::kPlinth,
               Size::kEaves, 41000);
    add_sheets(front, front_wall() * place({jamb, 0.0F, 0.0F}), 2.0F * Size::kDoorHalfWidth, Size::kDoorHeight + 0.5F,
               Size::kEaves, 42000);
    add_gable(front, front_wall(), Size::kEaves - 0.08F, 43000);
    builder.place_mesh("front wall", builder.add_mesh(std::move(front), m.wall_sheet));
}

}  // namespace macula
