#include "masks/rank_tile.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace macula {
namespace {

constexpr int kEdge = RankTile::kEdge_px;

class RankTileTest : public testing::TestWithParam<std::uint32_t> {
protected:
    RankTile tile_ = make_rank_tile(GetParam());
};

TEST_P(RankTileTest, HasEachRankOnceInEachCell) {
    for (int cell_y = 0; cell_y < RankTile::kCells; ++cell_y) {
        for (int cell_x = 0; cell_x < RankTile::kCells; ++cell_x) {
            std::array<int, kTileArea_px> seen{};
            for (int pixel = 0; pixel < kTileArea_px; ++pixel) {
                ++seen[tile_.at(cell_x * kTileEdge_px + pixel % kTileEdge_px,
                                cell_y * kTileEdge_px + pixel / kTileEdge_px)];
            }
            EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }))
                << "cell " << cell_x << ", " << cell_y;
        }
    }
}

/// Power spectrum of the first `count` ranks over the number of sites, its largest value beside the mean; about 1
/// for unrelated sites, the number of sites for a lattice.
double peak_structure_factor(const RankTile& tile, int count) {
    using Complex = std::complex<double>;
    std::array<Complex, kEdge> turn;
    for (int i = 0; i < kEdge; ++i) turn[i] = std::polar(1.0, -2.0 * std::numbers::pi * i / kEdge);
    std::vector<Complex> rows(std::size_t{kEdge} * kEdge);
    for (int y = 0; y < kEdge; ++y) {
        for (int x = 0; x < kEdge; ++x) {
            if (tile.at(x, y) >= count) continue;
            for (int u = 0; u < kEdge; ++u) rows[y * kEdge + u] += turn[u * x % kEdge];
        }
    }
    double peak = 0.0;
    for (int v = 0; v < kEdge; ++v) {
        for (int u = 0; u < kEdge; ++u) {
            if (u == 0 && v == 0) continue;
            Complex sum = 0.0;
            for (int y = 0; y < kEdge; ++y) sum += rows[y * kEdge + u] * turn[v * y % kEdge];
            peak = std::max(peak, std::norm(sum));
        }
    }
    return peak / (RankTile::kCells * RankTile::kCells * count);
}

TEST_P(RankTileTest, HasNoLatticePeaksAtAnyLevel) {
    for (int level = 1; level < kFullLevel; ++level) {
        const double peak = peak_structure_factor(tile_, kLevelCounts[level]);
        EXPECT_LE(peak, GetParam() == kRankTileSeed ? 12.0 : 16.0) << "level of " << kLevelCounts[level] << " samples";
        EXPECT_GE(peak, 0.1) << "level of " << kLevelCounts[level] << " samples: a spectrum without energy";
    }
}

/// Distance of the two closest sites among the first `count` ranks of every cell, on the torus.
double closest_pair_px(const RankTile& tile, int count) {
    std::vector<std::pair<int, int>> sites;
    for (int y = 0; y < kEdge; ++y) {
        for (int x = 0; x < kEdge; ++x) {
            if (tile.at(x, y) < count) sites.emplace_back(x, y);
        }
    }
    double closest = kEdge;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        for (std::size_t j = i + 1; j < sites.size(); ++j) {
            const int dx = std::abs(sites[i].first - sites[j].first);
            const int dy = std::abs(sites[i].second - sites[j].second);
            closest = std::min(closest, std::hypot(std::min(dx, kEdge - dx), std::min(dy, kEdge - dy)));
        }
    }
    return closest;
}

TEST_P(RankTileTest, KeepsTheSitesOfSparseLevelsApart) {
    for (int level = 1; kLevelCounts[level] <= 32; ++level) {
        // Sites of a square lattice of this density would be `spacing` apart; independent ones would touch.
        const double spacing = kTileEdge_px / std::sqrt(kLevelCounts[level]);
        EXPECT_GE(closest_pair_px(tile_, kLevelCounts[level]), 0.45 * spacing)
            << "level of " << kLevelCounts[level] << " samples";
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RankTileTest, testing::Values(kRankTileSeed, 1U, 2U, 3U));

TEST(RankTile, DependsOnItsSeedAlone) {
    EXPECT_EQ(make_rank_tile(7).rank, make_rank_tile(7).rank);
    EXPECT_NE(make_rank_tile(7).rank, make_rank_tile(8).rank);
}

}  // namespace
}  // namespace macula
