#pragma once

#include <vector>

#include "masks/sample_plan.h"

namespace macula {

/// Offsets of the pixels within kernels::kNearbyRadius_px, (0, 0) first, in the order of
/// server/kernels/nearest_samples.h: by distance, then the nearer column, the left, the upper.
std::vector<SamplePosition> nearest_offsets();

}  // namespace macula
