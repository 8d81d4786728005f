#include "masks/sample_order.h"

#include <algorithm>
#include <numeric>

namespace macula {

std::uint32_t morton(std::uint32_t x, std::uint32_t y) {
    std::uint32_t code = 0;
    for (std::uint32_t bit = 0; bit < 16; ++bit) code |= (x >> bit & 1U) << 2 * bit | (y >> bit & 1U) << (2 * bit + 1);
    return code;
}

SampleOrder::SampleOrder(const RankTile& rank_tile) : trace_order_(std::size_t{kLevelTotal} * kCellTotal) {
    for (int pixel = 0; pixel < kTileArea_px; ++pixel) {
        const int x = pixel % kTileEdge_px;
        const int y = pixel / kTileEdge_px;
        const SamplePosition position{static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
        raster_[pixel] = position;
        for (int cell = 0; cell < kCellTotal; ++cell) {
            const int rank =
                rank_tile.at(cell % RankTile::kCells * kTileEdge_px + x, cell / RankTile::kCells * kTileEdge_px + y);
            by_rank_[cell][rank] = position;
        }
    }
    for (int level = 1; level < kLevelTotal; ++level) {
        for (int cell = 0; cell < kCellTotal; ++cell) {
            const auto code = [&positions = positions(level, cell)](std::uint8_t address) {
                return morton(static_cast<std::uint32_t>(positions[address].x_px),
                              static_cast<std::uint32_t>(positions[address].y_px));
            };
            auto& order = trace_order_[level * kCellTotal + cell];
            order.resize(kLevelCounts[level]);
            std::iota(order.begin(), order.end(), std::uint8_t{0});
            std::sort(order.begin(), order.end(),
                      [&code](std::uint8_t a, std::uint8_t b) { return code(a) < code(b); });
        }
    }
}

}  // namespace macula
