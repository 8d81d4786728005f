#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "masks/levels.h"
#include "masks/rank_tile.h"
#include "masks/sample_plan.h"

namespace macula {

inline constexpr int kCellTotal = RankTile::kCells * RankTile::kCells;

/// Bits of x and y below 2^16 interleaved, x lowest: neighbours along this number are neighbours in the plane.
std::uint32_t morton(std::uint32_t x, std::uint32_t y);

/// The order of samples inside a tile, for each level and each of the sixteen cells of the rank tile. Addresses and
/// positions here are relative to the tile.
class SampleOrder {
public:
    explicit SampleOrder(const RankTile& rank_tile);

    /// Position of each address of a tile: by rank, in a full tile row by row. A sparser level's are the first ones.
    [[nodiscard]] const std::array<SamplePosition, kTileArea_px>& positions(int level, int cell) const {
        return level == kFullLevel ? raster_ : by_rank_[cell];
    }
    /// The tile's addresses in Morton order of their pixels.
    [[nodiscard]] std::span<const std::uint8_t> trace_order(int level, int cell) const {
        return trace_order_[level * kCellTotal + cell];
    }

private:
    std::array<SamplePosition, kTileArea_px> raster_{};
    std::array<std::array<SamplePosition, kTileArea_px>, kCellTotal> by_rank_{};
    std::vector<std::vector<std::uint8_t>> trace_order_;
};

}  // namespace macula
