#pragma once

#include "scenes/air_shed_materials.h"

namespace macula {

/// The building: it stands on y = 0 around the y axis, its ridge along z, the doors on -Z. Metres.
struct AirShedSize {
    static constexpr float kHalfWidth = 18.0F;
    static constexpr float kHalfLength = 28.0F;
    static constexpr float kBay = 4.0F;  ///< between frames along z
    static constexpr int kBays = 14;
    static constexpr float kEaves = 8.8F;
    static constexpr float kTie = 8.1F;  ///< height of the trusses' lower chords
    static constexpr float kRidge = 12.8F;
    static constexpr float kPlinth = 1.2F;         ///< brick wall below the sheets
    static constexpr float kClerestoryLow = 5.2F;  ///< window band of the side walls
    static constexpr float kClerestoryHigh = 7.4F;
    static constexpr float kDoorHeight = 7.2F;
    static constexpr float kDoorHalfWidth = 14.0F;
    static constexpr float kDoorGapLow = -6.2F;  ///< x from which to which the doors are open
    static constexpr float kDoorGapHigh = 4.6F;
};

/// Frames: trusses on lattice columns, purlins, rails, wind bracing.
void build_frames(SceneBuilder& builder, const AirShedMaterials& m);

/// Roof and wall sheets, plinth, gables, skylights.
void build_cladding(SceneBuilder& builder, const AirShedMaterials& m);

/// Windows of the side walls and the sliding doors.
void build_openings(SceneBuilder& builder, const AirShedMaterials& m);

/// Slabs with joints, lines, letters, drains, and the ground outside.
void build_floor(SceneBuilder& builder, const AirShedMaterials& m);

/// Steel window in the plane z = 0, its lower edge's middle in the origin, looking along +Z: frame, glazing bars,
/// panes, of which some are missing or boarded up and some wings are tilted open.
Model make_steel_window(const AirShedMaterials& m, const glm::vec2& size_m, int columns, int rows, int seed);

}  // namespace macula
