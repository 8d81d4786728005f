#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "masks/levels.h"
#include "masks/rank_tile.h"

namespace macula {

/// A sample that pixels of a tile interpolate.
struct PaletteEntry {
    std::uint8_t neighbour = 4;  ///< tile it lies in: 3 (dy + 1) + (dx + 1); 4 is the tile itself
    std::uint8_t rank = 0;       ///< rank order in that tile; exists there if rank < the tile's count
    std::uint8_t pixel = 0;      ///< 16 y + x in that tile
};

/// How the 256 pixels of a tile interpolate at one level, for one cell of the rank tile: three palette entries
/// and two weights in 1/256 each; the weight of `a`, the largest, is 256 - weight_b - weight_c. From the
/// Delaunay triangulation of the level's sites, repeated periodically.
struct CellTable {
    std::vector<PaletteEntry> palette;  ///< at most 256; the tile's own samples first, by rank
    std::array<std::uint8_t, kTileArea_px> a{};
    std::array<std::uint8_t, kTileArea_px> b{};
    std::array<std::uint8_t, kTileArea_px> c{};
    std::array<std::uint8_t, kTileArea_px> weight_b{};
    std::array<std::uint8_t, kTileArea_px> weight_c{};
};

/// Interpolation tables of every level and cell, computed once at start and shared by all sessions.
class TileTables {
public:
    /// Triangulates every level of the rank tile (.2 s). Throws std::invalid_argument for a tile that is not
    /// stratified and well spread, so that a pixel interpolates beyond its neighbour tiles.
    explicit TileTables(const RankTile& rank_tile);

    [[nodiscard]] const RankTile& rank_tile() const { return rank_tile_; }
    /// Table of a level in 1..kFullLevel - 1 (a full tile is copied) for cell column and row in 0..3. The cell of
    /// tile (tx, ty) of a plan is ((origin_px + 16 t + phase_px) mod 64) / 16.
    [[nodiscard]] const CellTable& cell(int level, int cell_x, int cell_y) const {
        return cells_[(level * RankTile::kCells + cell_y) * RankTile::kCells + cell_x];
    }

private:
    RankTile rank_tile_;
    std::vector<CellTable> cells_;
};

}  // namespace macula
