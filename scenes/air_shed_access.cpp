#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_props.h"
#include "scenes/mesh_edit.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

/// Castor under the origin, its wheel on y = 0, fork up to `height_m`.
Model make_castor(const AirShedMaterials& m, float height_m) {
    Model castor;
    const float r = 0.38F * height_m;
    castor.add(
        m.rubber,
        make_turned({{0.0F, -0.02F}, {0.9F * r, -0.02F}, {r, -0.012F}, {r, 0.012F}, {0.9F * r, 0.02F}, {0.0F, 0.02F}},
                    24),
        turned({0.0F, r, 0.03F}, 90.0F, {0.0F, 0.0F, 1.0F}));
    for (const float side : {-1.0F, 1.0F})
        castor.add(m.steel, make_block({0.005F, height_m - r, 0.05F}),
                   turned({side * 0.028F, 0.5F * (height_m + r) - 0.01F, 0.015F}, 6.0F, {1.0F, 0.0F, 0.0F}));
    castor.add(m.steel, make_block({0.10F, 0.008F, 0.10F}), place({0.0F, height_m - 0.004F, 0.0F}));
    castor.add(m.steel, make_pipe({{-0.04F, r, 0.03F}, {0.04F, r, 0.03F}}, 0.008F, 8));
    return castor;
}

}  // namespace

Model make_wheeled_ladder(const AirShedMaterials& m, float height_m) {
    Model ladder;
    constexpr float kHalf = 0.36F;
    constexpr float kBase = 0.16F;
    constexpr float kTop = 0.7F;  // length of the platform
    const int steps = static_cast<int>(height_m / 0.24F);
    const float run = 0.62F * height_m;
    const Mesh tread = make_grating({2.0F * kHalf - 0.02F, 0.20F}, 0.03F, 0.025F);
    for (int i = 1; i < steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        ladder.add(m.yellow, tread, place({0.0F, glm::mix(kBase, height_m, t), glm::mix(run, 0.0F, t)}));
    }
    ladder.add(m.yellow, make_grating({2.0F * kHalf, kTop}, 0.03F, 0.03F), place({0.0F, height_m, -0.5F * kTop}));
    for (const float side : {-1.0F, 1.0F}) {
        const float x = side * kHalf;
        ladder.add(m.yellow, make_pipe({{x, kBase, run}, {x, height_m, 0.0F}, {x, height_m, -kTop}}, 0.022F, 10));
        ladder.add(m.yellow, make_pipe({{x, kBase, -kTop}, {x, height_m, -kTop}}, 0.022F, 10));
        ladder.add(m.yellow, make_pipe({{x, kBase, run}, {x, kBase, -kTop}}, 0.022F, 10));
        ladder.add(m.yellow, make_pipe({{x, kBase, -kTop}, {x, 0.55F * height_m, 0.45F * run}}, 0.014F, 8));
        ladder.add(m.yellow, make_pipe(round_corners({{x, kBase + 0.35F, run + 0.05F},
                                                      {x, kBase + 0.95F, run - 0.05F},
                                                      {x, height_m + 0.95F, 0.0F},
                                                      {x, height_m + 0.95F, -kTop},
                                                      {x, height_m, -kTop}},
                                                     0.12F, 4),
                                       0.019F, 10));
        for (int i = 1; i < 4; ++i) {
            const float t = static_cast<float>(i) / 4.0F;
            const glm::vec3 foot(x, glm::mix(kBase, height_m, t), glm::mix(run, 0.0F, t));
            ladder.add(m.yellow, make_pipe({foot, foot + glm::vec3(0.0F, 0.93F, 0.02F)}, 0.014F, 8));
        }
        ladder.add(make_castor(m, kBase), place({x, 0.0F, run - 0.05F}));
        ladder.add(make_castor(m, kBase), place({x, 0.0F, -kTop + 0.05F}, 40.0F));
    }
    ladder.add(m.yellow, make_pipe({{-kHalf, height_m + 0.95F, -kTop}, {kHalf, height_m + 0.95F, -kTop}}, 0.019F, 10));
    ladder.add(m.yellow, make_pipe({{-kHalf, height_m + 0.5F, -kTop}, {kHalf, height_m + 0.5F, -kTop}}, 0.014F, 8));
    ladder.add(m.decal, make_decal(m, AirShedText::max_load, 0.10F, {0.03F, 0.03F, 0.03F}),
               turned({kHalf + 0.03F, 0.6F * height_m, -0.4F}, 90.0F, {0.0F, 1.0F, 0.0F}));
    return ladder;
}

Model make_platform(const AirShedMaterials& m, float height_m) {
    Model platform;
    constexpr float kX = 1.5F;
    constexpr float kZ = 0.7F;
    constexpr float kBase = 0.2F;
    for (int i = 0; i < 3; ++i)
        platform.add(m.galvanized, make_grating({1.0F, 2.0F * kZ}, 0.032F, 0.03F),
                     place({-1.0F + static_cast<float>(i), height_m, 0.0F}));
    const std::vector<glm::vec3> corners = {{-kX, 0.0F, -kZ}, {kX, 0.0F, -kZ}, {kX, 0.0F, kZ}, {-kX, 0.0F, kZ}};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 a = corners[i];
        const glm::vec3 b = corners[(i + 1) % 4];
        const glm::vec3 up(0.0F, height_m - 0.06F, 0.0F);
        const glm::vec3 foot(0.0F, kBase, 0.0F);
        platform.add(m.orange, make_pipe({a + foot, a + up}, 0.03F, 12));
        platform.add(m.orange, make_pipe({a + up, b + up}, 0.03F, 12));
        platform.add(m.orange, make_pipe({a + foot, b + foot}, 0.025F, 10));
        platform.add(m.orange, make_pipe({a + foot, b + up}, 0.014F, 8));
        if (i % 2 == 0) platform.add(m.orange, make_pipe({b + foot, a + up}, 0.014F, 8));
        platform.add(make_castor(m, kBase), place(a, 30.0F * static_cast<float>(i)));
        platform.add(m.steel,
                     make_pipe({a + glm::vec3(0.08F, 0.05F, 0.0F), a + glm::vec3(0.08F, 0.5F, 0.0F)}, 0.012F, 8));
    }
    const glm::vec3 deck(0.0F, height_m, 0.0F);
    platform.add(m.orange, make_railing(std::vector<glm::vec3>{corners[3] + deck, corners[0] + deck, corners[1] + deck,
                                                               corners[2] + deck},
                                        1.05F, 0.02F));
    for (const float side : {-0.2F, 0.2F})
        platform.add(m.orange, make_pipe({{kX + 0.35F, 0.05F, side + 0.3F}, {kX + 0.06F, height_m + 0.9F, side + 0.3F}},
                                         0.018F, 8));
    const int rungs = static_cast<int>(height_m / 0.27F);
    for (int i = 1; i <= rungs; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(rungs) * height_m / (height_m + 0.9F);
        const float x = glm::mix(kX + 0.35F, kX + 0.06F, t);
        const float y = glm::mix(0.05F, height_m + 0.9F, t);
        platform.add(m.orange, make_pipe({{x, y, 0.1F}, {x, y, 0.5F}}, 0.013F, 8));
    }
    return platform;
}

Model make_trestle(const AirShedMaterials& m, float height_m) {
    Model trestle;
    for (const float z : {-0.5F, 0.5F}) {
        for (const float side : {-1.0F, 1.0F})
            trestle.add(
                m.planks, make_bevelled_block({0.07F, height_m / 0.97F, 0.09F}, 0.004F),
                turned({side * (0.12F + 0.13F * height_m), 0.49F * height_m, z}, side * 14.0F, {0.0F, 0.0F, 1.0F}));
        trestle.add(m.planks, make_bevelled_block({0.34F * height_m, 0.09F, 0.04F}, 0.004F),
                    place({0.0F, 0.4F * height_m, z}));
    }
    trestle.add(m.planks, make_bevelled_block({0.22F, 0.10F, 1.4F}, 0.005F), place({0.0F, height_m - 0.05F, 0.0F}));
    trestle.add(m.canvas, make_bevelled_block({0.24F, 0.04F, 1.2F}, 0.015F), place({0.0F, height_m + 0.02F, 0.0F}));
    return trestle;
}

}  // namespace macula
