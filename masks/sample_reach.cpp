#include "masks/sample_reach.h"

#include <algorithm>

namespace macula {

SampleReach::SampleReach(const TileTables& tables) {
    constexpr int kCells = RankTile::kCells;
    int total = 0;
    for (int level = 1; level < kFullLevel; ++level) {
        first_[level] = total;
        total += kCells * kCells * kLevelCounts[level];
    }
    boxes_.resize(static_cast<std::size_t>(total));

    for (int level = 1; level < kFullLevel; ++level) {
        for (int cell = 0; cell < kCells * kCells; ++cell) {
            const CellTable& table = tables.cell(level, cell % kCells, cell / kCells);
            for (int pixel = 0; pixel < kTileArea_px; ++pixel) {
                for (const int index : {table.a[pixel], table.b[pixel], table.c[pixel]}) {
                    const PaletteEntry& entry = table.palette[index];
                    const int tile_dx = entry.neighbour % 3 - 1;
                    const int tile_dy = entry.neighbour / 3 - 1;
                    const int dx = pixel % kTileEdge_px - entry.pixel % kTileEdge_px - tile_dx * kTileEdge_px;
                    const int dy = pixel / kTileEdge_px - entry.pixel / kTileEdge_px - tile_dy * kTileEdge_px;
                    const int sample_cell = (cell / kCells + tile_dy + kCells) % kCells * kCells +
                                            (cell % kCells + tile_dx + kCells) % kCells;
                    Box& box = boxes_[first_[level] + sample_cell * kLevelCounts[level] + entry.rank];
                    box.left = static_cast<std::int8_t>(std::min<int>(box.left, dx));
                    box.top = static_cast<std::int8_t>(std::min<int>(box.top, dy));
                    box.right = static_cast<std::int8_t>(std::max<int>(box.right, dx));
                    box.bottom = static_cast<std::int8_t>(std::max<int>(box.bottom, dy));
                }
            }
        }
    }
}

}  // namespace macula
