#pragma once

#include <cstddef>

#include "masks/sample_plan.h"
#include "server/kernels/blend.h"
#include "server/render/parallel_ranges.h"
#include "server/render/reconstructor.h"

namespace macula {

/// Makes the pixels that the lens hides black at depth 0.
inline void blacken_hidden(const SamplePlan& plan, const ReconstructTarget& target) {
    if (!plan.hidden) return;
    constexpr int kRowGrain = 64;
    parallel_ranges(0, plan.height_px, kRowGrain, [&](int first, int last) {
        for (auto y = static_cast<std::size_t>(first); y < static_cast<std::size_t>(last); ++y) {
            const std::uint8_t* const hidden = plan.hidden->data() + y * static_cast<std::size_t>(plan.width_px);
            Rgba8* const color = target.color + y * target.color_stride_px;
            float* const depth = target.inverse_depth_per_m + y * target.depth_stride_px;
            for (int x = 0; x < plan.width_px; ++x) {
                color[x] = hidden[x] != 0 ? kernels::kOpaqueBlack : color[x];
                depth[x] = hidden[x] != 0 ? 0.0F : depth[x];
            }
        }
    });
}

}  // namespace macula
