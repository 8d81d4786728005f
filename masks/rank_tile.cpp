#include "masks/rank_tile.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <random>
#include <vector>

namespace macula {
namespace {

constexpr int kEdge = RankTile::kEdge_px;
constexpr int kArea = kEdge * kEdge;
constexpr int kCellTotal = RankTile::kCells * RankTile::kCells;
constexpr int kRanks = kTileArea_px;
constexpr int kSeedsPerCell = 4;

using Sites = std::bitset<kArea>;
using Cells = std::bitset<kCellTotal>;

int cell_of(int pixel) {
    return pixel / kEdge / kTileEdge_px * RankTile::kCells + pixel % kEdge / kTileEdge_px;
}

/// Gaussian energy of a set of sites on the torus. Fixed point, so that taking a site away is the exact inverse
/// of putting it, whatever the order.
class Energy {
public:
    explicit Energy(std::mt19937& random) : tie_break_(kArea), energy_(kArea), kernel_(std::size_t{2} * kArea) {
        for (auto& value : tie_break_) value = static_cast<std::int32_t>(random() & 255U);
    }

    /// Widens or narrows the kernel for `sites_per_cell` and sums again where that changes it.
    void fit(int sites_per_cell, const Sites& sites) {
        const double wanted = 0.35 * std::sqrt(static_cast<double>(kRanks) / std::max(sites_per_cell, 1));
        const int quarter_octave = std::max(0, static_cast<int>(std::lround(4.0 * std::log2(wanted))));
        if (quarter_octave == quarter_octave_) return;
        quarter_octave_ = quarter_octave;
        make_kernel(std::exp2(quarter_octave / 4.0));
        energy_ = tie_break_;
        for (int pixel = 0; pixel < kArea; ++pixel) {
            if (sites[pixel]) add(pixel, 1);
        }
    }

    void add(int site, int sign) {
        const int site_x = site % kEdge;
        const int site_y = site / kEdge;
        for (int y = 0; y < kEdge; ++y) {
            const std::int32_t* kernel = &kernel_[2 * kEdge * ((y - site_y) & (kEdge - 1)) + kEdge - site_x];
            std::int32_t* row = &energy_[y * kEdge];
            for (int x = 0; x < kEdge; ++x) row[x] += sign * kernel[x];
        }
    }

    [[nodiscard]] std::int32_t at(int pixel) const { return energy_[pixel]; }

private:
    /// Each row twice in a row, so that a shifted row needs no wrapping.
    void make_kernel(double sigma_px) {
        constexpr double kUnit = 1 << 22;
        for (int y = 0; y < kEdge; ++y) {
            for (int x = 0; x < 2 * kEdge; ++x) {
                const double dx = std::min(x % kEdge, kEdge - x % kEdge);
                const double dy = std::min(y, kEdge - y);
                kernel_[2 * kEdge * y + x] = static_cast<std::int32_t>(
                    std::lround(kUnit * std::exp(-(dx * dx + dy * dy) / (2.0 * sigma_px * sigma_px))));
            }
        }
    }

    int quarter_octave_ = -1;
    std::vector<std::int32_t> tie_break_;  ///< noise of at most 1/16384 of a site's own energy
    std::vector<std::int32_t> energy_;
    std::vector<std::int32_t> kernel_;
};

/// Site of highest energy in the given cells.
int tightest_cluster(const Energy& energy, const Sites& sites, const Cells& cells) {
    int best = -1;
    for (int pixel = 0; pixel < kArea; ++pixel) {
        if (sites[pixel] && cells[cell_of(pixel)] && (best < 0 || energy.at(pixel) > energy.at(best))) best = pixel;
    }
    return best;
}

/// Free pixel of lowest energy in the given cells.
int largest_void(const Energy& energy, const Sites& sites, const Cells& cells) {
    int best = -1;
    for (int pixel = 0; pixel < kArea; ++pixel) {
        if (!sites[pixel] && cells[cell_of(pixel)] && (best < 0 || energy.at(pixel) < energy.at(best))) best = pixel;
    }
    return best;
}

/// A few random sites in each cell, moved apart until the tightest cluster is where the largest void is.
Sites seed_sites(Energy& energy, std::mt19937& random) {
    Sites sites;
    for (int cell = 0; cell < kCellTotal; ++cell) {
        for (int placed = 0; placed < kSeedsPerCell;) {
            const int x = cell % RankTile::kCells * kTileEdge_px + static_cast<int>(random() % kTileEdge_px);
            const int y = cell / RankTile::kCells * kTileEdge_px + static_cast<int>(random() % kTileEdge_px);
            if (sites[y * kEdge + x]) continue;
            sites[y * kEdge + x] = true;
            ++placed;
        }
    }
    energy.fit(kSeedsPerCell, sites);
    // Settles within a few hundred moves; the bound is for the case of a cycle.
    for (int move = 0; move < 10000; ++move) {
        const int from = tightest_cluster(energy, sites, Cells().set());
        sites[from] = false;
        energy.add(from, -1);
        const int to = largest_void(energy, sites, Cells().set(cell_of(from)));
        sites[to] = true;
        energy.add(to, 1);
        if (to == from) break;
    }
    return sites;
}

}  // namespace

RankTile make_rank_tile(std::uint32_t seed) {
    std::mt19937 random(seed);
    Energy energy(random);
    Sites sites = seed_sites(energy, random);
    RankTile tile;

    Energy fewer = energy;
    Sites left = sites;
    for (int rank = kSeedsPerCell - 1; rank >= 0; --rank) {
        fewer.fit(rank + 1, left);
        for (Cells unserved = Cells().set(); unserved.any();) {
            const int site = tightest_cluster(fewer, left, unserved);
            left[site] = false;
            fewer.add(site, -1);
            tile.rank[site] = static_cast<std::uint8_t>(rank);
            unserved[cell_of(site)] = false;
        }
    }

    for (int rank = kSeedsPerCell; rank < kRanks; ++rank) {
        energy.fit(rank, sites);
        for (Cells unserved = Cells().set(); unserved.any();) {
            const int site = largest_void(energy, sites, unserved);
            sites[site] = true;
            energy.add(site, 1);
            tile.rank[site] = static_cast<std::uint8_t>(rank);
            unserved[cell_of(site)] = false;
        }
    }
    return tile;
}

}  // namespace macula
