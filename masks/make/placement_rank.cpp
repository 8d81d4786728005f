#include <random>

#include "masks/make/placement.h"
#include "masks/rank_tile.h"

namespace macula {

Sites place_by_rank(const DensityMap& density, std::uint32_t seed) {
    static const RankTile kTile = make_rank_tile();
    std::mt19937 random(seed);
    const auto shift = [&random] { return static_cast<int>(random() % RankTile::kEdge_px); };
    const int shift_x = shift();
    const int shift_y = shift();
    Sites sites(density.density.size());
    std::size_t i = 0;
    for (int y = 0; y < density.height_px; ++y) {
        const int tile_y = (y + shift_y) % RankTile::kEdge_px;
        for (int x = 0; x < density.width_px; ++x, ++i) {
            const int rank = kTile.at((x + shift_x) % RankTile::kEdge_px, tile_y);
            // Half a rank more: the density is rounded to the nearest step, not up.
            sites[i] = static_cast<float>(rank) + 0.5F < kTileArea_px * density.density[i] ? 1 : 0;
        }
    }
    return sites;
}

}  // namespace macula
