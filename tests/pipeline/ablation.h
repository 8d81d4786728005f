#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "client/present/taa_kernel.h"
#include "masks/display.h"
#include "masks/tile_sampler.h"
#include "protocol/base/error.h"
#include "server/render/tracer.h"

namespace macula::test {

// Models that can be switched off one by one, to see what each is worth. A Row names those that are off; none by
// default.
//
//   hidden-area         pixels that the lens hides are traced and judged like any other
//   true-tangents       the sampler takes the frustum for symmetric, with the same opening angles, as projections do
//                       that are made of a field of view; of vive's, the fovea then lies 4 degrees beside the gaze
//   footprint-mips      textures, normal maps too, are read at full resolution, not under the footprint of the sample
//   normal-roughness    roughness does not grow by what a footprint averages over of a normal map
//   hysteresis          tiles change their level at once, in both directions
//   eccentricity-weight every pixel of a new frame counts the same for the history, traced or not: a tenth of the
//                       result once the history has settled, the usual weight (Karis 2014, "High-Quality Temporal
//                       Supersampling")
//   bounce-bound        every reflection and refraction is traced, however little of it arrives

/// Names of all models, in the order above.
const std::vector<std::string>& ablation_names();

/// Errors: `option` for a name that is not one of them.
Expected<void> check_ablation(const std::set<std::string>& without);

/// The display as renderer and metrics take it.
Display ablated_display(Display display, const std::set<std::string>& without);
/// The display as the sampler is told it. The same pixels are hidden as in ablated_display().
Display ablated_sampler_display(Display display, const std::set<std::string>& without);
TileSamplerOptions ablated_sampler_options(const std::set<std::string>& without);
TracerOptions ablated_tracer_options(const std::set<std::string>& without);
/// A tracer that reads textures as `without` says.
std::shared_ptr<const Tracer> ablated_tracer(std::shared_ptr<const Tracer> tracer,
                                             const std::set<std::string>& without);
/// Without eccentricity-weight, weights that count all pixels the same already, as the paper's do, stay as they are.
kernels::TaaWeights ablated_taa_weights(kernels::TaaWeights weights, const std::set<std::string>& without);

}  // namespace macula::test
