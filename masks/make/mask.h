#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/law.h"
#include "masks/make/recipe.h"
#include "protocol/base/error.h"

namespace macula {

/// Which pixels around the point that is looked at get a ray.
struct Mask {
    int width_px = 0;
    int height_px = 0;
    glm::ivec2 gaze_px = glm::ivec2(0);  ///< pixel that lies at the gaze
    std::vector<std::uint8_t> sampled;   ///< row-major, 0 or 1
    std::string recipe;                  ///< JSON (recipe.h); empty: unknown
};

/// Told now and then of long work: what is being done and the share 0..1 of it that is done.
using MaskProgress = std::function<void(const std::string& stage, double share)>;

/// Draws the mask of a recipe: 2W x 2H pixels for an eye of W x H, so that it covers the window for any gaze in it, and
/// with at least the sparsest tile level's density (1.6 %) everywhere, and a closed border. A full mask is W x H, for
/// it need not move. The share within the window while the gaze is on the axis is the preset's within .2 points, or for
/// a preset without share what the law gives. Errors: `option` for a preset that no placement can reach.
Expected<Mask> make_mask(const Recipe& recipe, const MaskProgress& progress = {});

/// Samples the mask's corners, and so many pixels along its border that no 8 follow each other without a sample. The
/// triangles at a border whose sites lie far apart would be slivers as long as the gaps, longer than a pixel may reach
/// (kMeshReach_px).
void close_border(Mask& mask);

/// Share 0..1 of the window's pixels that are sampled while the gaze is at `gaze_px` of the window.
double sampled_share(const Mask& mask, glm::ivec2 window_px, glm::ivec2 gaze_px);

/// Pixel of an eye's buffer on the optical axis, which lies off the middle.
glm::ivec2 axis_px(const Display& display, Eye eye);

/// Reads a user's own mask: an image of which pixels brighter than half are sampled. The gaze is its middle; text
/// chunks "macula:gaze" (X,Y) and "macula:recipe" say otherwise. Errors: `input_file`.
Expected<Mask> read_mask_png(const std::string& path);
/// Writes a 1-channel PNG with those chunks. Errors: `output`.
Expected<void> write_mask_png(const Mask& mask, const std::string& path);

}  // namespace macula
