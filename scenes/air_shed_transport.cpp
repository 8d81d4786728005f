#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/air_shed_aircraft.h"
#include "scenes/mesh_edit.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

constexpr float kEngineX = 2.75F;
constexpr glm::vec3 kEngine(kEngineX, -0.15F, 3.1F);
constexpr glm::vec3 kMainWheel(kEngineX, -2.72F, 2.1F);
constexpr glm::vec3 kTailWheel(0.0F, -0.72F, -7.7F);
constexpr float kMainRadius = 0.56F;
constexpr float kTailRadius = 0.24F;

const std::vector<FuselageStation>& stations() {
    static const std::vector<FuselageStation> s = {
        {-8.9F, 0.46F, 0.0F, 0.0F},   {-8.5F, 0.44F, 0.16F, 0.24F}, {-7.4F, 0.36F, 0.36F, 0.50F},
        {-6.0F, 0.24F, 0.62F, 0.76F}, {-4.4F, 0.12F, 0.90F, 1.02F}, {-2.6F, 0.04F, 1.12F, 1.22F},
        {-0.8F, 0.0F, 1.20F, 1.30F},  {1.0F, 0.0F, 1.20F, 1.30F},   {2.6F, 0.02F, 1.18F, 1.29F},
        {3.8F, 0.03F, 1.10F, 1.22F},  {4.6F, -0.22F, 0.98F, 0.86F}, {5.3F, -0.34F, 0.80F, 0.66F},
        {5.9F, -0.40F, 0.52F, 0.44F}, {6.2F, -0.42F, 0.26F, 0.22F}, {6.3F, -0.42F, 0.0F, 0.0F}};
    return s;
}

/// The windscreen and the side windows of the cockpit: around the upper front of the fuselage.
bool is_windscreen(float u, float v) {
    const float from_top = std::min(u, 1.0F - u);
    return v > 0.645F && v < 0.725F && from_top < 0.165F && from_top > 0.012F;
}

void add_cockpit(Model& aircraft, const AirShedMaterials& m) {
    const auto& s = stations();
    // make_fuselage() drops by triangle, so that skin and glass share the border.
    const auto outside = [](float u, float v) { return !is_windscreen(u, v); };
    aircraft.add(m.canopy, make_fuselage(s, 96, 140, outside));
    for (const float v : {0.643F, 0.6725F, 0.70F, 0.727F}) {
        for (const float side : {0.0F, 1.0F}) {
            std::vector<glm::vec3> bow;
            for (int i = 0; i <= 14; ++i) {
                const float u = glm::mix(0.010F, 0.168F, static_cast<float>(i) / 14.0F);
                bow.push_back(fuselage_point(s, side > 0.0F ? 1.0F - u : u, v, 0.008F));
            }
            aircraft.add(m.skin, make_pipe(bow, 0.022F, 8));
        }
    }
    for (const float u : {0.010F, 0.075F, 0.168F, 0.832F, 0.925F, 0.990F}) {
        std::vector<glm::vec3> bar;
        for (int i = 0; i <= 10; ++i)
            bar.push_back(fuselage_point(s, u, glm::mix(0.643F, 0.727F, static_cast<float>(i) / 10.0F), 0.008F));
        aircraft.add(m.skin, make_pipe(bar, 0.020F, 8));
    }
    aircraft.add(m.green, make_block({1.7F, 0.05F, 2.0F}), place({0.0F, -0.25F, 3.2F}));
    aircraft.add(m.black, make_bevelled_block({1.5F, 0.45F, 0.12F}, 0.03F), place({0.0F, 0.18F, 4.25F}));
    aircraft.add(m.green, make_block({2.0F, 2.0F, 0.04F}), place({0.0F, 0.2F, 2.1F}));
    for (const float side : {-1.0F, 1.0F}) {
        aircraft.add(m.canvas, make_bevelled_block({0.5F, 0.12F, 0.5F}, 0.04F), place({side * 0.42F, 0.02F, 3.0F}));
        aircraft.add(m.canvas, make_bevelled_block({0.5F, 0.75F, 0.1F}, 0.04F), place({side * 0.42F, 0.42F, 2.75F}));
        aircraft.add(m.black, make_pipe({{side * 0.42F, -0.2F, 3.7F}, {side * 0.42F, 0.25F, 3.75F}}, 0.02F, 8));
        aircraft.add(m.black, make_ring(0.16F, 0.018F),
                     turned({side * 0.42F, 0.30F, 3.75F}, 60.0F, {1.0F, 0.0F, 0.0F}));
    }
}

void add_cabin(Model& aircraft, const AirShedMaterials& m) {
    const auto& s = stations();
    for (const float side : {-1.0F, 1.0F})
        for (int i = 0; i < 6; ++i) {
            const float v = 0.37F + 0.042F * static_cast<float>(i);
            const float u = side < 0.0F ? 0.215F : 0.785F;
            const glm::vec3 at = fuselage_point(s, u, v, 0.004F);
            const glm::mat4 space =
                turned(at, side * 90.0F, {0.0F, 1.0F, 0.0F}) * turned(glm::vec3(0.0F), -12.0F, {1.0F, 0.0F, 0.0F});
            aircraft.add(m.black, make_bevelled_block({0.36F, 0.30F, 0.03F}, 0.01F), space);
            std::vector<glm::vec3> rim;
            for (const glm::vec2 c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
                for (const float k : {-1.0F, 1.0F})
                    rim.emplace_back(c.x * (0.19F - (k == c.x * c.y ? 0.04F : 0.0F)),
                                     c.y * (0.16F - (k == -c.x * c.y ? 0.04F : 0.0F)), 0.016F);
            aircraft.add(m.skin, make_pipe(rim, 0.013F, 6, true), space);
            aircraft.add(m.canopy, make_quad({-0.18F, 0.15F, 0.019F}, {0.36F, 0.0F, 0.0F}, {0.0F, -0.30F, 0.0F}),
                         space);
        }
    // Door on the left side: its seam, hinges and handle.
    const auto edge = [&](float u0, float v0, float u1, float v1) {
        std::vector<glm::vec3> seam;
        for (int i = 0; i <= 12; ++i) {
            const float t = static_cast<float>(i) / 12.0F;
            seam.push_back(fuselage_point(s, glm::mix(u0, u1, t), glm::mix(v0, v1, t), 0.002F));
        }
        aircraft.add(m.black, make_pipe(seam, 0.006F, 5));
    };
    edge(0.17F, 0.29F, 0.33F, 0.29F);
    edge(0.17F, 0.345F, 0.33F, 0.345F);
    edge(0.17F, 0.29F, 0.17F, 0.345F);
    edge(0.33F, 0.29F, 0.33F, 0.345F);
    // Red cheat line along both sides, in strips that follow the skin.
    for (const bool left : {true, false}) {
        Mesh band = make_surface(2, 80, false, [&](float a, float b) {
            const float u = 0.262F + 0.010F * (a - 0.5F);
            return fuselage_point(s, left ? u : 1.0F - (0.262F - 0.010F * (a - 0.5F)), glm::mix(0.05F, 0.96F, b),
                                  0.004F);
        });
        aircraft.add(m.aircraft_red, band);
    }
}

void add_wings(Model& aircraft, const AirShedMaterials& m) {
    const glm::mat4 mirror = glm::scale(glm::mat4(1.0F), {-1.0F, 1.0F, 1.0F});
    WingShape inner;
    inner.root_m = {0.6F, -0.75F, 2.3F};
    inner.tip_m = {10.8F, -0.05F, 1.1F};
    inner.root_chord_m = 3.6F;
    inner.tip_chord_m = 1.3F;
    inner.thickness = 0.16F;
    inner.columns = 56;
    inner.rows = 60;
    WingShape tail;
    tail.root_m = {0.1F, 0.75F, -6.7F};
    tail.tip_m = {3.7F, 0.85F, -7.3F};
    tail.root_chord_m = 1.9F;
    tail.tip_chord_m = 0.8F;
    tail.thickness = 0.10F;
    for (const glm::mat4& side : {glm::mat4(1.0F), mirror}) {
        aircraft.add(m.skin, make_wing(inner), side);
        aircraft.add(m.skin, make_wing(tail), side);
        aircraft.add(m.black, make_pipe({{4.2F, -0.56F, -0.62F}, {10.2F, -0.10F, 0.08F}}, 0.012F, 5),
                     side);  // aileron gap
        aircraft.add(m.rubber, make_pipe({{1.4F, -0.69F, 2.24F}, {10.4F, -0.07F, 1.16F}}, 0.045F, 8),
                     side);  // de-icing boot
        aircraft.add(m.chrome,
                     make_turned({{0.0F, 0.0F}, {0.05F, 0.03F}, {0.06F, 0.09F}, {0.04F, 0.13F}, {0.0F, 0.15F}}, 12),
                     side * turned({10.78F, -0.02F, 0.75F}, -90.0F, {0.0F, 0.0F, 1.0F}));
    }
    WingShape fin;
    fin.root_m = {0.6F, 0.0F, -5.9F};
    fin.tip_m = {3.35F, 0.0F, -7.6F};
    fin.root_chord_m = 3.0F;
    fin.tip_chord_m = 1.2F;
    fin.thickness = 0.09F;
    aircraft.add(m.skin, make_wing(fin), turned(glm::vec3(0.0F), 90.0F, {0.0F, 0.0F, 1.0F}));
}

void add_engine(Model& aircraft, const AirShedMaterials& m, float side) {
    const glm::vec3 at(side * kEngine.x, kEngine.y, kEngine.z);
    aircraft.add(make_radial_engine(m), place(at));
    aircraft.add(make_cowling(m, m.skin), place(at));
    aircraft.add(make_propeller(m, 1.65F),
                 turned(at + glm::vec3(0.0F, 0.0F, 0.68F), side > 0.0F ? 40.0F : -15.0F, {0.0F, 0.0F, 1.0F}));
    const std::vector<FuselageStation> nacelle = {{-1.5F, -0.55F, 0.0F, 0.0F},   {-1.2F, -0.55F, 0.16F, 0.16F},
                                                  {-0.2F, -0.5F, 0.42F, 0.44F},  {0.9F, -0.36F, 0.62F, 0.64F},
                                                  {1.8F, -0.2F, 0.70F, 0.70F},   {2.45F, -0.15F, 0.72F, 0.72F},
                                                  {2.75F, -0.15F, 0.60F, 0.60F}, {2.8F, -0.15F, 0.0F, 0.0F}};
    aircraft.add(m.skin, make_fuselage(nacelle, 48, 40), place({at.x, 0.0F, 0.0F}));
    aircraft.add(m.black_iron, make_pipe(round_corners({{at.x + side * 0.55F, -0.50F, 2.6F},
                                                        {at.x + side * 0.72F, -0.62F, 2.2F},
                                                        {at.x + side * 0.72F, -0.72F, 1.2F}},
                                                       0.2F, 5),
                                         0.09F, 14));
    // Oleo leg, fork, side braces and wheel.
    const glm::vec3 wheel(side * kMainWheel.x, kMainWheel.y, kMainWheel.z);
    for (const float fork : {-1.0F, 1.0F}) {
        const glm::vec3 foot = wheel + glm::vec3(fork * 0.24F, 0.0F, 0.0F);
        const glm::vec3 head(foot.x, -0.6F, wheel.z - 0.15F);
        const glm::vec3 middle = glm::mix(head, foot, 0.55F);
        aircraft.add(m.grey, make_pipe({head, middle}, 0.055F, 16));
        aircraft.add(m.chrome, make_pipe({middle, foot}, 0.038F, 16));
        aircraft.add(m.grey, make_pipe({glm::mix(head, foot, 0.5F), {foot.x, -0.75F, wheel.z - 1.35F}}, 0.035F, 12));
        aircraft.add(m.grey, make_pipe(round_corners({glm::mix(head, foot, 0.5F),
                                                      glm::mix(head, foot, 0.72F) + glm::vec3(0, 0, 0.22F), foot},
                                                     0.05F, 3),
                                       0.018F, 8));
        aircraft.add(m.rubber, make_pipe(hanging_path(head + glm::vec3(0.06F, -0.2F, 0.0F),
                                                      foot + glm::vec3(0.06F, 0.1F, 0.0F), 0.05F, 12),
                                         0.008F, 6));
    }
    aircraft.add(m.steel,
                 make_pipe({wheel - glm::vec3(0.3F, 0.0F, 0.0F), wheel + glm::vec3(0.3F, 0.0F, 0.0F)}, 0.04F, 12));
    aircraft.add(make_aircraft_wheel(m, kMainRadius), place(wheel));
    for (const float door : {-1.0F, 1.0F})
        aircraft.add(m.skin, make_bevelled_block({0.02F, 0.62F, 1.5F}, 0.006F),
                     turned({wheel.x + door * 0.48F, -1.1F, 1.7F}, door * 8.0F, {0.0F, 0.0F, 1.0F}));
}

}  // namespace

Model make_transport(const AirShedMaterials& m) {
    Model aircraft;
    aircraft.add(m.skin, make_fuselage(stations(), 96, 140, is_windscreen));
    add_cockpit(aircraft, m);
    add_cabin(aircraft, m);
    add_wings(aircraft, m);
    for (const float side : {-1.0F, 1.0F}) add_engine(aircraft, m, side);
    aircraft.add(
        m.grey,
        make_pipe({kTailWheel + glm::vec3(0.0F, 0.75F, 0.35F), kTailWheel + glm::vec3(0.12F, 0.0F, 0.0F)}, 0.04F, 10));
    aircraft.add(make_aircraft_wheel(m, kTailRadius), place(kTailWheel));
    // Aerial mast and wires, pitot tube, drain masts.
    aircraft.add(m.skin, make_block({0.02F, 0.5F, 0.14F}), place({0.0F, 1.5F, 2.2F}));
    for (const glm::vec3& from :
         {glm::vec3(0.0F, 1.74F, 2.2F), glm::vec3(2.6F, 0.95F, -7.1F), glm::vec3(-2.6F, 0.95F, -7.1F)})
        aircraft.add(m.steel, make_pipe({from, glm::vec3(0.0F, 3.2F, -7.9F)}, 0.004F, 4));
    aircraft.add(
        m.steel,
        make_pipe(round_corners({{-0.35F, -0.85F, 5.0F}, {-0.35F, -1.15F, 5.05F}, {-0.35F, -1.18F, 5.5F}}, 0.1F, 3),
                  0.014F, 8));
    for (const bool left : {true, false}) {
        const glm::mat4 side = left ? turned({0.0F, 2.1F, -7.35F}, -90.0F, {0.0F, 1.0F, 0.0F})
                                    : turned({0.0F, 2.1F, -7.35F}, 90.0F, {0.0F, 1.0F, 0.0F});
        aircraft.add(m.decal, make_decal(m, AirShedText::trainer_number, 0.7F, {0.02F, 0.02F, 0.025F}),
                     side * place({0.0F, 0.0F, 0.14F}));
        const glm::mat4 body = left ? turned({-1.09F, 0.62F, -2.7F}, -90.0F, {0.0F, 1.0F, 0.0F})
                                    : turned({1.09F, 0.62F, -2.7F}, 90.0F, {0.0F, 1.0F, 0.0F});
        aircraft.add(m.decal, make_decal(m, AirShedText::registration, 0.42F, {0.02F, 0.02F, 0.025F}),
                     body * turned({0.0F, 0.0F, 0.03F}, -14.0F, {1.0F, 0.0F, 0.0F}));
    }
    // It stands on its tail wheel: turned about x until both wheels touch the ground.
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
