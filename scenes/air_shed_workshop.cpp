#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/air_shed_props.h"
#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

/// Lies on y = 0 along x.
Mesh make_spanner(float length_m) {
    const float w = 0.09F * length_m;
    Mesh spanner = moved(make_bevelled_block({0.75F * length_m, 0.006F, w}, 0.002F), place({0.0F, 0.004F, 0.0F}));
    for (const float side : {-1.0F, 1.0F}) {
        const float x = side * 0.44F * length_m;
        append(spanner, make_turned({{0.0F, 0.0F}, {1.1F * w, 0.0F}, {1.1F * w, 0.008F}, {0.0F, 0.008F}}, 10),
               place({x - side * 0.3F * w, 0.0F, 0.0F}));
        for (const float jaw : {-1.0F, 1.0F})
            append(spanner, make_bevelled_block({1.5F * w, 0.008F, 0.55F * w}, 0.002F),
                   place({x + side * 0.6F * w, 0.004F, jaw * 0.75F * w}, side * jaw * -12.0F));
    }
    return spanner;
}

Model make_hammer(const AirShedMaterials& m) {
    Model hammer;
    hammer.add(m.planks, make_pipe({{-0.15F, 0.02F, 0.0F}, {0.14F, 0.02F, 0.0F}}, 0.014F, 10));
    hammer.add(m.steel, make_bevelled_block({0.035F, 0.035F, 0.11F}, 0.006F), place({0.15F, 0.02F, 0.0F}));
    return hammer;
}

Model make_vice(const AirShedMaterials& m) {
    Model vice;
    vice.add(
        m.blue,
        make_turned({{0.0F, 0.0F}, {0.10F, 0.0F}, {0.10F, 0.03F}, {0.06F, 0.06F}, {0.05F, 0.10F}, {0.0F, 0.10F}}, 20));
    vice.add(m.blue, make_bevelled_block({0.12F, 0.09F, 0.22F}, 0.015F), place({0.0F, 0.14F, -0.02F}));
    vice.add(m.blue, make_bevelled_block({0.12F, 0.10F, 0.06F}, 0.012F), place({0.0F, 0.15F, 0.17F}));
    for (const float z : {0.085F, 0.135F})
        vice.add(m.steel, make_bevelled_block({0.14F, 0.035F, 0.015F}, 0.002F), place({0.0F, 0.19F, z}));
    vice.add(m.steel, make_pipe({{0.0F, 0.12F, 0.05F}, {0.0F, 0.12F, 0.27F}}, 0.018F, 12));
    vice.add(m.chrome, make_pipe({{-0.11F, 0.08F, 0.26F}, {0.11F, 0.16F, 0.26F}}, 0.007F, 8));
    return vice;
}

Mesh make_tin(float radius_m, float height_m) {
    return make_turned({{0.0F, 0.0F},
                        {radius_m, 0.0F},
                        {radius_m, height_m},
                        {0.93F * radius_m, height_m},
                        {0.93F * radius_m, 0.85F * height_m},
                        {0.0F, 0.85F * height_m}},
                       20);
}

/// Closed bottle of glass, 0.3 m high: one surface outside, one inside would need none, it is full.
Mesh make_bottle() {
    return make_turned({{0.0F, 0.0F},
                        {0.034F, 0.0F},
                        {0.038F, 0.006F},
                        {0.038F, 0.17F},
                        {0.034F, 0.195F},
                        {0.016F, 0.225F},
                        {0.014F, 0.29F},
                        {0.017F, 0.293F},
                        {0.017F, 0.30F},
                        {0.0F, 0.30F}},
                       24);
}

}  // namespace

Model make_workbench(const AirShedMaterials& m, int seed) {
    Model bench;
    constexpr float kTop = 0.88F;
    for (int i = 0; i < 5; ++i) {
        Mesh board = make_bevelled_block({3.0F, 0.05F, 0.148F}, 0.004F);
        shift_uv(board, {0.4F * static_cast<float>(i), 0.15F * static_cast<float>(i + seed)});
        tint(board, glm::vec3(0.62F + 0.25F * hash01(i, seed, 54)));
        bench.add(m.planks, board, place({0.0F, kTop - 0.025F, -0.30F + 0.15F * static_cast<float>(i)}));
    }
    for (const float x : {-1.4F, 0.0F, 1.4F}) {
        for (const float z : {-0.3F, 0.3F})
            bench.add(m.planks, make_bevelled_block({0.09F, kTop - 0.05F, 0.09F}, 0.004F),
                      place({x, 0.5F * kTop - 0.025F, z}));
        bench.add(m.planks, make_bevelled_block({0.05F, 0.09F, 0.6F}, 0.004F), place({x, 0.2F, 0.0F}));
    }
    bench.add(m.planks, make_bevelled_block({2.9F, 0.025F, 0.62F}, 0.003F), place({0.0F, 0.26F, 0.0F}));
    bench.add(m.plywood, make_block({3.0F, 1.1F, 0.018F}), place({0.0F, kTop + 0.6F, -0.39F}));
    bench.add(make_vice(m), place({1.15F, kTop, 0.2F}));
    for (int i = 0; i < 9; ++i) {  // spanners on the board behind
        const float length = 0.14F + 0.025F * static_cast<float>(i);
        bench.add(m.chrome, make_spanner(length),
                  place({-1.3F + 0.13F * static_cast<float>(i), kTop + 0.75F, -0.378F}) *
                      turned(glm::vec3(0.0F), 90.0F, {0.0F, 0.0F, 1.0F}) *
                      turned(glm::vec3(0.0F), 90.0F, {1.0F, 0.0F, 0.0F}));
        bench.add(m.steel, make_pipe({{-1.3F + 0.13F * static_cast<float>(i), kTop + 0.75F + 0.44F * length, -0.385F},
                                      {-1.3F + 0.13F * static_cast<float>(i), kTop + 0.75F + 0.44F * length, -0.35F}},
                                     0.003F, 5));
    }
    for (int i = 0; i < 6; ++i) {
        const float x = 0.15F + 0.12F * static_cast<float>(i);
        bench.add(i % 2 == 0 ? m.red : m.yellow,
                  make_turned({{0.0F, 0.0F}, {0.013F, 0.0F}, {0.016F, 0.05F}, {0.012F, 0.10F}, {0.0F, 0.10F}}, 10),
                  place({x, kTop + 0.85F, -0.36F}));
        bench.add(m.chrome,
                  make_pipe({{x, kTop + 0.85F, -0.36F}, {x, kTop + 0.66F - 0.02F * static_cast<float>(i), -0.36F}},
                            0.004F, 6));
    }
    bench.add(make_hammer(m), place({0.35F, kTop, 0.12F}, 35.0F));
    bench.add(m.chrome, make_spanner(0.26F), place({-0.1F, kTop, 0.2F}, -20.0F));
    bench.add(m.chrome, make_spanner(0.20F), place({0.02F, kTop, 0.05F}, 64.0F));
    bench.add(m.red, make_tin(0.05F, 0.13F), place({-0.5F, kTop, -0.2F}));
    bench.add(m.green, make_tin(0.065F, 0.10F), place({-0.68F, kTop, -0.22F}));
    bench.add(m.bottle_glass, make_bottle(), place({-0.9F, kTop + 0.001F, -0.18F}));
    bench.add(m.bottle_glass, make_bottle(), place({-1.02F, kTop + 0.001F, -0.24F}));
    for (int i = 0; i < 3; ++i)
        bench.add(
            m.paper, make_quad({-0.15F, 0.0F, -0.105F}, {0.297F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.21F}),
            place({-0.95F + 0.16F * static_cast<float>(i), kTop + 0.002F + 0.0007F * static_cast<float>(i), 0.14F},
                  12.0F - 17.0F * static_cast<float>(i)));
    bench.add(m.paper, make_quad({-0.2F, 0.28F, 0.0F}, {0.4F, 0.0F, 0.0F}, {0.0F, -0.56F, 0.0F}),
              place({1.1F, kTop + 0.72F, -0.378F}, 0.0F));
    bench.add(make_cardboard_box(m, {0.4F, 0.28F, 0.35F}, seed), place({-0.9F, 0.27F, 0.0F}, 8.0F));
    bench.add(make_jerrycan(m, m.red), place({0.5F, 0.27F, 0.05F}, 80.0F));
    for (int i = 0; i < 3; ++i)
        bench.add(m.grey, make_tin(0.09F, 0.22F), place({-0.35F + 0.21F * static_cast<float>(i), 0.27F, 0.1F}));
    return bench;
}

Model make_tool_trolley(const AirShedMaterials& m, int paint) {
    Model trolley;
    constexpr float kBase = 0.14F;
    trolley.add(paint, make_bevelled_block({0.72F, 0.74F, 0.44F}, 0.008F), place({0.0F, kBase + 0.37F, 0.0F}));
    float y = kBase + 0.03F;
    for (const float height : {0.22F, 0.16F, 0.10F, 0.10F, 0.08F}) {
        trolley.add(paint, make_bevelled_block({0.66F, height - 0.012F, 0.02F}, 0.004F),
                    place({0.0F, y + 0.5F * height, 0.225F}));
        trolley.add(m.chrome, make_pipe(round_corners({{-0.2F, y + 0.7F * height, 0.235F},
                                                       {-0.2F, y + 0.7F * height, 0.26F},
                                                       {0.2F, y + 0.7F * height, 0.26F},
                                                       {0.2F, y + 0.7F * height, 0.235F}},
                                                      0.02F, 3),
                                        0.006F, 6));
        y += height + 0.004F;
    }
    constexpr float kTop = kBase + 0.74F;
    for (const float side : {-1.0F, 1.0F}) {
        trolley.add(paint, make_block({0.004F, 0.05F, 0.44F}), place({side * 0.358F, kTop + 0.025F, 0.0F}));
        trolley.add(paint, make_block({0.72F, 0.05F, 0.004F}), place({0.0F, kTop + 0.025F, side * 0.218F}));
        for (const float z : {-0.16F, 0.16F})
            trolley.add(
                m.rubber,
                make_turned({{0.0F, -0.02F}, {0.06F, -0.02F}, {0.065F, 0.0F}, {0.06F, 0.02F}, {0.0F, 0.02F}}, 20),
                turned({side * 0.3F, 0.065F, z}, 90.0F, {0.0F, 0.0F, 1.0F}));
    }
    trolley.add(m.chrome, make_pipe(round_corners({{0.36F, kTop - 0.1F, -0.18F},
                                                   {0.45F, kTop - 0.05F, -0.18F},
                                                   {0.45F, kTop - 0.05F, 0.18F},
                                                   {0.36F, kTop - 0.1F, 0.18F}},
                                                  0.05F, 4),
                                    0.011F, 8));
    for (int i = 0; i < 5; ++i)
        trolley.add(
            m.chrome, make_spanner(0.15F + 0.03F * static_cast<float>(i)),
            place({-0.15F + 0.06F * static_cast<float>(i), kTop, -0.05F}, 70.0F + 9.0F * static_cast<float>(i)));
    trolley.add(make_hammer(m), place({0.1F, kTop, 0.12F}, -15.0F));
    trolley.add(m.black, make_tin(0.04F, 0.12F), place({-0.27F, kTop, 0.12F}));
    return trolley;
}

Model make_bottle_basket(const AirShedMaterials& m) {
    Model basket;
    for (int x = 0; x < 3; ++x)
        for (int z = 0; z < 2; ++z)
            basket.add(m.bottle_glass, make_bottle(),
                       place({0.1F * static_cast<float>(x - 1), 0.008F, 0.1F * (static_cast<float>(z) - 0.5F)}));
    for (const float y : {0.01F, 0.10F, 0.18F})
        basket.add(m.steel, make_pipe({{-0.17F, y, -0.12F}, {0.17F, y, -0.12F}, {0.17F, y, 0.12F}, {-0.17F, y, 0.12F}},
                                      0.003F, 5, true));
    for (int i = -3; i <= 3; ++i) {
        const float x = 0.055F * static_cast<float>(i);
        basket.add(m.steel, make_pipe({{x, 0.18F, -0.12F}, {x, 0.004F, -0.12F}, {x, 0.004F, 0.12F}, {x, 0.18F, 0.12F}},
                                      0.002F, 4));
    }
    return basket;
}

}  // namespace macula
