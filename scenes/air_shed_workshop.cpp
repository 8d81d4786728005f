#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/air_shed_aircraft.h"
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

Model make_engine_stand(const AirShedMaterials& m) {
    Model stand;
    for (const float side : {-1.0F, 1.0F}) {
        stand.add(m.red, make_bevelled_block({0.08F, 0.08F, 1.5F}, 0.006F), place({side * 0.5F, 0.22F, 0.0F}));
        stand.add(m.red, make_pipe({{side * 0.5F, 0.24F, -0.55F}, {side * 0.22F, 1.25F, -0.52F}}, 0.035F, 12));
        stand.add(m.red, make_pipe({{side * 0.5F, 0.24F, 0.45F}, {side * 0.22F, 1.25F, -0.50F}}, 0.025F, 10));
        for (const float z : {-0.65F, 0.65F}) {
            stand.add(
                m.black_iron,
                make_turned({{0.0F, -0.03F}, {0.085F, -0.03F}, {0.09F, 0.0F}, {0.085F, 0.03F}, {0.0F, 0.03F}}, 24),
                turned({side * 0.5F, 0.09F, z}, 90.0F, {0.0F, 0.0F, 1.0F}));
            stand.add(m.steel, make_block({0.12F, 0.1F, 0.08F}), place({side * 0.5F, 0.14F, z}));
        }
    }
    stand.add(m.red, make_bevelled_block({1.0F, 0.08F, 0.08F}, 0.006F), place({0.0F, 0.22F, -0.6F}));
    std::vector<glm::vec3> ring;
    ring.reserve(28);
    for (int i = 0; i < 28; ++i)
        ring.emplace_back(0.26F * std::cos(kTau * static_cast<float>(i) / 28.0F),
                          1.25F + 0.26F * std::sin(kTau * static_cast<float>(i) / 28.0F), -0.46F);
    stand.add(m.red, make_pipe(ring, 0.03F, 10, true));
    stand.add(make_radial_engine(m), place({0.0F, 1.25F, -0.1F}));
    stand.add(
        m.black,
        make_turned({{0.0F, 0.0F}, {0.3F, 0.0F}, {0.33F, 0.05F}, {0.31F, 0.05F}, {0.29F, 0.015F}, {0.0F, 0.015F}}, 32),
        place({0.0F, 0.002F, 0.0F}));
    return stand;
}

Model make_compressor(const AirShedMaterials& m) {
    Model one;
    const Mesh tank = make_turned(
        {{0.0F, -0.6F}, {0.15F, -0.57F}, {0.22F, -0.48F}, {0.22F, 0.48F}, {0.15F, 0.57F}, {0.0F, 0.6F}}, 32);
    one.add(m.blue, tank, turned({0.0F, 0.45F, 0.0F}, 90.0F, {0.0F, 0.0F, 1.0F}));
    for (const float x : {-0.4F, 0.4F}) one.add(m.blue, make_block({0.05F, 0.3F, 0.3F}), place({x, 0.15F, 0.0F}));
    one.add(m.grey, make_bevelled_block({0.3F, 0.24F, 0.26F}, 0.03F), place({0.25F, 0.80F, 0.0F}));
    for (int i = 0; i < 2; ++i) {
        std::vector<glm::vec2> fins = {{0.05F, -0.01F}};
        for (int k = 0; k < 8; ++k)
            fins.insert(fins.end(), {{0.05F, 0.02F * static_cast<float>(k)},
                                     {0.085F, 0.02F * static_cast<float>(k) + 0.004F},
                                     {0.085F, 0.02F * static_cast<float>(k) + 0.009F},
                                     {0.05F, 0.02F * static_cast<float>(k) + 0.013F}});
        fins.insert(fins.end(), {{0.05F, 0.17F}, {0.0F, 0.17F}});
        one.add(m.steel, make_turned(fins, 18),
                turned({0.25F, 0.90F, 0.0F}, i == 0 ? 32.0F : -32.0F, {1.0F, 0.0F, 0.0F}));
    }
    one.add(m.black,
            make_turned({{0.0F, -0.12F}, {0.11F, -0.12F}, {0.12F, -0.1F}, {0.12F, 0.1F}, {0.11F, 0.12F}, {0.0F, 0.12F}},
                        24),
            turned({-0.28F, 0.80F, 0.0F}, 90.0F, {1.0F, 0.0F, 0.0F}));
    std::vector<glm::vec3> wheel;
    wheel.reserve(32);
    for (int i = 0; i < 32; ++i)
        wheel.emplace_back(0.25F + 0.22F * std::cos(kTau * static_cast<float>(i) / 32.0F),
                           0.86F + 0.22F * std::sin(kTau * static_cast<float>(i) / 32.0F), 0.2F);
    one.add(m.black_iron, make_pipe(wheel, 0.02F, 8, true));
    for (int i = 0; i < 5; ++i)
        one.add(m.black_iron, make_pipe({{0.25F, 0.86F, 0.2F}, wheel[static_cast<std::size_t>(i) * 6]}, 0.014F, 6));
    one.add(m.rubber, make_pipe({{-0.28F, 0.86F, 0.2F}, {0.22F, 1.08F, 0.2F}}, 0.008F, 6));
    one.add(m.rubber, make_pipe({{-0.28F, 0.74F, 0.2F}, {0.22F, 0.64F, 0.2F}}, 0.008F, 6));
    for (const float y : {0.0F, 0.03F, 0.06F})
        one.add(m.rubber, make_ring(0.17F + 0.5F * y, 0.015F), place({0.75F, 0.015F + y, 0.1F}));
    one.add(m.rubber,
            make_pipe(
                round_corners({{0.55F, 0.45F, 0.0F}, {0.68F, 0.45F, 0.02F}, {0.72F, 0.1F, 0.05F}, {0.92F, 0.06F, 0.1F}},
                              0.15F, 5),
                0.012F, 8));
    return one;
}

Model make_cone(const AirShedMaterials& m) {
    Model cone;
    cone.add(m.orange, make_bevelled_block({0.36F, 0.03F, 0.36F}, 0.008F), place({0.0F, 0.015F, 0.0F}));
    const auto ring = [&](float low, float high, int material) {
        const auto radius = [](float y) { return 0.135F - 0.16F * y; };
        cone.add(material, make_turned({{radius(low), low}, {radius(high), high}}, 28));
    };
    ring(0.03F, 0.25F, m.orange);
    ring(0.25F, 0.40F, m.plastic_white);
    ring(0.40F, 0.50F, m.orange);
    ring(0.50F, 0.58F, m.plastic_white);
    ring(0.58F, 0.70F, m.orange);
    return cone;
}

Model make_extinguisher(const AirShedMaterials& m) {
    Model one;
    one.add(m.aircraft_red, make_turned({{0.0F, 0.0F},
                                         {0.07F, 0.0F},
                                         {0.075F, 0.015F},
                                         {0.075F, 0.40F},
                                         {0.06F, 0.46F},
                                         {0.03F, 0.50F},
                                         {0.025F, 0.53F},
                                         {0.0F, 0.53F}},
                                        28));
    one.add(m.black, make_bevelled_block({0.03F, 0.02F, 0.14F}, 0.004F),
            turned({0.0F, 0.57F, 0.02F}, 14.0F, {1.0F, 0.0F, 0.0F}));
    one.add(m.black, make_bevelled_block({0.03F, 0.015F, 0.12F}, 0.004F), place({0.0F, 0.54F, 0.02F}));
    one.add(m.brass, make_pipe({{0.0F, 0.52F, 0.0F}, {0.0F, 0.57F, 0.0F}}, 0.015F, 10));
    one.add(m.rubber,
            make_pipe(round_corners(
                          {{0.0F, 0.55F, 0.02F}, {0.10F, 0.55F, 0.03F}, {0.11F, 0.3F, 0.03F}, {0.09F, 0.12F, 0.04F}},
                          0.05F, 4),
                      0.011F, 8));
    one.add(m.plastic_white, make_quad({-0.05F, 0.34F, 0.0762F}, {0.1F, 0.0F, 0.0F}, {0.0F, -0.12F, 0.0F}));
    return one;
}

Model make_bucket(const AirShedMaterials& m) {
    Model bucket;
    bucket.add(m.galvanized, make_turned({{0.0F, 0.005F},
                                          {0.095F, 0.005F},
                                          {0.10F, 0.0F},
                                          {0.14F, 0.27F},
                                          {0.147F, 0.275F},
                                          {0.14F, 0.28F},
                                          {0.133F, 0.27F},
                                          {0.094F, 0.02F},
                                          {0.0F, 0.02F}},
                                         32));
    std::vector<glm::vec3> handle;
    for (int i = 0; i <= 16; ++i) {
        const float a = 0.5F * kTau * static_cast<float>(i) / 16.0F;
        handle.emplace_back(0.143F * std::cos(a), 0.26F + 0.05F * std::sin(a), 0.13F * std::sin(a));
    }
    bucket.add(m.steel, make_pipe(handle, 0.004F, 6));
    return bucket;
}

Model make_chocks(const AirShedMaterials& m) {
    Model chocks;
    const glm::vec3 lower[] = {{-0.2F, 0.0F, 0.16F}, {0.2F, 0.0F, 0.16F}, {0.2F, 0.0F, -0.16F}, {-0.2F, 0.0F, -0.16F}};
    const glm::vec3 upper[] = {{-0.2F, 0.2F, 0.02F}, {0.2F, 0.2F, 0.02F}, {0.2F, 0.2F, -0.02F}, {-0.2F, 0.2F, -0.02F}};
    const Mesh wedge = make_prism(lower, upper);
    for (const float side : {-1.0F, 1.0F}) chocks.add(m.yellow, wedge, place({0.0F, 0.0F, side * 0.62F}));
    chocks.add(m.rope, make_rope(round_corners({{0.2F, 0.1F, -0.62F},
                                                {0.32F, 0.015F, -0.55F},
                                                {0.38F, 0.015F, 0.0F},
                                                {0.32F, 0.015F, 0.55F},
                                                {0.2F, 0.1F, 0.62F}},
                                               0.15F, 5),
                                 0.012F, 14.0F));
    return chocks;
}

Model make_tractor(const AirShedMaterials& m) {
    Model tractor;
    tractor.add(m.yellow, make_bevelled_block({1.25F, 0.42F, 2.5F}, 0.05F), place({0.0F, 0.62F, 0.0F}));
    tractor.add(m.yellow, make_bevelled_block({1.0F, 0.30F, 1.0F}, 0.06F), place({0.0F, 0.95F, 0.7F}));
    tractor.add(m.black, make_block({0.7F, 0.22F, 0.02F}), place({0.0F, 0.95F, 1.21F}));
    for (int i = 0; i < 9; ++i)
        tractor.add(m.steel, make_block({0.7F, 0.008F, 0.02F}),
                    place({0.0F, 0.86F + 0.022F * static_cast<float>(i), 1.222F}));
    tractor.add(m.black, make_bevelled_block({0.6F, 0.14F, 0.5F}, 0.04F), place({0.0F, 0.9F, -0.45F}));
    tractor.add(m.black, make_bevelled_block({0.6F, 0.5F, 0.12F}, 0.04F),
                turned({0.0F, 1.15F, -0.74F}, -10.0F, {1.0F, 0.0F, 0.0F}));
    tractor.add(m.black, make_pipe({{0.0F, 0.85F, 0.3F}, {0.0F, 1.2F, 0.05F}}, 0.02F, 8));
    tractor.add(m.black, make_ring(0.19F, 0.016F), turned({0.0F, 1.21F, 0.04F}, 35.0F, {1.0F, 0.0F, 0.0F}));
    for (const float x : {-0.62F, 0.62F})
        for (const float z : {-0.8F, 0.8F})
            tractor.add(make_aircraft_wheel(m, 0.36F), place({x, 0.36F, z}, x < 0.0F ? 180.0F : 0.0F));
    for (const float x : {-0.36F, 0.36F}) {
        tractor.add(m.chrome, make_turned({{0.0F, 0.0F}, {0.09F, 0.0F}, {0.10F, 0.06F}, {0.09F, 0.065F}}, 24),
                    turned({x, 1.0F, 1.2F}, 90.0F, {1.0F, 0.0F, 0.0F}));
        tractor.add(m.plastic_white, make_turned({{0.09F, 0.0F}, {0.06F, 0.02F}, {0.0F, 0.03F}}, 20),
                    turned({x, 1.0F, 1.26F}, 90.0F, {1.0F, 0.0F, 0.0F}));
    }
    tractor.add(m.black_iron,
                make_pipe(round_corners({{0.0F, 0.5F, -1.2F}, {0.0F, 0.45F, -1.45F}, {0.0F, 0.55F, -1.5F}}, 0.08F, 3),
                          0.03F, 10));
    tractor.add(m.decal, make_decal(m, AirShedText::keep_clear, 0.16F, {0.02F, 0.02F, 0.02F}),
                turned({0.632F, 0.64F, 0.0F}, 90.0F, {0.0F, 1.0F, 0.0F}));
    tractor.add(m.decal, make_decal(m, AirShedText::keep_clear, 0.16F, {0.02F, 0.02F, 0.02F}),
                turned({-0.632F, 0.64F, 0.0F}, -90.0F, {0.0F, 1.0F, 0.0F}));
    return tractor;
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
