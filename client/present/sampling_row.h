#pragma once

#include <cstdint>
#include <span>

#include "client/present/taa_kernel.h"
#include "protocol/message/message.h"

namespace macula {

/// What one row of an eye's picture is worth: for each pixel its precision by whether it was traced (0 where `hidden`
/// is not 0). `rank_tile` and `sampling` are those of the messages Welcome and Frame, which say when a pixel was
/// traced.
void fill_sampling_row(const kernels::TaaWeights& weights, const EyeSamplingMessage& sampling,
                       std::span<const std::uint8_t> rank_tile, int rank_tile_size_px, int y,
                       std::span<const std::uint8_t> hidden, std::span<float> precision);

}  // namespace macula
