#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "protocol/base/error.h"
#include "protocol/base/image.h"

namespace macula {

/// 0 is black, 255 is white, linear in the light that pixels stand for (a share of samples, a share that is covered).
using GreyPicture = Image<std::uint8_t>;

/// Draws a straight line of `width` pixels over what is there; pixels take the grey by the area that it covers of them.
/// Ends are cut square; parts outside the picture are left out.
void draw_line(GreyPicture& picture, glm::dvec2 from, glm::dvec2 to, double width, std::uint8_t grey);

/// The bytes of a PNG file of the picture. Errors: `internal`.
Expected<std::vector<std::uint8_t>> encode_png(const GreyPicture& picture);

}  // namespace macula
