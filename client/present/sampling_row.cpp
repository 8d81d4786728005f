#include "client/present/sampling_row.h"

#include <algorithm>

#include "masks/levels.h"

namespace macula {

void fill_sampling_row(const kernels::TaaWeights& weights, const EyeSamplingMessage& sampling,
                       std::span<const std::uint8_t> rank_tile, int rank_tile_size_px, int y,
                       std::span<const std::uint8_t> hidden, std::span<float> precision) {
    const int width = static_cast<int>(precision.size());
    const int shift_x = sampling.phase_px.x % kTileEdge_px;
    const int tile_y = (y + sampling.phase_px.y % kTileEdge_px) / kTileEdge_px;
    const std::uint8_t* levels = sampling.level.data() + static_cast<std::ptrdiff_t>(tile_y) * sampling.tiles_x;
    const std::uint8_t* ranks =
        rank_tile.data() +
        static_cast<std::ptrdiff_t>((y + sampling.phase_px.y) % rank_tile_size_px) * rank_tile_size_px;
    for (int tile_x = 0; tile_x < sampling.tiles_x; ++tile_x) {
        const int begin = std::max(0, tile_x * kTileEdge_px - shift_x);
        const int end = std::min(width, (tile_x + 1) * kTileEdge_px - shift_x);
        const int count = kLevelCounts[levels[tile_x]];
        // A tile is one cell of the rank tile, so its ranks stand in a row.
        const std::uint8_t* rank = ranks + (begin + sampling.phase_px.x) % rank_tile_size_px;
        for (int x = begin; x < end; ++x) {
            precision[static_cast<std::size_t>(x)] = kernels::new_precision(
                weights, rank[x - begin], count, sampling.exact, hidden[static_cast<std::size_t>(x)] != 0);
        }
    }
}

}  // namespace macula
