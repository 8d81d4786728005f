#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scenes/noise.h"
#include "scenes/scene.h"

namespace macula {

/// Letters of strokes: A-Z, 0-9, space and - . / : ! +, drawn as distances to polylines on a grid of 4 x 6.

/// Width of a text whose capital letters are 1 high.
float text_width(std::string_view text);

/// How much of a point is inked, 0 to 1: `at` is in letter heights from the text's lower left corner, y up.
/// `half_stroke` is half the strokes' width in letter heights and `soft` that of the edge. `stencil` leaves bridges in
/// closed letters.
float text_ink(std::string_view text, const glm::vec2& at, float half_stroke, float soft, bool stencil);

/// A piece of a decal sheet.
struct DecalPlace {
    glm::vec2 uv_low = glm::vec2(0.0F);   ///< top left
    glm::vec2 uv_high = glm::vec2(1.0F);  ///< bottom right
    float aspect = 1.0F;                  ///< width over height
};

/// What is written on a decal sheet.
struct DecalText {
    std::string text;
    int height_px = 64;                  ///< of the capitals
    glm::vec3 color = glm::vec3(0.95F);  ///< sRGB-coded
    bool stencil = true;
};

/// Texts one below another as they fit, worn by noise; alpha is ink. Same order of places as of texts. A text that does
/// not fit into the sheet is left out and has a place without area, which a test looks for.
struct DecalSheet {
    TextureImage image;
    std::vector<DecalPlace> places;
};
DecalSheet make_decal_sheet(int size_px, const std::vector<DecalText>& texts, const NoiseField& wear);

}  // namespace macula
