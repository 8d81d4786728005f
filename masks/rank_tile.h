#pragma once

#include <array>
#include <cstdint>

#include "masks/levels.h"

namespace macula {

/// Blue-noise rank tile on a 64x64 torus, stratified: in each of its sixteen 16x16 cells the ranks 0..255 occur
/// once, and the first n ranks of all cells together are well spread, for every n.
struct RankTile {
    static constexpr int kEdge_px = 64;
    static constexpr int kCells = kEdge_px / kTileEdge_px;  ///< cells along an edge

    std::array<std::uint8_t, kEdge_px * kEdge_px> rank{};  ///< row-major: rank order of the pixel in its cell

    [[nodiscard]] std::uint8_t at(int x, int y) const { return rank[y * kEdge_px + x]; }
};

/// Of the seeds 1..24 the one whose sites have the flattest spectrum: over all levels, the structure factor peaks
/// at 11.1 (others 11.4..16.2; a plain 16x16 tile 148).
inline constexpr std::uint32_t kRankTileSeed = 18;

/// Makes the tile by void-and-cluster (Ulichney 1993) with the cells served in rounds. Deterministic for a seed
/// on one machine; between machines the tile itself travels (Welcome), never the seed.
RankTile make_rank_tile(std::uint32_t seed = kRankTileSeed);

}  // namespace macula
