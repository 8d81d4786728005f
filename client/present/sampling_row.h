#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "client/present/taa_kernel.h"
#include "masks/levels.h"
#include "protocol/message/message.h"

namespace macula {

/// Mean distance of samples in a tile of each level, pixels; 1 where every pixel is traced. Level 0, which has no
/// samples, counts as the sparsest.
inline std::array<float, kLevelTotal> sample_distances_px() {
    std::array<float, kLevelTotal> distances{};
    for (int level = 0; level < kLevelTotal; ++level) {
        const int count = kLevelCounts[static_cast<std::size_t>(level == 0 ? 1 : level)];
        distances[static_cast<std::size_t>(level)] = kTileEdge_px / std::sqrt(static_cast<float>(count));
    }
    return distances;
}

/// What one row of an eye's picture is worth: for each pixel its precision by whether it was traced (0 where `hidden`
/// is not 0), and by how much the colour box around it is widened. `rank_tile` and `sampling` are those of the
/// messages Welcome and Frame, which say when a pixel was traced.
void fill_sampling_row(const kernels::TaaWeights& weights, const EyeSamplingMessage& sampling,
                       std::span<const std::uint8_t> rank_tile, int rank_tile_size_px, int y,
                       std::span<const std::uint8_t> hidden, std::span<float> precision, std::span<float> slack);

}  // namespace macula
