#include "masks/tile_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace macula {
namespace {

constexpr int kEdge = RankTile::kEdge_px;

glm::ivec2 pixel_of(int index) {
    return {index % kTileEdge_px, index / kTileEdge_px};
}

/// Position of a palette entry relative to the tile that refers to it.
glm::ivec2 position_of(const PaletteEntry& entry) {
    return kTileEdge_px * glm::ivec2(entry.neighbour % 3 - 1, entry.neighbour / 3 - 1) + pixel_of(entry.pixel);
}

int rank_at(const RankTile& tile, const glm::ivec2& p) {
    return tile.at(p.x & (kEdge - 1), p.y & (kEdge - 1));
}

int area2(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// One pixel's three corners, relative to its tile, and weights.
struct Pixel {
    std::array<glm::ivec2, 3> corner;
    std::array<int, 3> weight;
};

Pixel read(const CellTable& table, int pixel) {
    const int b = table.weight_b[pixel];
    const int c = table.weight_c[pixel];
    return {{position_of(table.palette[table.a[pixel]]), position_of(table.palette[table.b[pixel]]),
             position_of(table.palette[table.c[pixel]])},
            {256 - b - c, b, c}};
}

class TileTablesTest : public testing::TestWithParam<std::uint32_t> {
protected:
    /// Calls visit(table, level, cell origin in the rank tile) for all tables.
    template <class Visit>
    void for_each_table(Visit visit) const {
        for (int level = 1; level < kFullLevel; ++level) {
            for (int cell = 0; cell < RankTile::kCells * RankTile::kCells; ++cell) {
                const glm::ivec2 at(cell % RankTile::kCells, cell / RankTile::kCells);
                SCOPED_TRACE(testing::Message()
                             << "level of " << kLevelCounts[level] << " samples, cell " << at.x << ", " << at.y);
                visit(tables_.cell(level, at.x, at.y), level, at * kTileEdge_px);
                if (HasFailure()) return;
            }
        }
    }

    /// Made once for all tests of a seed.
    static const TileTables& tables_of(std::uint32_t seed) {
        static std::map<std::uint32_t, TileTables> made;
        return made.try_emplace(seed, make_rank_tile(seed)).first->second;
    }

    const TileTables& tables_ = tables_of(GetParam());
    const RankTile& tile_ = tables_.rank_tile();
};

TEST_P(TileTablesTest, PaletteEntriesAreSamplesOfTheLevelAndOwnOnesComeFirst) {
    for_each_table([this](const CellTable& table, int level, const glm::ivec2& origin) {
        const int count = kLevelCounts[level];
        ASSERT_GE(table.palette.size(), static_cast<std::size_t>(count));
        ASSERT_LE(table.palette.size(), 256U);
        std::set<std::pair<int, int>> distinct;
        for (std::size_t i = 0; i < table.palette.size(); ++i) {
            const PaletteEntry& entry = table.palette[i];
            EXPECT_EQ(entry.rank, rank_at(tile_, origin + position_of(entry)));
            EXPECT_LT(entry.rank, count);
            EXPECT_EQ(entry.neighbour == 4, i < static_cast<std::size_t>(count));
            if (entry.neighbour == 4) {
                EXPECT_EQ(entry.rank, i);
            }
            distinct.emplace(entry.neighbour, entry.pixel);
        }
        EXPECT_EQ(distinct.size(), table.palette.size());
    });
}

TEST_P(TileTablesTest, InterpolationReproducesThePosition) {
    for_each_table([](const CellTable& table, int, const glm::ivec2&) {
        for (int i = 0; i < kTileArea_px; ++i) {
            const Pixel pixel = read(table, i);
            glm::dvec2 position(0.0);
            double reach = 0.0;
            for (int k = 0; k < 3; ++k) {
                position += pixel.weight[k] / 256.0 * glm::dvec2(pixel.corner[k]);
                reach += glm::distance(glm::dvec2(pixel.corner[k]), glm::dvec2(pixel.corner[0]));
            }
            ASSERT_GE(pixel.weight[0], std::max(pixel.weight[1], pixel.weight[2]));
            // Each weight is off by half a unit, one of them by one and a half.
            ASSERT_LE(glm::distance(position, glm::dvec2(pixel_of(i))), 1.5 / 256.0 * reach + 1e-9);
        }
    });
}

TEST_P(TileTablesTest, EachPixelLiesInItsTriangle) {
    for_each_table([](const CellTable& table, int, const glm::ivec2&) {
        for (int i = 0; i < kTileArea_px; ++i) {
            const Pixel pixel = read(table, i);
            const auto& [a, b, c] = pixel.corner;
            if (a == b || a == c || b == c) continue;  // weightless corners repeat the first
            const glm::ivec2 p = pixel_of(i);
            const int sign = area2(a, b, c) > 0 ? 1 : -1;
            ASSERT_GE(sign * area2(a, b, p), 0);
            ASSERT_GE(sign * area2(b, c, p), 0);
            ASSERT_GE(sign * area2(c, a, p), 0);
        }
    });
}

TEST_P(TileTablesTest, SampledPixelsAreTheirOwnSample) {
    for_each_table([this](const CellTable& table, int level, const glm::ivec2& origin) {
        for (int i = 0; i < kTileArea_px; ++i) {
            const bool sampled = rank_at(tile_, origin + pixel_of(i)) < kLevelCounts[level];
            const bool alone = table.weight_b[i] == 0 && table.weight_c[i] == 0;
            if (sampled) {
                ASSERT_TRUE(alone);
                ASSERT_EQ(table.a[i], rank_at(tile_, origin + pixel_of(i)));
            }
            ASSERT_TRUE(table.weight_b[i] > 0 || table.b[i] == table.a[i]);
            ASSERT_TRUE(table.weight_c[i] > 0 || table.c[i] == table.a[i]);
        }
    });
}

/// Whether `p` lies strictly inside the circle through the corners of the counter-clockwise triangle.
bool in_circle(const std::array<glm::ivec2, 3>& t, const glm::ivec2& p) {
    std::array<std::int64_t, 3> x{};
    std::array<std::int64_t, 3> y{};
    std::array<std::int64_t, 3> square{};
    for (int i = 0; i < 3; ++i) {
        x[i] = t[i].x - p.x;
        y[i] = t[i].y - p.y;
        square[i] = x[i] * x[i] + y[i] * y[i];
    }
    return square[0] * (x[1] * y[2] - x[2] * y[1]) - square[1] * (x[0] * y[2] - x[2] * y[0]) +
               square[2] * (x[0] * y[1] - x[1] * y[0]) >
           0;
}

TEST_P(TileTablesTest, NoSampleLiesInACircleOfATriangle) {
    for_each_table([this](const CellTable& table, int level, const glm::ivec2& origin) {
        for (int i = 0; i < kTileArea_px; ++i) {
            auto [corner, weight] = read(table, i);
            if (weight[2] == 0 || weight[1] == 0) continue;
            if (area2(corner[0], corner[1], corner[2]) < 0) std::swap(corner[1], corner[2]);
            // The neighbourhood that a circle without samples can reach from a pixel inside it.
            const int radius = static_cast<int>(std::ceil(40.0 / std::sqrt(kLevelCounts[level])));
            for (int dy = -radius; dy <= radius; ++dy) {
                for (int dx = -radius; dx <= radius; ++dx) {
                    const glm::ivec2 p = pixel_of(i) + glm::ivec2(dx, dy);
                    if (rank_at(tile_, origin + p) >= kLevelCounts[level]) continue;
                    ASSERT_FALSE(in_circle(corner, p)) << "pixel " << i << ", sample " << p.x << ", " << p.y;
                }
            }
        }
    });
}

/// Longest palette of the sixteen cells of a level.
int longest_palette(const TileTables& tables, int level) {
    int longest = 0;
    for (int cell = 0; cell < RankTile::kCells * RankTile::kCells; ++cell) {
        const auto& palette = tables.cell(level, cell % RankTile::kCells, cell / RankTile::kCells).palette;
        longest = std::max(longest, static_cast<int>(palette.size()));
    }
    return longest;
}

/// Sizes of another implementation of the same method (16x16 cells on a 64x64 tile, other seeds).
TEST_P(TileTablesTest, PalettesAreAsShortAsKnown) {
    const std::vector<std::pair<int, int>> known = {{4, 17},   {8, 23},    {16, 34},   {32, 53},  {64, 88},
                                                    {96, 119}, {128, 151}, {192, 203}, {224, 230}};
    for (const auto& [count, size] : known) {
        const int level =
            static_cast<int>(std::find(kLevelCounts.begin(), kLevelCounts.end(), count) - kLevelCounts.begin());
        EXPECT_NEAR(longest_palette(tables_, level), size, 4) << "level of " << count << " samples";
    }
}

TEST_P(TileTablesTest, AllTablesTakeHalfAMegabyte) {
    std::size_t bytes = 0;
    for_each_table([&bytes](const CellTable& table, int, const glm::ivec2&) {
        bytes += sizeof(CellTable) + table.palette.size() * sizeof(PaletteEntry);
    });
    EXPECT_GE(bytes, 400'000U);
    EXPECT_LE(bytes, 600'000U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TileTablesTest, testing::Values(kRankTileSeed, 2U, 20261122U));

TEST(TileTables, RefusesARankTileThatLeavesGaps) {
    RankTile rows;
    for (std::size_t i = 0; i < rows.rank.size(); ++i) rows.rank[i] = static_cast<std::uint8_t>(i / 16);
    EXPECT_THROW(TileTables{rows}, std::invalid_argument);
}

}  // namespace
}  // namespace macula
