#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_aircraft.h"
#include "scenes/mesh_edit.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;
constexpr int kCylinders = 9;

/// Takes +Y, about which shapes are turned, to +Z.
glm::mat4 upright_to_forward() {
    return turned(glm::vec3(0.0F), 90.0F, {1.0F, 0.0F, 0.0F});
}

/// Finned barrel and head along +Y from y = 0, 0.33 m high.
Mesh make_cylinder_fins() {
    std::vector<glm::vec2> profile = {{0.075F, 0.0F}};
    const auto add_fins = [&profile](float from, float to, int count, float inner, float outer) {
        for (int i = 0; i < count; ++i) {
            const float y = glm::mix(from, to, static_cast<float>(i) / static_cast<float>(count));
            const float fin = 0.45F * (to - from) / static_cast<float>(count);
            profile.insert(profile.end(), {{inner, y}, {outer, y + 0.5F * fin}, {inner, y + fin}});
        }
    };
    add_fins(0.02F, 0.18F, 13, 0.072F, 0.096F);
    add_fins(0.185F, 0.30F, 7, 0.080F, 0.115F);
    profile.insert(profile.end(), {{0.085F, 0.31F}, {0.05F, 0.335F}, {0.0F, 0.34F}});
    return make_turned(profile, 16);
}

/// One cylinder with everything that repeats nine times, along +Y; the front is +Z.
Model make_engine_cylinder(const AirShedMaterials& m) {
    Model one;
    one.add(m.steel, make_cylinder_fins(), place({0.0F, 0.25F, 0.0F}));
    one.add(m.black_iron, make_turned({{0.10F, 0.0F}, {0.10F, 0.02F}, {0.07F, 0.025F}}, 20),
            place({0.0F, 0.235F, 0.0F}));
    for (const float side : {-1.0F, 1.0F}) {
        // Rocker boxes on both sides of the head, push rods in front of it.
        one.add(m.black, make_bevelled_block({0.07F, 0.06F, 0.11F}, 0.012F),
                turned({side * 0.075F, 0.575F, 0.02F}, side * -24.0F, {0.0F, 0.0F, 1.0F}));
        one.add(m.chrome, make_pipe({{side * 0.035F, 0.21F, 0.12F}, {side * 0.078F, 0.56F, 0.075F}}, 0.010F, 8));
        one.add(m.brass,
                make_pipe({{side * 0.05F, 0.48F, side * 0.08F}, {side * 0.05F, 0.48F, side * 0.125F}}, 0.011F, 6));
        one.add(m.rubber, make_pipe(round_corners({{side * 0.05F, 0.48F, side * 0.125F},
                                                   {side * 0.06F, 0.44F, 0.15F},
                                                   {side * 0.09F, 0.24F, 0.17F}},
                                                  0.03F, 3),
                                    0.006F, 6));
    }
    one.add(m.black_iron,
            make_pipe(round_corners({{0.07F, 0.50F, -0.07F}, {0.12F, 0.55F, -0.15F}, {0.16F, 0.52F, -0.26F}}, 0.06F, 4),
                      0.028F, 10));
    one.add(
        m.galvanized,
        make_pipe(round_corners({{-0.07F, 0.47F, -0.07F}, {-0.11F, 0.40F, -0.16F}, {-0.09F, 0.22F, -0.24F}}, 0.06F, 4),
                  0.024F, 10));
    return one;
}

}  // namespace

Model make_radial_engine(const AirShedMaterials& m) {
    Model engine;
    const glm::mat4 forward = upright_to_forward();
    engine.add(m.grey,
               make_turned({{0.0F, -0.34F},
                            {0.18F, -0.34F},
                            {0.24F, -0.30F},
                            {0.24F, -0.16F},
                            {0.20F, -0.12F},
                            {0.25F, -0.10F},
                            {0.25F, 0.12F},
                            {0.23F, 0.15F},
                            {0.17F, 0.26F},
                            {0.11F, 0.36F},
                            {0.09F, 0.44F},
                            {0.05F, 0.45F},
                            {0.05F, 0.55F},
                            {0.0F, 0.55F}},
                           40),
               forward);
    const Model cylinder = make_engine_cylinder(m);
    for (int i = 0; i < kCylinders; ++i)
        engine.add(cylinder, turned(glm::vec3(0.0F), 360.0F * static_cast<float>(i) / kCylinders, {0.0F, 0.0F, 1.0F}));
    const Mesh bolt = make_bolt(0.010F);
    for (int i = 0; i < 18; ++i) {
        const float a = kTau * (static_cast<float>(i) + 0.5F) / 18.0F;
        engine.add(m.steel, bolt, place({0.205F * std::sin(a), 0.205F * std::cos(a), 0.185F}));
    }
    // Ignition ring in front of the cylinders' feet and exhaust collector behind their heads.
    std::vector<glm::vec3> harness;
    std::vector<glm::vec3> collector;
    for (int i = 0; i < 36; ++i) {
        const float a = kTau * static_cast<float>(i) / 36.0F;
        harness.emplace_back(0.27F * std::sin(a), 0.27F * std::cos(a), 0.17F);
        collector.emplace_back(0.54F * std::sin(a), 0.54F * std::cos(a), -0.28F);
    }
    engine.add(m.brass, make_pipe(harness, 0.014F, 8, true));
    engine.add(m.black_iron, make_pipe(collector, 0.05F, 12, true));
    for (const float side : {-1.0F, 1.0F}) {
        engine.add(m.black, make_bevelled_block({0.10F, 0.14F, 0.12F}, 0.02F), place({side * 0.11F, 0.06F, -0.39F}));
        engine.add(m.galvanized,
                   make_turned({{0.0F, 0.0F}, {0.05F, 0.0F}, {0.05F, 0.16F}, {0.03F, 0.19F}, {0.0F, 0.19F}}, 16),
                   turned({side * 0.13F, -0.12F, -0.34F}, -90.0F, {1.0F, 0.0F, 0.0F}));
    }
    return engine;
}

Model make_cowling(const AirShedMaterials& m, int material) {
    Model cowling;
    // Outside from the rear gills to the lip, then back along the inside.
    Mesh skin = make_turned({{0.74F, -0.62F},
                             {0.80F, -0.30F},
                             {0.81F, 0.05F},
                             {0.79F, 0.28F},
                             {0.74F, 0.42F},
                             {0.67F, 0.49F},
                             {0.61F, 0.50F},
                             {0.57F, 0.46F},
                             {0.57F, 0.38F},
                             {0.66F, 0.25F},
                             {0.74F, 0.10F},
                             {0.76F, -0.25F},
                             {0.73F, -0.62F}},
                            72);
    scale_uv(skin, {5.0F, 2.0F});
    cowling.add(material, skin, upright_to_forward());
    for (int i = 0; i < 24; ++i) {  // gills, each opened a little
        const float a = 360.0F * static_cast<float>(i) / 24.0F;
        cowling.add(material, make_block({0.185F, 0.006F, 0.20F}),
                    turned(glm::vec3(0.0F), a, {0.0F, 0.0F, 1.0F}) *
                        turned({0.0F, 0.765F, -0.70F}, -13.0F, {1.0F, 0.0F, 0.0F}));
    }
    const Mesh latch = make_bevelled_block({0.05F, 0.012F, 0.11F}, 0.004F);
    for (int i = 0; i < 6; ++i)
        cowling.add(m.steel, latch,
                    turned(glm::vec3(0.0F), 60.0F * static_cast<float>(i) + 15.0F, {0.0F, 0.0F, 1.0F}) *
                        place({0.0F, 0.812F, 0.02F}));
    return cowling;
}

Model make_propeller(const AirShedMaterials& m, float radius_m) {
    Model propeller;
    propeller.add(m.chrome,
                  make_turned({{0.0F, -0.10F},
                               {0.11F, -0.10F},
                               {0.13F, 0.0F},
                               {0.12F, 0.10F},
                               {0.08F, 0.22F},
                               {0.03F, 0.28F},
                               {0.0F, 0.285F}},
                              28),
                  upright_to_forward());
    const auto blade = [radius_m](float from, float to, int rows) {
        return make_surface(20, rows, true, [=](float u, float v) {
            const float r = glm::mix(from, to, v);
            const float t = r / radius_m;
            const float chord =
                0.15F * radius_m * std::pow(std::sin(glm::clamp(0.18F + 0.80F * t, 0.0F, 1.0F) * 0.5F * kTau), 0.6F) +
                0.004F;
            const float thick = chord * glm::mix(0.42F, 0.08F, std::sqrt(t));
            const float pitch = glm::radians(glm::mix(62.0F, 18.0F, std::sqrt(t)));
            const float a = -kTau * u;
            const float x = 0.5F * chord * std::cos(a);
            const float z = 0.5F * thick * std::sin(a) * (1.0F + 0.3F * std::cos(a));
            return glm::vec3(x * std::cos(pitch) - z * std::sin(pitch), r, x * std::sin(pitch) + z * std::cos(pitch));
        });
    };
    for (int i = 0; i < 3; ++i) {
        const glm::mat4 at = turned(glm::vec3(0.0F), 120.0F * static_cast<float>(i) + 25.0F, {0.0F, 0.0F, 1.0F});
        propeller.add(m.steel, make_turned({{0.055F, 0.08F}, {0.06F, 0.20F}, {0.05F, 0.26F}}, 18), at);
        propeller.add(m.black, blade(0.22F, 0.9F * radius_m, 30), at);
        propeller.add(m.yellow, blade(0.9F * radius_m, radius_m, 6), at);
    }
    return propeller;
}

Model make_aircraft_wheel(const AirShedMaterials& m, float radius_m) {
    Model wheel;
    const float r = radius_m;
    std::vector<glm::vec2> tyre;
    tyre.reserve(15);
    for (int i = 0; i <= 14; ++i) {
        const float a = glm::mix(-0.72F, 0.72F, static_cast<float>(i) / 14.0F) * 0.5F * kTau;
        tyre.emplace_back(0.74F * r + 0.26F * r * std::cos(a), 0.24F * r * std::sin(a));
    }
    const glm::mat4 sideways = turned(glm::vec3(0.0F), -90.0F, {0.0F, 0.0F, 1.0F});
    wheel.add(m.rubber, make_turned(tyre, 48), sideways);
    for (const float groove : {-0.10F, -0.035F, 0.035F, 0.10F}) {
        std::vector<glm::vec3> ring;
        ring.reserve(40);
        const float out = 0.74F * r + std::sqrt(0.0676F - groove * groove * 1.17F) * r;
        for (int i = 0; i < 40; ++i)
            ring.emplace_back(groove * r, out * std::cos(kTau * static_cast<float>(i) / 40.0F),
                              out * std::sin(kTau * static_cast<float>(i) / 40.0F));
        wheel.add(m.rubber, make_pipe(ring, 0.022F * r, 5, true));
    }
    wheel.add(m.galvanized,
              make_turned({{0.0F, -0.10F * r},
                           {0.20F * r, -0.12F * r},
                           {0.46F * r, -0.04F * r},
                           {0.56F * r, -0.17F * r},
                           {0.60F * r, -0.17F * r},
                           {0.60F * r, 0.17F * r},
                           {0.56F * r, 0.17F * r},
                           {0.46F * r, 0.04F * r},
                           {0.20F * r, 0.14F * r},
                           {0.12F * r, 0.20F * r},
                           {0.0F, 0.20F * r}},
                          36),
              sideways);
    const Mesh bolt = make_bolt(0.03F * r);
    for (int i = 0; i < 8; ++i) {
        const float a = kTau * static_cast<float>(i) / 8.0F;
        wheel.add(m.steel, bolt,
                  turned({0.11F * r, 0.30F * r * std::cos(a), 0.30F * r * std::sin(a)}, 90.0F, {0.0F, 1.0F, 0.0F}));
    }
    return wheel;
}

}  // namespace macula
