#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_lamps.h"
#include "scenes/air_shed_props.h"
#include "scenes/air_shed_shell.h"
#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

using Size = AirShedSize;
constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// Crane bridge across the shed on runway beams, with a trolley and a chain hoist whose hook hangs at `hook_m`.
void build_crane(SceneBuilder& builder, const AirShedMaterials& m) {
    constexpr float kZ = 7.5F;
    constexpr float kY = 7.0F;
    constexpr float kX = 5.2F;
    constexpr float kHook = 3.1F;
    Model crane;
    for (const float side : {-1.0F, 1.0F}) {
        crane.add(m.girder,
                  moved(make_i_beam({0.4F, 0.2F}, 0.015F, 2.0F * Size::kHalfLength - 1.0F),
                        turned({side * 16.9F, kY + 0.25F, Size::kHalfLength - 0.5F}, -90.0F, {1.0F, 0.0F, 0.0F}) *
                            turned(glm::vec3(0.0F), 90.0F, {0.0F, 1.0F, 0.0F})));
        crane.add(m.yellow, moved(make_i_beam({0.45F, 0.18F}, 0.014F, 33.6F),
                                  turned({16.8F, kY + 0.7F, kZ + side * 0.55F}, 90.0F, {0.0F, 0.0F, 1.0F})));
        crane.add(m.yellow, make_bevelled_block({0.35F, 0.35F, 2.4F}, 0.02F), place({side * 16.9F, kY + 0.63F, kZ}));
        for (const float z : {-0.9F, 0.9F})
            crane.add(m.black_iron, make_turned({{0.0F, -0.05F}, {0.16F, -0.05F}, {0.16F, 0.05F}, {0.0F, 0.05F}}, 24),
                      turned({side * 16.9F, kY + 0.45F, kZ + z}, 90.0F, {0.0F, 0.0F, 1.0F}));
    }
    crane.add(m.yellow, make_bevelled_block({1.2F, 0.35F, 0.9F}, 0.02F), place({kX, kY + 0.45F, kZ}));
    crane.add(
        m.grey,
        moved(make_turned({{0.0F, -0.4F}, {0.2F, -0.38F}, {0.22F, -0.3F}, {0.22F, 0.3F}, {0.2F, 0.38F}, {0.0F, 0.4F}},
                          28),
              turned({kX, kY + 0.05F, kZ}, 90.0F, {0.0F, 0.0F, 1.0F})));
    crane.add(m.decal, make_decal(m, AirShedText::hoist, 0.3F, {0.03F, 0.03F, 0.03F}),
              place({kX, kY + 0.45F, kZ + 0.452F}));
    for (const float x : {-0.06F, 0.06F})
        crane.add(
            m.steel,
            make_chain(std::vector<glm::vec3>{{kX + x, kY - 0.15F, kZ}, {kX + 0.4F * x, kHook + 0.35F, kZ}}, 0.0075F));
    // Hand chain: a loop that hangs beside the hoist.
    std::vector<glm::vec3> loop = {{kX + 0.35F, kY, kZ + 0.1F},
                                   {kX + 0.36F, 1.3F, kZ + 0.12F},
                                   {kX + 0.42F, 1.15F, kZ + 0.12F},
                                   {kX + 0.48F, 1.3F, kZ + 0.12F},
                                   {kX + 0.5F, kY, kZ + 0.1F}};
    crane.add(m.steel, make_chain(loop, 0.005F));
    crane.add(m.red, make_bevelled_block({0.12F, 0.22F, 0.16F}, 0.02F), place({kX, kHook + 0.25F, kZ}));
    crane.add(m.steel, make_pipe({{kX - 0.09F, kHook + 0.25F, kZ}, {kX + 0.09F, kHook + 0.25F, kZ}}, 0.07F, 16));
    std::vector<glm::vec3> hook = {{kX, kHook + 0.15F, kZ}, {kX, kHook + 0.05F, kZ}};
    for (int i = 0; i <= 12; ++i) {
        const float a = kTau * (0.20F - 0.70F * static_cast<float>(i) / 12.0F);
        hook.emplace_back(kX + 0.075F * std::cos(a), kHook - 0.07F + 0.085F * std::sin(a), kZ);
    }
    crane.add(m.steel, make_pipe(hook, 0.019F, 10));
    crane.add(m.red_glow, make_turned({{0.07F, 0.0F}, {0.07F, 0.06F}, {0.04F, 0.11F}, {0.0F, 0.12F}}, 16),
              place({kX, kY + 0.62F, kZ + 0.3F}));
    // Cable festoon along the bridge.
    for (int i = 0; i < 11; ++i) {
        const float x0 = -16.0F + 1.9F * static_cast<float>(i);
        crane.add(m.rubber,
                  make_pipe(hanging_path({x0, kY + 0.45F, kZ + 0.75F}, {x0 + 1.9F, kY + 0.45F, kZ + 0.75F}, 0.55F, 16),
                            0.014F, 6));
        crane.add(m.steel, make_block({0.05F, 0.1F, 0.03F}), place({x0, kY + 0.48F, kZ + 0.75F}));
    }
    crane.add(
        m.rubber,
        make_pipe(hanging_path({kX + 0.8F, kY + 0.3F, kZ + 0.5F}, {kX + 0.95F, 1.4F, kZ + 0.6F}, 0.0F, 4), 0.012F, 6));
    crane.add(m.yellow, make_bevelled_block({0.08F, 0.26F, 0.06F}, 0.012F), place({kX + 0.95F, 1.28F, kZ + 0.6F}));
    builder.add_placed("crane", crane);
}

/// Round duct with flanges and outlets along the right wall, and pipes along both.
void build_pipes(SceneBuilder& builder, const AirShedMaterials& m) {
    Model services;
    constexpr float kX = 14.6F;
    constexpr float kY = 7.2F;
    for (int i = 0; i < 16; ++i) {
        const float z = -25.0F + 3.0F * static_cast<float>(i);
        Mesh duct = make_turned({{0.40F, 0.0F},
                                 {0.40F, 0.74F},
                                 {0.412F, 0.745F},
                                 {0.412F, 0.755F},
                                 {0.40F, 0.76F},
                                 {0.40F, 2.24F},
                                 {0.412F, 2.245F},
                                 {0.412F, 2.255F},
                                 {0.40F, 2.26F},
                                 {0.40F, 3.0F}},
                                32);
        scale_uv(duct, {2.5F, 3.0F});
        services.add(m.galvanized, duct, turned({kX, kY, z}, 90.0F, {1.0F, 0.0F, 0.0F}));
        services.add(m.galvanized, make_turned({{0.40F, 0.0F}, {0.46F, 0.0F}, {0.46F, 0.03F}, {0.40F, 0.03F}}, 32),
                     turned({kX, kY, z}, 90.0F, {1.0F, 0.0F, 0.0F}));
        std::vector<glm::vec3> strap;
        for (int k = 0; k <= 16; ++k) {
            const float a = kTau * (0.5F + 0.5F * static_cast<float>(k) / 16.0F);
            strap.emplace_back(kX + 0.42F * std::cos(a), kY + 0.42F * std::sin(a), z + 1.5F);
        }
        services.add(m.steel, make_pipe(strap, 0.012F, 6));
        for (const float side : {-0.42F, 0.42F})
            services.add(m.steel, make_pipe({{kX + side, kY, z + 1.5F}, {kX + side, 8.2F, z + 1.5F}}, 0.006F, 6));
        if (i % 2 == 1) {
            services.add(m.galvanized, make_turned({{0.16F, 0.0F}, {0.20F, 0.18F}, {0.15F, 0.5F}}, 24),
                         turned({kX - 0.1F, kY - 0.78F, z + 0.8F}, 12.0F, {0.0F, 0.0F, 1.0F}));
        }
    }
    for (const float side : {-1.0F, 1.0F}) {
        const float x = side * 17.55F;
        for (int k = 0; k < 3; ++k) {
            const float r = 0.05F - 0.012F * static_cast<float>(k);
            const float y = 4.75F - 0.16F * static_cast<float>(k);
            services.add(k == 0 ? m.red : (k == 1 ? m.blue : m.galvanized),
                         make_pipe({{x, y, -27.0F}, {x, y, 27.0F}}, r, 12));
            for (int i = 0; i < 18; ++i) {
                const float z = -25.5F + 3.0F * static_cast<float>(i);
                services.add(m.steel, make_turned({{r + 0.008F, 0.0F}, {r + 0.008F, 0.04F}}, 12),
                             turned({x, y, z}, 90.0F, {1.0F, 0.0F, 0.0F}));
                services.add(m.steel, make_block({0.3F, 0.02F, 0.03F}),
                             place({x + side * 0.14F, y - r - 0.012F, z + 0.02F}));
            }
        }
        for (int i = 0; i < 4; ++i) {  // droppers with valves
            const float z = -20.0F + 12.0F * static_cast<float>(i) + side;
            services.add(m.blue, make_pipe(round_corners({{x, 4.59F, z},
                                                          {x - side * 0.05F, 4.2F, z},
                                                          {x - side * 0.05F, 1.1F, z},
                                                          {x - side * 0.22F, 1.05F, z}},
                                                         0.12F, 4),
                                           0.025F, 10));
            services.add(m.red, make_ring(0.07F, 0.010F),
                         turned({x - side * 0.14F, 1.5F, z}, 90.0F, {0.0F, 0.0F, 1.0F}));
            services.add(m.brass, make_pipe({{x - side * 0.03F, 1.5F, z}, {x - side * 0.14F, 1.5F, z}}, 0.02F, 8));
            services.add(m.rubber, make_coil(0.22F, 0.014F, 0.16F, 5.0F),
                         turned({x - side * 0.20F, 1.0F, z + 0.5F}, side * 90.0F, {0.0F, 0.0F, 1.0F}));
        }
    }
    // Fire main with hydrant and a heater with its flue.
    services.add(
        m.red,
        make_pipe(round_corners({{17.3F, 0.0F, 5.0F}, {17.3F, 1.1F, 5.0F}, {17.3F, 1.15F, 5.4F}}, 0.1F, 4), 0.06F, 14));
    builder.add_placed("services", services);
}

/// Things on the walls and ropes between them.
void build_wall_things(SceneBuilder& builder, const AirShedMaterials& m) {
    Model things;
    const auto back = [](const glm::vec3& at) {
        return turned({at.x, at.y, Size::kHalfLength - 0.12F - at.z}, 180.0F, {0.0F, 1.0F, 0.0F});
    };
    const auto right = [](const glm::vec3& at) {
        return turned({Size::kHalfWidth - 0.14F - at.x, at.y, at.z}, -90.0F, {0.0F, 1.0F, 0.0F});
    };
    things.add(m.decal, make_decal(m, AirShedText::hangar, 1.6F, {0.85F, 0.83F, 0.76F}), back({0.0F, 6.6F, 0.06F}));
    for (const float x : {-8.0F, 8.0F})
        things.add(m.decal, make_decal(m, AirShedText::no_smoking, 0.7F, {0.6F, 0.06F, 0.04F}), back({x, 4.6F, 0.06F}));
    for (int i = 0; i < 5; ++i) {  // switch cabinets with conduits
        const float z = -10.0F + 6.0F * static_cast<float>(i);
        things.add(m.grey, make_bevelled_block({0.5F, 0.7F, 0.2F}, 0.01F), right({0.1F, 2.0F, z - 2.0F}));
        things.add(m.black, make_bevelled_block({0.06F, 0.14F, 0.04F}, 0.008F), right({0.23F, 2.0F, z - 1.86F}));
        things.add(m.galvanized, make_pipe({{17.76F, 2.35F, z - 2.0F}, {17.76F, 7.4F, z - 2.0F}}, 0.018F, 8));
        things.add(m.yellow, make_block({0.14F, 0.14F, 0.004F}), right({0.203F, 2.2F, z - 2.05F}));
    }
    things.add(m.plywood, make_block({2.2F, 1.3F, 0.03F}), right({0.0F, 2.0F, 9.4F}));  // notice board
    for (int i = 0; i < 9; ++i)
        things.add(m.paper, make_quad({-0.15F, 0.21F, 0.0F}, {0.30F, 0.0F, 0.0F}, {0.0F, -0.42F, 0.0F}),
                   right({0.018F + 0.001F * static_cast<float>(i),
                          1.75F + 0.5F * static_cast<float>(i % 2) + 0.05F * hash01(i, 1, 57),
                          8.55F + 0.21F * static_cast<float>(i)}) *
                       turned(glm::vec3(0.0F), 8.0F * (hash01(i, 2, 57) - 0.5F), {0.0F, 0.0F, 1.0F}));
    // Clock.
    things.add(m.black, make_turned({{0.0F, 0.0F}, {0.42F, 0.0F}, {0.45F, 0.05F}, {0.42F, 0.08F}, {0.40F, 0.06F}}, 48),
               back({0.0F, 4.7F, 0.0F}) * turned(glm::vec3(0.0F), 90.0F, {1.0F, 0.0F, 0.0F}));
    things.add(m.plastic_white, make_turned({{0.41F, 0.0F}, {0.0F, 0.001F}}, 48),
               back({0.0F, 4.7F, 0.05F}) * turned(glm::vec3(0.0F), 90.0F, {1.0F, 0.0F, 0.0F}));
    for (int i = 0; i < 12; ++i)
        things.add(m.black, make_block({i % 3 == 0 ? 0.03F : 0.014F, 0.06F, 0.004F}),
                   back({0.0F, 4.7F, 0.056F}) *
                       turned(glm::vec3(0.0F), 30.0F * static_cast<float>(i), {0.0F, 0.0F, 1.0F}) *
                       place({0.0F, 0.34F, 0.0F}));
    things.add(
        m.black, make_block({0.025F, 0.22F, 0.004F}),
        back({0.0F, 4.7F, 0.062F}) * turned(glm::vec3(0.0F), 55.0F, {0.0F, 0.0F, 1.0F}) * place({0.0F, 0.09F, 0.0F}));
    things.add(
        m.black, make_block({0.016F, 0.32F, 0.004F}),
        back({0.0F, 4.7F, 0.067F}) * turned(glm::vec3(0.0F), -80.0F, {0.0F, 0.0F, 1.0F}) * place({0.0F, 0.13F, 0.0F}));
    things.add(m.green, make_bevelled_block({1.1F, 2.2F, 0.06F}, 0.01F), back({-11.0F, 1.1F, 0.0F}));
    things.add(m.green, make_bevelled_block({0.6F, 0.22F, 0.12F}, 0.01F), back({-11.0F, 2.5F, 0.05F}));
    things.add(m.decal, make_decal(m, AirShedText::exit, 0.2F), back({-11.0F, 2.5F, 0.112F}));
    // Coils of rope and cable on hooks, ropes over the trusses.
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 at(-17.4F, 2.0F, -6.0F + 8.0F * static_cast<float>(i));
        things.add(m.steel,
                   make_pipe({at + glm::vec3(-0.3F, 0.2F, 0.0F), at + glm::vec3(0.05F, 0.22F, 0.0F)}, 0.012F, 6));
        for (int k = 0; k < 4; ++k) {
            std::vector<glm::vec3> loop;
            for (int j = 0; j <= 20; ++j) {
                const float a = kTau * static_cast<float>(j) / 20.0F;
                loop.emplace_back(at.x - 0.03F * static_cast<float>(k), at.y - 0.12F + 0.36F * std::cos(a),
                                  at.z + (0.16F + 0.015F * static_cast<float>(k)) * std::sin(a));
            }
            things.add(i % 2 == 0 ? m.rope : m.rubber,
                       i % 2 == 0 ? make_rope(loop, 0.012F, 8.0F) : make_pipe(loop, 0.012F, 6));
        }
    }
    things.add(m.rope,
               make_rope(round_corners({{-12.0F, 8.2F, 2.6F}, {-12.02F, 2.2F, 2.62F}, {-12.6F, 1.3F, 2.8F}}, 0.5F, 5),
                         0.014F, 9.0F));
    // Slack wires from truss to truss.
    for (int i = 0; i < 13; ++i) {
        const float z = -Size::kHalfLength + 0.3F + 3.957F * static_cast<float>(i);
        for (const float x : {-6.0F, 6.2F, 12.0F})
            things.add(m.rubber, make_pipe(hanging_path({x, Size::kTie - 0.02F, z}, {x, Size::kTie - 0.02F, z + 3.957F},
                                                        0.12F + 0.1F * hash01(i, static_cast<int>(x), 58), 8),
                                           0.009F, 5));
    }
    // Hoses and a cable that lie where work is done.
    const auto lie = [&things](int material, float radius_m, std::initializer_list<glm::vec3> path) {
        things.add(material, make_pipe(round_corners(path, 1.2F, 8), radius_m, 8));
    };
    lie(m.rubber, 0.014F,
        {{4.8F, 0.016F, 3.2F}, {5.6F, 0.016F, 4.6F}, {3.4F, 0.016F, 5.8F}, {0.6F, 0.016F, 2.9F}, {0.0F, 0.016F, 0.6F}});
    lie(m.orange, 0.010F, {{17.2F, 0.012F, 7.6F}, {12.0F, 0.012F, 6.9F}, {9.0F, 0.012F, 8.2F}, {6.9F, 0.012F, 6.9F}});
    lie(m.orange, 0.010F,
        {{-17.2F, 0.012F, 0.4F}, {-12.4F, 0.012F, 3.6F}, {-8.8F, 0.012F, 2.2F}, {-8.0F, 0.012F, -0.4F}});
    builder.add_placed("wall things", things);
}

}  // namespace

Model make_high_bay_lamp(const AirShedMaterials& m, float drop_m) {
    Model lamp;
    lamp.add(m.steel, make_chain(std::vector<glm::vec3>{{0.0F, 0.0F, 0.0F}, {0.0F, -drop_m + 0.42F, 0.0F}}, 0.006F));
    lamp.add(m.rubber,
             make_pipe(hanging_path({0.04F, 0.0F, 0.0F}, {0.03F, -drop_m + 0.42F, 0.0F}, 0.0F, 3), 0.006F, 5));
    lamp.add(m.green,
             make_turned({{0.30F, -0.06F},
                          {0.29F, 0.02F},
                          {0.24F, 0.14F},
                          {0.12F, 0.24F},
                          {0.07F, 0.27F},
                          {0.07F, 0.42F},
                          {0.0F, 0.43F}},
                         32),
             place({0.0F, -drop_m, 0.0F}));
    lamp.add(m.plastic_white,
             make_turned({{0.06F, 0.23F}, {0.115F, 0.23F}, {0.235F, 0.135F}, {0.285F, 0.02F}, {0.297F, -0.06F}}, 32),
             place({0.0F, -drop_m, 0.0F}) * glm::mat4(-1.0F, 0, 0, 0, 0, 1.0F, 0, 0, 0, 0, 1.0F, 0, 0, 0, 0, 1.0F));
    lamp.add(m.lamp_glow,
             make_turned(
                 {{0.0F, -0.03F}, {0.05F, -0.01F}, {0.075F, 0.05F}, {0.06F, 0.12F}, {0.03F, 0.2F}, {0.0F, 0.2F}}, 20),
             place({0.0F, -drop_m, 0.0F}));
    for (int i = 0; i < 8; ++i) {
        const float a = kTau * static_cast<float>(i) / 8.0F;
        const glm::vec3 out(std::cos(a), 0.0F, std::sin(a));
        lamp.add(m.steel, make_pipe({0.298F * out + glm::vec3(0.0F, -drop_m - 0.06F, 0.0F),
                                     0.2F * out + glm::vec3(0.0F, -drop_m - 0.14F, 0.0F),
                                     glm::vec3(0.0F, -drop_m - 0.16F, 0.0F)},
                                    0.003F, 4));
    }
    return lamp;
}

Model make_tube_lamp(const AirShedMaterials& m, float drop_m) {
    Model lamp;
    for (const float x : {-0.6F, 0.6F})
        lamp.add(m.steel, make_pipe({{x, 0.0F, 0.0F}, {x, -drop_m + 0.06F, 0.0F}}, 0.003F, 4));
    lamp.add(m.white, make_bevelled_block({1.5F, 0.06F, 0.09F}, 0.006F), place({0.0F, -drop_m + 0.03F, 0.0F}));
    for (const float side : {-1.0F, 1.0F}) {
        lamp.add(m.white, make_block({1.5F, 0.004F, 0.12F}),
                 turned({0.0F, -drop_m - 0.01F, side * 0.10F}, side * 24.0F, {1.0F, 0.0F, 0.0F}));
        lamp.add(
            m.tube_glow,
            make_pipe({{-0.72F, -drop_m - 0.03F, side * 0.05F}, {0.72F, -drop_m - 0.03F, side * 0.05F}}, 0.016F, 12));
        for (const float x : {-0.735F, 0.735F})
            lamp.add(m.plastic_white, make_block({0.03F, 0.07F, 0.04F}), place({x, -drop_m - 0.015F, side * 0.05F}));
    }
    return lamp;
}

void build_services(SceneBuilder& builder, const AirShedMaterials& m) {
    build_crane(builder, m);
    build_pipes(builder, m);
    build_wall_things(builder, m);
    const ModelMeshes bay = builder.add_model("high-bay lamp", make_high_bay_lamp(m, AirShedLamps::kHighBayDrop));
    int index = 0;
    for (const glm::vec3& at : AirShedLamps::kHighBays)
        builder.place_model("high-bay lamp " + std::to_string(++index), bay, place(at));
    const ModelMeshes tube = builder.add_model("tube lamp", make_tube_lamp(m, AirShedLamps::kTubeDrop));
    index = 0;
    for (const glm::vec3& at : AirShedLamps::kTubes)
        builder.place_model("tube lamp " + std::to_string(++index), tube, place(at, 90.0F));
}

}  // namespace macula
