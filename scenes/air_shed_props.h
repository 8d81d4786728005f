#pragma once

#include "scenes/air_shed_materials.h"

namespace macula {

/// Movable things of the hangar. Each stands on y = 0 around the origin, its front along +Z.

Model make_oil_drum(const AirShedMaterials& m, int paint);
Model make_crate(const AirShedMaterials& m, const glm::vec3& size_m, int seed);
Model make_pallet(const AirShedMaterials& m);
Model make_cardboard_box(const AirShedMaterials& m, const glm::vec3& size_m, int seed);
/// Shelf of angle bars with boards, full of boxes, tins and parts; 2.4 m wide.
Model make_shelf(const AirShedMaterials& m, int seed);
Model make_tyre_stack(const AirShedMaterials& m, int count);
Model make_gas_bottle(const AirShedMaterials& m, int paint);
Model make_jerrycan(const AirShedMaterials& m, int paint);

/// Step ladder on wheels with treads of grating and handrails, `height_m` to its platform.
Model make_wheeled_ladder(const AirShedMaterials& m, float height_m);
/// Platform on wheels with a floor of grating, railings and a ladder, 3 x 1.4 m.
Model make_platform(const AirShedMaterials& m, float height_m);
/// Trestle that carries a wing.
Model make_trestle(const AirShedMaterials& m, float height_m);

/// Bench with vice, tools, tins and papers; 3 m wide.
Model make_workbench(const AirShedMaterials& m, int seed);
/// Cabinet on castors with drawers, tools on its tray.
Model make_tool_trolley(const AirShedMaterials& m, int paint);
/// A radial engine on a stand.
Model make_engine_stand(const AirShedMaterials& m);
Model make_compressor(const AirShedMaterials& m);
Model make_cone(const AirShedMaterials& m);
Model make_extinguisher(const AirShedMaterials& m);
Model make_bucket(const AirShedMaterials& m);
/// Two-wheeled chock pair with its rope.
Model make_chocks(const AirShedMaterials& m);
/// Tow tractor.
Model make_tractor(const AirShedMaterials& m);
/// Bottles of green glass in a wire basket.
Model make_bottle_basket(const AirShedMaterials& m);

/// High-bay lamp with reflector and wire guard; hangs from the origin on a chain, `drop_m` to its glowing bulb.
Model make_high_bay_lamp(const AirShedMaterials& m, float drop_m);
/// Two fluorescent tubes in a tin reflector, 1.5 m along x, hanging from the origin on wires.
Model make_tube_lamp(const AirShedMaterials& m, float drop_m);

/// Puts all of them where they belong.
void furnish(SceneBuilder& builder, const AirShedMaterials& m);

/// Crane bridge with chain hoist, ducts, pipes, cables, ropes, switch boxes, signs, and the lamps.
void build_services(SceneBuilder& builder, const AirShedMaterials& m);

}  // namespace macula
