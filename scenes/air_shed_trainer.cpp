#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/air_shed_aircraft.h"
#include "scenes/mesh_edit.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

constexpr glm::vec3 kMainWheel(1.25F, -1.62F, 1.05F);
constexpr glm::vec3 kTailWheel(0.0F, -0.38F, -5.1F);
constexpr float kMainRadius = 0.36F;
constexpr float kTailRadius = 0.16F;

const std::vector<FuselageStation>& body() {
    static const std::vector<FuselageStation> s = {{-5.9F, 0.22F, 0.0F, 0.0F},   {-5.6F, 0.2F, 0.09F, 0.18F},
                                                   {-4.6F, 0.14F, 0.20F, 0.34F}, {-3.2F, 0.06F, 0.36F, 0.50F},
                                                   {-1.6F, 0.0F, 0.50F, 0.62F},  {0.0F, 0.0F, 0.56F, 0.66F},
                                                   {1.2F, 0.0F, 0.60F, 0.68F},   {2.05F, 0.0F, 0.68F, 0.70F},
                                                   {2.1F, 0.0F, 0.60F, 0.60F},   {2.12F, 0.0F, 0.0F, 0.0F}};
    return s;
}

const std::vector<FuselageStation>& greenhouse() {
    static const std::vector<FuselageStation> s = {{-1.95F, 0.52F, 0.02F, 0.03F}, {-1.6F, 0.55F, 0.34F, 0.34F},
                                                   {-0.9F, 0.58F, 0.42F, 0.52F},  {0.0F, 0.60F, 0.43F, 0.56F},
                                                   {0.65F, 0.60F, 0.42F, 0.54F},  {1.05F, 0.56F, 0.36F, 0.34F},
                                                   {1.3F, 0.52F, 0.24F, 0.12F}};
    return s;
}

/// Cockpit opening below the canopy.
bool is_cockpit(float u, float v) {
    const float from_top = std::min(u, 1.0F - u);
    return v > 0.49F && v < 0.70F && from_top < 0.105F;
}

void add_canopy(Model& aircraft, const AirShedMaterials& m) {
    const auto& s = greenhouse();
    const auto below = [](float u, float) { return std::min(u, 1.0F - u) > 0.27F; };
    aircraft.add(m.canopy, make_fuselage(s, 64, 48, below));
    for (const float v : {0.06F, 0.18F, 0.30F, 0.42F, 0.54F, 0.66F, 0.80F, 0.97F}) {
        std::vector<glm::vec3> bow;
        for (int i = 0; i <= 24; ++i) {
            const float u = glm::mix(-0.26F, 0.26F, static_cast<float>(i) / 24.0F);
            bow.push_back(fuselage_point(s, u < 0.0F ? u + 1.0F : u, v, 0.003F));
        }
        aircraft.add(m.painted_skin, make_pipe(bow, 0.014F, 8));
    }
    for (const float u : {0.0F, 0.13F, 0.26F, 0.74F, 0.87F}) {
        std::vector<glm::vec3> bar;
        for (int i = 0; i <= 24; ++i)
            bar.push_back(fuselage_point(s, u, glm::mix(0.06F, 0.97F, static_cast<float>(i) / 24.0F), 0.003F));
        aircraft.add(m.painted_skin, make_pipe(bar, 0.012F, 8));
    }
    for (const float z : {0.45F, -0.75F}) {
        aircraft.add(m.green, make_bevelled_block({0.46F, 0.06F, 0.42F}, 0.02F), place({0.0F, 0.05F, z}));
        aircraft.add(m.green, make_bevelled_block({0.46F, 0.75F, 0.06F}, 0.02F),
                     turned({0.0F, 0.42F, z - 0.24F}, -10.0F, {1.0F, 0.0F, 0.0F}));
        aircraft.add(m.canvas, make_pipe({{-0.1F, 0.75F, z - 0.26F}, {-0.1F, 0.1F, z - 0.15F}}, 0.02F, 6));
        aircraft.add(m.canvas, make_pipe({{0.1F, 0.75F, z - 0.26F}, {0.1F, 0.1F, z - 0.15F}}, 0.02F, 6));
        aircraft.add(m.black, make_bevelled_block({0.8F, 0.30F, 0.06F}, 0.015F), place({0.0F, 0.50F, z + 0.58F}));
        for (int i = 0; i < 6; ++i)
            aircraft.add(
                m.plastic_white, make_turned({{0.045F, 0.0F}, {0.045F, 0.012F}, {0.038F, 0.014F}, {0.0F, 0.012F}}, 16),
                turned({-0.26F + 0.105F * static_cast<float>(i), 0.50F + (i % 2 == 0 ? 0.06F : -0.06F), z + 0.55F},
                       -90.0F, {1.0F, 0.0F, 0.0F}));
        aircraft.add(
            m.black,
            make_pipe(
                round_corners({{0.0F, -0.3F, z + 0.3F}, {0.0F, 0.15F, z + 0.32F}, {0.0F, 0.38F, z + 0.26F}}, 0.05F, 3),
                0.016F, 8));
    }
    aircraft.add(m.green, make_block({0.7F, 0.03F, 2.6F}), place({0.0F, -0.32F, -0.3F}));
}

void add_gear(Model& aircraft, const AirShedMaterials& m, float side) {
    const glm::vec3 wheel(side * kMainWheel.x, kMainWheel.y, kMainWheel.z);
    const glm::vec3 foot = wheel + glm::vec3(-side * 0.18F, 0.0F, 0.0F);
    const glm::vec3 head(foot.x + side * 0.02F, -0.5F, wheel.z - 0.1F);
    const glm::vec3 middle = glm::mix(head, foot, 0.5F);
    aircraft.add(m.painted_skin, make_pipe({head, middle}, 0.06F, 16));
    aircraft.add(m.chrome, make_pipe({middle, foot}, 0.035F, 16));
    aircraft.add(m.steel, make_pipe({foot, wheel}, 0.03F, 12));
    aircraft.add(
        m.grey,
        make_pipe(round_corners({middle, glm::mix(middle, foot, 0.5F) + glm::vec3(0.0F, 0.0F, 0.16F), foot}, 0.04F, 3),
                  0.014F, 8));
    aircraft.add(m.rubber, make_pipe(hanging_path(head + glm::vec3(0.0F, -0.1F, -0.07F),
                                                  foot + glm::vec3(0.0F, 0.05F, -0.05F), 0.04F, 10),
                                     0.007F, 6));
    aircraft.add(make_aircraft_wheel(m, kMainRadius), place(wheel, side > 0.0F ? 0.0F : 180.0F));
}

}  // namespace

Model make_trainer(const AirShedMaterials& m) {
    Model aircraft;
    aircraft.add(m.painted_skin, make_fuselage(body(), 72, 110, is_cockpit));
    add_canopy(aircraft, m);
    // The deck between engine and windscreen is matt, so that it does not dazzle.
    aircraft.add(m.glare_paint, make_surface(16, 10, false, [](float a, float b) {
                     const float u = 0.11F * (0.5F - a);
                     return fuselage_point(body(), u < 0.0F ? u + 1.0F : u, glm::mix(0.71F, 0.775F, b), 0.004F);
                 }));
    WingShape wing;
    wing.root_m = {0.3F, -0.5F, 1.5F};
    wing.tip_m = {6.3F, -0.05F, 1.0F};
    wing.root_chord_m = 2.2F;
    wing.tip_chord_m = 1.1F;
    wing.thickness = 0.15F;
    WingShape tail;
    tail.root_m = {0.05F, 0.38F, -4.3F};
    tail.tip_m = {1.9F, 0.40F, -4.6F};
    tail.root_chord_m = 1.2F;
    tail.tip_chord_m = 0.7F;
    tail.thickness = 0.09F;
    tail.columns = tail.rows = 28;
    for (const float side : {1.0F, -1.0F}) {
        const glm::mat4 mirror = glm::scale(glm::mat4(1.0F), {side, 1.0F, 1.0F});
        aircraft.add(m.painted_skin, make_wing(wing), mirror);
        aircraft.add(m.painted_skin, make_wing(tail), mirror);
        aircraft.add(m.black, make_pipe({{2.9F, -0.26F, -0.18F}, {6.0F, -0.04F, 0.20F}}, 0.010F, 5), mirror);
        aircraft.add(m.black, make_block({0.62F, 0.005F, 1.6F}),
                     mirror * turned({0.92F, -0.30F, 0.55F}, 4.0F, {0.0F, 0.0F, 1.0F}));
        add_gear(aircraft, m, side);
    }
    WingShape fin;
    fin.root_m = {0.2F, 0.0F, -4.0F};
    fin.tip_m = {1.75F, 0.0F, -5.0F};
    fin.root_chord_m = 1.9F;
    fin.tip_chord_m = 0.9F;
    fin.thickness = 0.08F;
    fin.columns = fin.rows = 28;
    aircraft.add(m.painted_skin, make_wing(fin), turned(glm::vec3(0.0F), 90.0F, {0.0F, 0.0F, 1.0F}));

    const glm::vec3 engine(0.0F, 0.0F, 2.45F);
    aircraft.add(make_radial_engine(m), place(engine));
    aircraft.add(make_cowling(m, m.painted_skin), place(engine));
    aircraft.add(make_propeller(m, 1.35F), turned(engine + glm::vec3(0.0F, 0.0F, 0.68F), 10.0F, {0.0F, 0.0F, 1.0F}));
    aircraft.add(m.black_iron,
                 make_pipe(round_corners({{0.5F, -0.45F, 1.9F}, {0.68F, -0.5F, 1.7F}, {0.70F, -0.52F, 1.0F}}, 0.15F, 4),
                           0.07F, 14));
    aircraft.add(
        m.grey,
        make_pipe({kTailWheel + glm::vec3(0.0F, 0.4F, 0.25F), kTailWheel + glm::vec3(0.08F, 0.0F, 0.0F)}, 0.03F, 8));
    aircraft.add(make_aircraft_wheel(m, kTailRadius), place(kTailWheel));
    aircraft.add(m.steel, make_pipe({{0.0F, 1.17F, -0.6F}, {0.0F, 1.85F, -5.2F}}, 0.003F, 4));
    for (const float side : {-1.0F, 1.0F}) {
        const glm::mat4 body_side = turned({side * 0.47F, 0.12F, -2.5F}, side * 90.0F, {0.0F, 1.0F, 0.0F}) *
                                    turned(glm::vec3(0.0F), side * -8.0F, {0.0F, 1.0F, 0.0F});
        aircraft.add(m.decal, make_decal(m, AirShedText::trainer_number, 0.55F, {0.02F, 0.02F, 0.025F}), body_side);
    }
    const glm::vec3 to_tail = kTailWheel - kMainWheel;
    const float rise = kTailRadius - kMainRadius;
    const float length = glm::length(glm::vec2(to_tail.y, to_tail.z));
    const float angle = std::atan2(to_tail.y, -to_tail.z) - std::asin(rise / length);
    const glm::mat4 tilt = turned(glm::vec3(0.0F), glm::degrees(-angle), {1.0F, 0.0F, 0.0F});
    const float low = (tilt * glm::vec4(kMainWheel, 1.0F)).y - kMainRadius;
    Model standing;
    standing.add(aircraft, place({0.0F, -low, 0.0F}) * tilt);
    return standing;
}

}  // namespace macula
