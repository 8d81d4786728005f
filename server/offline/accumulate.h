#pragma once

#include <functional>
#include <span>

#include <glm/vec2.hpp>

#include "server/offline/shot.h"
#include "server/render/tracer.h"

namespace macula {

/// Position `index` of `count` in a pixel, each in (0, 1): a Hammersley set (Hammersley 1960; the radical inverse is
/// van der Corput's) moved to the middle of its cells. Each of `count` columns has one, and for a power of two so does
/// each row, and each cell of any grid of powers of two. One position is the pixel's centre.
glm::vec2 sample_position(int index, int count);

/// Told after each pass: how many of how many are done.
using PassProgress = std::function<void(int done, int total)>;

/// Traces the plans of all shots `spp` times, each pass through another place of its pixels, and leaves in each shot's
/// samples the mean radiance, its display colour, and depth and object of the place nearest the pixel's centre.
/// Textures are filtered for the distance between the positions, not between pixels. `progress` may be empty.
TraceCounts accumulate(const Tracer& tracer, std::span<Shot> shots, int spp, double time_s, float exposure,
                       const PassProgress& progress);

}  // namespace macula
