#pragma once

#include <array>

#include "masks/display.h"
#include "masks/law.h"

namespace macula {

/// Sizes and resolutions of three eccentricity layers.
struct LayerChoice {
    std::array<double, 2> radius_rad = {};            ///< of the inner and the middle layer
    std::array<double, 3> step_px = {1.0, 1.0, 1.0};  ///< distance of samples: inner, middle, outer
    double samples = 0.0;                             ///< inside the window, with the gaze on the axis, as estimated
};

/// Width over which a layer comes in over the next, in samples of that next one: enough for the eye not to see an edge
/// where the resolution jumps. The paper says that layers are blended smoothly, not over which width.
inline constexpr double kFadeSamples = 2.0;

/// The choice with the least samples of which each layer is as dense as a law asks for where it begins (Guenter et al.
/// 2012): a layer that begins at eccentricity e has s = max(1, (w0 + m e) / w*) pixels a sample, where w* is
/// the angle of two pixels, a cycle, at the axis. The inner layer has a sample a pixel and ends no sooner than s > 1.
///
/// The paper counts the samples of whole layers because it renders them whole; here those under a finer layer are not
/// traced, so they are not counted.
LayerChoice choose_layers(const Display& display, Eye eye, const LinearMar& law);

}  // namespace macula
