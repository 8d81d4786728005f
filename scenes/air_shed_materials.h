#pragma once

#include "scenes/pattern_glyph.h"
#include "scenes/scene_builder.h"

namespace macula {

/// What is written in the hangar, by its place on the decal sheet.
enum class AirShedText {
    hangar,
    no_smoking,
    danger_propeller,
    registration,
    trainer_number,
    bay_1,
    bay_2,
    bay_3,
    keep_clear,
    max_load,
    fire_point,
    oil,
    flammable,
    fragile,
    this_side_up,
    spares,
    engine_shop,
    exit,
    no_step,
    fuel,
    hoist,
    crew_only,
    count,
};

/// Indices of the materials of Air Shed. Texture coordinates are in metres unless said otherwise.
struct AirShedMaterials {
    int concrete = 0;
    int joint = 0;       ///< sealant between floor slabs
    int marking = 0;     ///< road paint, white: vertex colours tint it
    int decal = 0;       ///< texts; uv0 from `text`, vertex colours tint it
    int wall_sheet = 0;  ///< corrugated walls, painted
    int roof_sheet = 0;  ///< zinc
    int skylight = 0;    ///< translucent sheets that daylight shines through
    int door_sheet = 0;
    int brick = 0;
    int girder = 0;  ///< the shell's steel: grey-green paint
    int window_frame = 0;
    int pane = 0;  ///< dirty glass, uv0 over [0, 1] for each pane
    int steel = 0;
    int chrome = 0;
    int brass = 0;
    int black_iron = 0;
    int galvanized = 0;
    int red = 0;
    int yellow = 0;
    int blue = 0;
    int orange = 0;
    int grey = 0;
    int green = 0;
    int white = 0;
    int planks = 0;
    int plywood = 0;
    int cardboard = 0;
    int rubber = 0;
    int rope = 0;
    int canvas = 0;
    int black = 0;
    int plastic_white = 0;
    int skin = 0;          ///< bare aluminium
    int painted_skin = 0;  ///< the trainer's yellow
    int glare_paint = 0;   ///< matt black-green before the windscreen
    int aircraft_red = 0;
    int canopy = 0;        ///< aircraft glass, thin
    int bottle_glass = 0;  ///< closed volumes of green glass
    int lamp_glow = 0;     ///< warm
    int tube_glow = 0;     ///< cool white
    int red_glow = 0;
    int paper = 0;  ///< uv0 over [0, 1]
    int asphalt = 0;
    int grass = 0;
    int foliage = 0;

    DecalPlace text[static_cast<int>(AirShedText::count)];
};

/// Makes the textures and the materials.
AirShedMaterials add_air_shed_materials(SceneBuilder& builder);

/// A text in the plane z = 0 around the origin, looking along +Z, its sheet part `height_m` high.
Mesh make_decal(const AirShedMaterials& materials, AirShedText text, float height_m,
                const glm::vec3& color = glm::vec3(1.0F));

}  // namespace macula
