#pragma once

#include <functional>
#include <vector>

#include "scenes/air_shed_materials.h"

namespace macula {

/// Parts of aircraft. Aircraft space: +Z to the nose, +Y up, the origin in the middle of the fuselage above the wing.

/// Cross section of a fuselage or nacelle at `z_m`: a superellipse (exponent 2.4) around (0, y_m).
struct FuselageStation {
    float z_m;
    float y_m;
    float half_width_m;
    float half_height_m;
};

/// Skin through stations from tail to nose (Catmull-Rom), closed where the ends are points. `around_m` and `along_m`
/// scale uv0. A cell is left out where `open(u, v)` says so: u around from the top over the left side, v from tail to
/// nose.
Mesh make_fuselage(const std::vector<FuselageStation>& stations, int columns, int rows,
                   const std::function<bool(float u, float v)>& open = {});

/// Point of that skin, `lift_m` above it.
glm::vec3 fuselage_point(const std::vector<FuselageStation>& stations, float u, float v, float lift_m = 0.0F);

/// Where the leading edge of a wing is, and how far behind it the trailing edge, at the root and the tip.
struct WingShape {
    glm::vec3 root_m;  ///< leading edge
    glm::vec3 tip_m;
    float root_chord_m = 2.0F;
    float tip_chord_m = 1.0F;
    float thickness = 0.14F;  ///< over chord: symmetric NACA four-digit section
    int columns = 40;
    int rows = 40;
};

/// Half wing from root to tip with a rounded tip; uv0 in metres. Mirror it with a scale of -1 for the other side.
Mesh make_wing(const WingShape& shape);

/// Nine-cylinder radial engine around +Z, its propeller shaft's end at z = 0.55: crankcase, finned cylinders, push
/// rods, ignition harness, exhaust collector. Its outer radius is 0.66 m.
Model make_radial_engine(const AirShedMaterials& m);

/// Ring cowling around such an engine, its lip at z = 0.5, skin of `material`.
Model make_cowling(const AirShedMaterials& m, int material);

/// Propeller with three blades that turns about +Z, hub in the origin.
Model make_propeller(const AirShedMaterials& m, float radius_m);

/// Wheel with tyre, hub and brake, its axle along x, centre in the origin.
Model make_aircraft_wheel(const AirShedMaterials& m, float radius_m);

/// Twin-engined transport of bare aluminium, 15 m long, standing on its wheels on y = 0.
Model make_transport(const AirShedMaterials& m);

/// Yellow single-engined trainer with a long glazed canopy, 8.5 m long, standing on y = 0.
Model make_trainer(const AirShedMaterials& m);

}  // namespace macula
