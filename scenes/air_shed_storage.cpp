#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_props.h"
#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// A board whose piece of the wood texture is its own.
Mesh make_board(const glm::vec3& size_m, int seed, int index) {
    Mesh board = make_bevelled_block(size_m, 0.0025F);
    shift_uv(board, {1.2F * hash01(seed, index, 41), 0.15F * std::floor(8.0F * hash01(seed, index, 42))});
    tint(board, glm::vec3(0.72F + 0.36F * hash01(seed, index, 43)));
    return board;
}

}  // namespace

Model make_oil_drum(const AirShedMaterials& m, int paint) {
    Model drum;
    constexpr float kR = 0.29F;
    std::vector<glm::vec2> profile = {{0.0F, 0.012F},      {kR - 0.02F, 0.012F}, {kR - 0.012F, 0.0F},
                                      {kR + 0.004F, 0.0F}, {kR + 0.004F, 0.02F}, {kR, 0.025F}};
    for (const float y : {0.29F, 0.59F})
        for (int i = 0; i <= 8; ++i) {
            const float t = static_cast<float>(i) / 8.0F;
            profile.emplace_back(kR + 0.012F * std::sin(0.5F * kTau * t), y - 0.03F + 0.06F * t);
        }
    profile.insert(profile.end(), {{kR, 0.855F},
                                   {kR + 0.004F, 0.86F},
                                   {kR + 0.004F, 0.88F},
                                   {kR - 0.012F, 0.88F},
                                   {kR - 0.02F, 0.865F},
                                   {0.0F, 0.865F}});
    Mesh body = make_turned(profile, 40);
    scale_uv(body, {1.8F, 1.4F});
    drum.add(paint, body);
    for (const glm::vec2 at : {glm::vec2(0.17F, 0.05F), glm::vec2(-0.16F, -0.08F)})
        drum.add(m.steel, make_turned({{0.035F, 0.0F}, {0.035F, 0.015F}, {0.025F, 0.02F}, {0.0F, 0.02F}}, 8),
                 place({at.x, 0.865F, at.y}));
    drum.add(m.decal, make_decal(m, AirShedText::oil, 0.13F), place({0.0F, 0.44F, kR + 0.004F}));
    return drum;
}

Model make_crate(const AirShedMaterials& m, const glm::vec3& size_m, int seed) {
    Model crate;
    constexpr float kBoard = 0.022F;
    int index = 0;
    // Boards on all sides with small gaps, then a frame of battens and a diagonal on the long sides.
    const auto wall = [&](const glm::mat4& space, float width_m, float height_m, bool diagonal) {
        const int count = std::max(3, static_cast<int>(height_m / 0.14F));
        const float pitch = height_m / static_cast<float>(count);
        for (int i = 0; i < count; ++i)
            crate.add(m.planks,
                      make_board({width_m, pitch - 0.004F - 0.006F * hash01(seed, i, 44), kBoard}, seed, index++),
                      space * place({0.0F, (static_cast<float>(i) + 0.5F) * pitch, 0.0F}));
        for (const float side : {-1.0F, 1.0F})
            crate.add(m.planks, make_board({0.09F, height_m, kBoard}, seed, index++),
                      space * place({side * 0.5F * (width_m - 0.09F), 0.5F * height_m, kBoard}));
        for (const float y : {0.045F, height_m - 0.045F})
            crate.add(m.planks, make_board({width_m - 0.18F, 0.09F, kBoard}, seed, index++),
                      space * place({0.0F, y, kBoard}));
        if (!diagonal) return;
        const glm::vec3 a(-0.5F * width_m + 0.12F, 0.10F, kBoard);
        const glm::vec3 b(0.5F * width_m - 0.12F, height_m - 0.10F, kBoard);
        const float length = glm::length(b - a) - 0.08F;
        crate.add(m.planks, make_board({0.09F, length, kBoard - 0.002F}, seed, index++),
                  space * along(a, b, {1.0F, -1.0F, 0.0F}) * place({0.0F, 0.5F * length + 0.04F, 0.0F}));
    };
    wall(place({0.0F, 0.0F, 0.5F * size_m.z}), size_m.x, size_m.y, true);
    wall(place({0.0F, 0.0F, -0.5F * size_m.z}, 180.0F), size_m.x, size_m.y, true);
    wall(place({0.5F * size_m.x, 0.0F, 0.0F}, 90.0F), size_m.z, size_m.y, false);
    wall(place({-0.5F * size_m.x, 0.0F, 0.0F}, -90.0F), size_m.z, size_m.y, false);
    const int lids = std::max(3, static_cast<int>(size_m.z / 0.16F));
    const float pitch = (size_m.z + 0.05F) / static_cast<float>(lids);
    for (int i = 0; i < lids; ++i)
        crate.add(m.planks, make_board({size_m.x + 0.04F, kBoard, pitch - 0.006F}, seed, index++),
                  place({0.0F, size_m.y + 0.5F * kBoard,
                         (static_cast<float>(i) + 0.5F) * pitch - 0.5F * (size_m.z + 0.05F)}));
    const AirShedText texts[] = {AirShedText::fragile, AirShedText::this_side_up, AirShedText::spares};
    const AirShedText text = texts[seed % 3];
    crate.add(m.decal,
              make_decal(m, text, std::min(0.16F, 0.75F * size_m.x / m.text[static_cast<std::size_t>(text)].aspect),
                         {0.03F, 0.03F, 0.035F}),
              place({0.0F, 0.5F * size_m.y, 0.5F * size_m.z + 1.5F * kBoard + 0.002F}));
    return crate;
}

Model make_pallet(const AirShedMaterials& m) {
    Model pallet;
    int index = 0;
    for (int i = 0; i < 7; ++i)
        pallet.add(m.planks, make_board({1.2F, 0.022F, 0.10F}, 5, index++),
                   place({0.0F, 0.133F, -0.35F + 0.1167F * static_cast<float>(i)}));
    for (const float x : {-0.55F, 0.0F, 0.55F}) {
        pallet.add(m.planks, make_board({0.10F, 0.022F, 0.8F}, 5, index++), place({x, 0.111F, 0.0F}));
        pallet.add(m.planks, make_board({0.10F, 0.022F, 0.8F}, 5, index++), place({x, 0.011F, 0.0F}));
        for (const float z : {-0.35F, 0.0F, 0.35F})
            pallet.add(m.planks, make_board({0.10F, 0.078F, 0.10F}, 5, index++), place({x, 0.061F, z}));
    }
    return pallet;
}

Model make_cardboard_box(const AirShedMaterials& m, const glm::vec3& size_m, int seed) {
    Model box;
    Mesh body = make_bevelled_block(size_m, 0.006F);
    shift_uv(body, {hash01(seed, 1, 45), 0.5F * hash01(seed, 2, 45)});
    tint(body, glm::vec3(0.75F + 0.3F * hash01(seed, 3, 45)));
    box.add(m.cardboard, body, place({0.0F, 0.5F * size_m.y, 0.0F}));
    const float label = 0.32F * std::min(size_m.x, size_m.y);
    if (seed % 2 == 0) {
        box.add(m.paper, make_quad({-label, 0.5F * label, 0.0F}, {1.4F * label, 0.0F, 0.0F}, {0.0F, -label, 0.0F}),
                place({0.0F, 0.55F * size_m.y, 0.5F * size_m.z + 0.001F}));
    } else {
        box.add(m.decal,
                make_decal(m, AirShedText::fragile,
                           std::min(0.3F * size_m.y,
                                    0.8F * size_m.x / m.text[static_cast<std::size_t>(AirShedText::fragile)].aspect),
                           {0.3F, 0.03F, 0.02F}),
                place({0.0F, 0.5F * size_m.y, 0.5F * size_m.z + 0.001F}));
    }
    return box;
}

Model make_shelf(const AirShedMaterials& m, int seed) {
    Model shelf;
    constexpr float kWidth = 2.4F;
    constexpr float kDepth = 0.6F;
    constexpr float kHeight = 2.4F;
    const Mesh post = make_angle_bar({0.045F, 0.045F}, 0.003F, kHeight);
    int corner = 0;
    for (const glm::vec2 c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
        shelf.add(m.grey, post,
                  place({c.x * 0.5F * kWidth, 0.0F, c.y * 0.5F * kDepth}, -90.0F * static_cast<float>(corner++)));
    shelf.add(m.steel,
              make_pipe({{-0.5F * kWidth, 0.1F, -0.5F * kDepth}, {0.5F * kWidth, kHeight - 0.1F, -0.5F * kDepth}},
                        0.006F, 6));
    shelf.add(m.steel, make_pipe({{0.5F * kWidth, 0.1F, -0.5F * kDepth - 0.02F},
                                  {-0.5F * kWidth, kHeight - 0.1F, -0.5F * kDepth - 0.02F}},
                                 0.006F, 6));
    const int paints[] = {m.red, m.blue, m.green, m.grey, m.orange, m.white};
    for (int level = 0; level < 5; ++level) {
        const float y = 0.12F + 0.54F * static_cast<float>(level);
        shelf.add(m.grey, make_channel({0.03F, 0.05F}, 0.003F, kWidth),
                  turned({0.5F * kWidth, y - 0.02F, 0.5F * kDepth}, 90.0F, {0.0F, 0.0F, 1.0F}));
        shelf.add(m.plywood, make_bevelled_block({kWidth - 0.01F, 0.02F, kDepth - 0.01F}, 0.002F),
                  place({0.0F, y, 0.0F}));
        float x = -0.5F * kWidth + 0.06F;
        for (int item = 0; x < 0.5F * kWidth - 0.25F; ++item) {
            const int own = seed * 100 + level * 10 + item;
            const float choice = hash01(own, 1, 51);
            const float width = 0.14F + 0.30F * hash01(own, 2, 51);
            const float lie = 12.0F * (hash01(own, 3, 51) - 0.5F);
            const glm::vec3 at(x + 0.5F * width, y + 0.01F, 0.10F * (hash01(own, 4, 51) - 0.5F));
            if (choice < 0.45F) {
                shelf.add(make_cardboard_box(m, {width, 0.16F + 0.24F * hash01(own, 5, 51), 0.36F}, own),
                          place(at, lie));
            } else if (choice < 0.65F) {
                const float r = 0.07F + 0.05F * hash01(own, 6, 51);
                const int paint = paints[own % 6];
                for (int i = 0; i < 2; ++i)
                    shelf.add(
                        paint,
                        make_turned({{0.0F, 0.0F}, {r, 0.0F}, {r, 2.2F * r}, {0.85F * r, 2.25F * r}, {0.0F, 2.25F * r}},
                                    20),
                        place({at.x - 0.03F, at.y, 0.13F - 0.26F * static_cast<float>(i)}));
            } else if (choice < 0.8F) {
                shelf.add(m.planks, make_board({width, 0.16F, 0.4F}, own, 1),
                          place(at + glm::vec3(0.0F, 0.08F, 0.0F), lie));
            } else if (choice < 0.92F) {
                shelf.add(make_jerrycan(m, paints[(own + 1) % 6]), place(at, 90.0F + lie, 0.8F));
            } else {
                for (int i = 0; i < 3; ++i)
                    shelf.add(m.rubber, moved(make_ring(0.13F, 0.035F),
                                              place({at.x, at.y + 0.035F + 0.07F * static_cast<float>(i), at.z})));
                x += 0.12F;
            }
            x += width + 0.03F + 0.12F * hash01(own, 7, 51);
        }
    }
    return shelf;
}

Model make_tyre_stack(const AirShedMaterials& m, int count) {
    Model stack;
    std::vector<glm::vec2> profile;
    for (int i = 0; i <= 18; ++i) {
        const float a = glm::mix(-0.80F, 0.80F, static_cast<float>(i) / 18.0F) * 0.5F * kTau;
        profile.emplace_back(0.34F + 0.12F * std::cos(a), 0.105F + 0.10F * std::sin(a));
    }
    const Mesh tyre = make_turned(profile, 40);
    for (int i = 0; i < count; ++i)
        stack.add(m.rubber, tyre,
                  place({0.03F * (hash01(i, 1, 53) - 0.5F), 0.205F * static_cast<float>(i),
                         0.03F * (hash01(i, 2, 53) - 0.5F)}));
    return stack;
}

Model make_gas_bottle(const AirShedMaterials& m, int paint) {
    Model bottle;
    Mesh body = make_turned({{0.0F, 0.0F},
                             {0.105F, 0.0F},
                             {0.115F, 0.02F},
                             {0.115F, 1.20F},
                             {0.105F, 1.28F},
                             {0.07F, 1.36F},
                             {0.04F, 1.40F},
                             {0.04F, 1.46F},
                             {0.0F, 1.46F}},
                            28);
    scale_uv(body, {0.72F, 1.5F});
    bottle.add(paint, body);
    bottle.add(m.brass, make_turned({{0.018F, 1.46F}, {0.018F, 1.54F}, {0.0F, 1.55F}}, 10));
    bottle.add(m.brass, make_ring(0.03F, 0.007F), place({0.0F, 1.55F, 0.0F}));
    bottle.add(m.brass, make_pipe({{0.0F, 1.49F, 0.0F}, {0.0F, 1.49F, 0.06F}}, 0.012F, 8));
    return bottle;
}

Model make_jerrycan(const AirShedMaterials& m, int paint) {
    Model can;
    can.add(paint, make_bevelled_block({0.16F, 0.40F, 0.34F}, 0.025F), place({0.0F, 0.20F, 0.0F}));
    for (const float side : {-1.0F, 1.0F})
        for (const float way : {-1.0F, 1.0F})
            can.add(paint,
                    make_pipe({{side * 0.081F, 0.08F, way * 0.11F}, {side * 0.081F, 0.32F, -way * 0.11F}}, 0.007F, 6));
    for (const float x : {-0.05F, 0.0F, 0.05F})
        can.add(paint, make_pipe(round_corners(
                                     {{x, 0.395F, -0.09F}, {x, 0.45F, -0.09F}, {x, 0.45F, 0.08F}, {x, 0.395F, 0.08F}},
                                     0.03F, 3),
                                 0.009F, 6));
    can.add(m.steel, make_pipe({{0.0F, 0.38F, 0.13F}, {0.0F, 0.435F, 0.15F}}, 0.028F, 12));
    return can;
}

}  // namespace macula
