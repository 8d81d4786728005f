#pragma once

#include <cstdint>
#include <string>

#include "masks/display.h"
#include "masks/law.h"
#include "protocol/base/error.h"

namespace macula {

/// How the sites of a mask are placed where the law asks for a density.
enum class Placement : std::uint8_t {
    void_and_cluster,  ///< threshold of the tiled blue-noise rank tile
    floyd_steinberg,   ///< error diffusion, serpentine
    poisson_disk,      ///< random order, no two closer than the local density allows
    white_noise,       ///< each pixel by itself
    quincunx,          ///< nested lattices of density 1, 1/2, 1/4, ...
};

/// Density by eccentricity on the mask.
enum class MaskGeometry : std::uint8_t {
    flat,    ///< constant pixels per degree, those of the axis: right for no gaze, little wrong for any
    planar,  ///< that of the display's plane for a gaze on the axis: exact there
};

/// Everything that a mask depends on: the same recipe gives the same mask, on every machine of one kind.
struct Recipe {
    Display display;  ///< of which the left eye counts; the right one is its mirror image
    SamplingPreset preset;
    Placement placement = Placement::void_and_cluster;
    MaskGeometry geometry = MaskGeometry::flat;
    std::uint32_t seed = 1;
};

/// Parse "void-and-cluster", "floyd-steinberg", "poisson-disk", "white-noise", "quincunx"; "flat", "planar".
/// Errors: `option`.
Expected<Placement> parse_placement(const std::string& text);
Expected<MaskGeometry> parse_mask_geometry(const std::string& text);
/// The text that is parsed to it.
std::string to_string(Placement placement);
std::string to_string(MaskGeometry geometry);

/// The recipe as JSON on one line, keys sorted: what files carry and what names a cached result. It holds the law's
/// constants and a version of the making too, so that it changes whenever the mask does.
std::string to_json(const Recipe& recipe);

/// The recipe of a JSON that to_json() wrote; the display is what masks depend on: name, size and the left eye's
/// tangents, which the right eye has mirrored. Errors: `input_file`, naming what is wrong.
Expected<Recipe> parse_recipe(const std::string& json);

/// 16 hexadecimal digits of a recipe's JSON (FNV-1a).
std::string recipe_hash(const std::string& recipe_json);

}  // namespace macula
