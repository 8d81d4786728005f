#pragma once

#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Parts of structural steel and sheet metal in metres. uv0 is in metres: u along the longest side of a face.

/// Closed axis-aligned block around the origin.
Mesh make_block(const glm::vec3& size_m);

/// Block whose twelve edges are cut at 45 degrees by `bevel_m`, so that they catch light as worn edges do.
Mesh make_bevelled_block(const glm::vec3& size_m, float bevel_m);

/// Bars of a rolled section that stand on y = 0 along +Y, `size_m` across (x, z), of plates `thick_m` thick:
/// L with its corner at the origin and legs along +x and +z; I with its web along x; U with its back to -x.
Mesh make_angle_bar(const glm::vec2& size_m, float thick_m, float length_m);
Mesh make_i_beam(const glm::vec2& size_m, float thick_m, float length_m);
Mesh make_channel(const glm::vec2& size_m, float thick_m, float length_m);

/// Domed head on z = 0 that looks along +Z.
Mesh make_rivet(float radius_m, int sides = 5);

/// Hexagonal bolt head with washer on z = 0 that looks along +Z.
Mesh make_bolt(float radius_m);

/// Plate in the plane z = 0 around the origin, with cut corners and rivets on both faces in `rows` x `columns`.
Mesh make_gusset(const glm::vec2& size_m, float thick_m, int columns, int rows, float rivet_m);

/// What a flat lattice girder between two points consists of.
struct GirderShape {
    float depth_m = 0.6F;   ///< between the chords' middles
    float chord_m = 0.09F;  ///< legs of the double angles of the chords
    float brace_m = 0.06F;  ///< legs of the angles of diagonals and posts
    float plate_m = 0.01F;  ///< of all sections
    int panels = 8;         ///< posts and diagonals along the girder
    bool rivets = true;
};

/// Warren girder with posts: the lower chord runs from `from` to `to`, the upper one lies `depth_m` along `up` (unit,
/// at right angles to it). Double-angle chords with gussets between them.
Mesh make_girder(const glm::vec3& from, const glm::vec3& to, const glm::vec3& up, const GirderShape& shape);

/// Double angle from point to point, gap between them for a gusset; `flange` is the way the outstanding legs look.
Mesh make_double_angle(const glm::vec3& from, const glm::vec3& to, const glm::vec3& flange, float leg_m, float thick_m);

/// Open bar grating in the plane y = 0 (top) around the origin: bearing bars along z, cross rods, and a frame.
Mesh make_grating(const glm::vec2& size_m, float pitch_m, float bar_depth_m);

/// Sinusoidal sheet in the plane z = 0 around the origin, waves along x, ridges upright; both sides are to be shown.
/// `dent_m` bends it by smooth noise, `seed` differs between sheets.
struct CorrugationShape {
    float pitch_m = 0.125F;
    float depth_m = 0.03F;  ///< from trough to crest
    int pieces = 8;         ///< per wave
    int rows = 4;
    float dent_m = 0.004F;
    int seed = 0;
};
Mesh make_corrugated_sheet(const glm::vec2& size_m, const CorrugationShape& shape);

}  // namespace macula
