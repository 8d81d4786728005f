#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "masks/display.h"
#include "masks/level_map.h"
#include "masks/levels.h"

namespace macula {

/// Set of pixels of one tile: a word per row, bit x for column x.
using TilePixels = std::array<std::uint16_t, kTileEdge_px>;

enum class Cover : std::uint8_t { none, some, all };

/// The pixels of one eye's window that the lens shows, asked for by tiles.
class VisibleArea {
public:
    VisibleArea(const Display& display, Eye eye);

    /// For each tile of the grid, row-major: how many of its pixels are inside the window and visible.
    void cover(const TileGrid& grid, std::vector<Cover>& cover) const;

    /// Pixels inside the window and visible of the tile whose top left pixel is given; x at least -16.
    [[nodiscard]] TilePixels tile(int x_px, int y_px) const;

private:
    [[nodiscard]] const std::uint16_t* row(int y_px) const {
        return words_.data() + static_cast<std::ptrdiff_t>(y_px) * row_words_;
    }

    int height_px_;
    int row_words_;
    std::vector<std::uint16_t> words_;  ///< word i of a row holds columns 16 (i - 1) .. 16 i - 1; 0 beyond the window
};

}  // namespace macula
