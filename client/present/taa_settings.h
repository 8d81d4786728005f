#pragma once

#include <limits>

#include "client/present/taa_kernel.h"

namespace macula {

/// The weights that were measured best (tests/bench/taa_quality.cpp): PSNR at rest and under head motion.
inline kernels::TaaWeights default_taa_weights() {
    return {.traced = 1.0F,
            .interpolated = 0.02F,
            .limit = 1.0F,
            .moving_loss = 0.5F,
            .disparity_px = 1.5F,
            .knows_motion = 1};
}

/// What the paper does: the mean of the new picture and of the last one, reprojected by depth as if all stood still.
/// Whatever was inside the last picture is believed.
inline kernels::TaaWeights paper_taa_weights() {
    return {.traced = 1.0F,
            .interpolated = 1.0F,
            .limit = 1.0F,
            .moving_loss = 0.0F,
            .disparity_px = std::numeric_limits<float>::max(),
            .knows_motion = 0};
}

/// No history: each frame is shown as it came.
inline kernels::TaaWeights no_taa_weights() {
    kernels::TaaWeights weights = default_taa_weights();
    weights.limit = 0.0F;
    return weights;
}

}  // namespace macula
