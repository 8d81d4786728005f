#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_aircraft.h"
#include "scenes/air_shed_props.h"
#include "scenes/mesh_edit.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

}  // namespace

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

}  // namespace macula
