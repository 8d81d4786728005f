#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/display.h"
#include "masks/make/mask.h"
#include "masks/mesh/sample_mesh.h"
#include "masks/tool/grey_picture.h"
#include "protocol/base/error.h"

namespace macula {

/// A rectangle of a mask's pixels, not empty.
struct MaskCrop {
    glm::ivec2 begin_px = glm::ivec2(0);
    glm::ivec2 size_px = glm::ivec2(0);
};

/// What `text` says: "window", what the eye's buffer shows while the gaze is on the axis; "mask", all of it; or
/// "X,Y,W,H". Errors: `option`, naming the mask's size, also where the mask does not hold the rectangle.
Expected<MaskCrop> parse_crop(const std::string& text, glm::ivec2 mask_px, glm::ivec2 gaze_px, const Display& display);

/// A part of a mask, `width_px` wide: white where pixels are sampled. Pixels of the mask that share a pixel of the
/// picture are averaged as the eye would do it, in light; the picture is sRGB.
GreyPicture mask_picture(const Mask& mask, const MaskCrop& crop, int width_px);

/// A picture of a figure, with what is written below it.
struct Panel {
    GreyPicture picture;
    std::string caption;
};

/// Panels side by side with their captions, each `width` units wide, as SVG.
Expected<std::string> panels_svg(std::span<const Panel> panels, double width, const std::string& title);
/// The pictures side by side with white between, for PNG.
GreyPicture panels_picture(std::span<const Panel> panels);

}  // namespace macula
