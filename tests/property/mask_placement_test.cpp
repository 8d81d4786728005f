#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "masks/make/placement.h"

namespace macula {
namespace {

constexpr std::array kPlacements = {Placement::void_and_cluster, Placement::floyd_steinberg, Placement::poisson_disk,
                                    Placement::white_noise, Placement::quincunx};
constexpr std::uint32_t kSeed = 20261122;

DensityMap even_density(double density, int edge_px = 256) {
    const std::size_t pixels = static_cast<std::size_t>(edge_px) * edge_px;
    return {edge_px, edge_px, std::vector<float>(pixels, static_cast<float>(density))};
}

double mean(const Sites& sites) {
    return std::accumulate(sites.begin(), sites.end(), 0.0) / static_cast<double>(sites.size());
}

/// Variance of the number of sites in 16x16 blocks over that of sites that are independent of each other: the power of
/// low frequencies. 1 for white noise, and little where noise is blue.
double low_frequency_power(const Sites& sites, int edge_px) {
    constexpr int kBlock_px = 16;
    const double density = mean(sites);
    double sum = 0.0;
    for (int block_y = 0; block_y < edge_px; block_y += kBlock_px) {
        for (int block_x = 0; block_x < edge_px; block_x += kBlock_px) {
            double count = 0.0;
            for (int y = block_y; y < block_y + kBlock_px; ++y)
                for (int x = block_x; x < block_x + kBlock_px; ++x) count += sites[y * edge_px + x];
            sum += std::pow(count - density * kBlock_px * kBlock_px, 2);
        }
    }
    return sum / (density * (1.0 - density) * edge_px * edge_px);
}

/// Squared distance of a pixel to the nearest site that is not itself; sites beyond `reach_px` are not seen.
int nearest_square(const Sites& sites, int edge_px, int x, int y, int reach_px) {
    int nearest = std::numeric_limits<int>::max();
    for (int dy = -reach_px; dy <= reach_px; ++dy) {
        for (int dx = -reach_px; dx <= reach_px; ++dx) {
            const bool inside = x + dx >= 0 && x + dx < edge_px && y + dy >= 0 && y + dy < edge_px;
            if ((dx != 0 || dy != 0) && inside && sites[(y + dy) * edge_px + x + dx] != 0)
                nearest = std::min(nearest, dx * dx + dy * dy);
        }
    }
    return nearest;
}

struct Distances {
    double least_px = std::numeric_limits<double>::infinity();
    double mean_px = 0.0;
};

/// From each site that is not near the border to its nearest neighbour.
Distances nearest_neighbours(const Sites& sites, int edge_px) {
    constexpr int kReach_px = 24;
    Distances distances;
    int count = 0;
    for (int y = kReach_px; y < edge_px - kReach_px; ++y) {
        for (int x = kReach_px; x < edge_px - kReach_px; ++x) {
            if (sites[y * edge_px + x] == 0) continue;
            const double distance_px = std::sqrt(nearest_square(sites, edge_px, x, y, kReach_px));
            distances.least_px = std::min(distances.least_px, distance_px);
            distances.mean_px += distance_px;
            ++count;
        }
    }
    distances.mean_px /= count;
    return distances;
}

class EachPlacement : public testing::TestWithParam<Placement> {};

TEST_P(EachPlacement, TakesAllPixelsWhereTheDensityIsOne) {
    DensityMap density = even_density(0.3);
    for (int y = 90; y < 160; ++y)
        for (int x = 40; x < 200; ++x) density.density[y * 256 + x] = 1.0F;
    const Sites sites = place(GetParam(), density, kSeed);
    ASSERT_EQ(sites.size(), density.density.size());
    for (int y = 90; y < 160; ++y)
        for (int x = 40; x < 200; ++x) ASSERT_EQ(sites[y * 256 + x], 1) << x << ", " << y;
    EXPECT_LT(mean(sites), 0.5);
}

TEST_P(EachPlacement, HasTheDensityThatItIsSaidToHave) {
    for (const double wished : {kLeastDensity, 0.03, 0.11, 0.27, 0.42, 0.5, 0.63, 0.81, 0.96}) {
        const double expected = placed_density(GetParam(), wished);
        const double noise = std::sqrt(wished * (1.0 - wished)) / 256;
        EXPECT_NEAR(mean(place(GetParam(), even_density(wished), kSeed)), expected, 0.02 * wished + 3.0 * noise);
        const double worst = GetParam() == Placement::quincunx ? std::sqrt(2.0) : 1.0 + 0.5 / (256 * wished);
        EXPECT_LE(std::max(expected / wished, wished / expected), worst * (1.0 + 1e-9));
    }
}

TEST_P(EachPlacement, GivesTheSameSitesForTheSameSeedAlone) {
    const DensityMap density = even_density(0.11);
    const Sites sites = place(GetParam(), density, 5);
    EXPECT_EQ(sites, place(GetParam(), density, 5));
    EXPECT_NE(sites, place(GetParam(), density, 6));
}

TEST_P(EachPlacement, HasLittlePowerInLowFrequenciesUnlessItIsWhite) {
    for (const double wished : {0.03, 0.11, 0.3, 0.46, 0.7, 0.9}) {
        const double power = low_frequency_power(place(GetParam(), even_density(wished), kSeed), 256);
        if (GetParam() == Placement::white_noise) {
            EXPECT_NEAR(power, 1.0, 0.35) << wished;  // of 256 blocks: 4 standard deviations
        } else if (mean(place(GetParam(), even_density(wished), kSeed)) < 1.0) {
            EXPECT_LT(power, 0.45) << wished;
        }
    }
}

TEST_P(EachPlacement, KeepsNeighboursApartUnlessItIsWhite) {
    for (const double wished : {kLeastDensity, 0.0625, 0.11}) {
        const Sites sites = place(GetParam(), even_density(wished), kSeed);
        // Clark and Evans (1954): 1 for independent sites, 2.149 for a triangular lattice. Two independent sites never
        // share a pixel, which keeps dense ones a little apart.
        const double apart = nearest_neighbours(sites, 256).mean_px * 2.0 * std::sqrt(mean(sites));
        if (GetParam() == Placement::white_noise) {
            EXPECT_NEAR(apart, 1.07, 0.1) << wished;
        } else {
            EXPECT_GT(apart, 1.3) << wished;
        }
    }
}

/// Between regions of different density nothing is lost and nothing gathers.
TEST_P(EachPlacement, FollowsADensityThatChanges) {
    constexpr int kEdge_px = 512;
    DensityMap density = even_density(1.0, kEdge_px);
    for (int y = 0; y < kEdge_px; ++y) {
        for (int x = 0; x < kEdge_px; ++x) {
            const double distance = std::hypot(x - 255.5, y - 255.5);
            density.density[y * kEdge_px + x] =
                static_cast<float>(std::clamp(40.0 / distance - 0.1, kLeastDensity, 1.0));
        }
    }
    const Sites sites = place(GetParam(), density, kSeed);
    constexpr int kRing_px = 16;
    for (int ring = 0; ring < 256 / kRing_px; ++ring) {
        double expected = 0.0;
        double variance = 0.0;
        double count = 0.0;
        for (int y = 0; y < kEdge_px; ++y) {
            for (int x = 0; x < kEdge_px; ++x) {
                if (static_cast<int>(std::hypot(x - 255.5, y - 255.5)) / kRing_px != ring) continue;
                const double wished = density.at(x, y);
                expected += placed_density(GetParam(), wished);
                variance += wished * (1.0 - wished);
                count += sites[y * kEdge_px + x];
            }
        }
        EXPECT_NEAR(count, expected, 3.5 * std::sqrt(variance) + 0.01 * expected) << "ring " << ring;
    }
}

/// Neither sparse sites nor sparse gaps clear the edge of what is dense.
TEST_P(EachPlacement, KeepsTheEdgeOfADenseRegion) {
    for (const double sparse : {0.02, 0.985}) {
        DensityMap density = even_density(sparse, 512);
        for (int y = 0; y < 512; ++y)
            for (int x = 256; x < 512; ++x) density.density[y * 512 + x] = 0.5F;
        const Sites sites = place(GetParam(), density, kSeed);
        double count = 0.0;
        for (int y = 0; y < 512; ++y)
            for (int x = 256; x < 260; ++x) count += sites[y * 512 + x];
        EXPECT_NEAR(count / (4 * 512), 0.5, 0.06) << "beside " << sparse;
    }
}

INSTANTIATE_TEST_SUITE_P(Placements, EachPlacement, testing::ValuesIn(kPlacements), [](const auto& each) {
    std::string name = to_string(each.param);
    std::erase(name, '-');
    return name;
});

TEST(PoissonDisk, LeavesNeitherPairsNorHoles) {
    for (const double wished : {kLeastDensity, 0.03, 0.05, 0.09}) {
        const Sites sites = place_poisson_disk(even_density(wished), kSeed);
        // Random packing of disks in the plane jams at .547 of the area (Tanemura 1979).
        const double radius_px = 2.0 * std::sqrt(0.547 / (3.14159265 * wished));
        EXPECT_GE(nearest_neighbours(sites, 256).least_px, 0.8 * radius_px) << wished;
        const int reach_px = static_cast<int>(std::ceil(1.15 * radius_px));
        for (int y = reach_px; y < 256 - reach_px; ++y) {
            for (int x = reach_px; x < 256 - reach_px; ++x) {
                if (sites[y * 256 + x] == 0) {
                    ASSERT_LE(std::sqrt(nearest_square(sites, 256, x, y, reach_px)), 1.15 * radius_px)
                        << wished << ": a hole at " << x << ", " << y;
                }
            }
        }
    }
}

/// What makes a density that changes from pixel to pixel harmless.
TEST(NestedPlacements, KeepTheSitesOfLowerDensities) {
    for (const Placement placement : {Placement::void_and_cluster, Placement::quincunx, Placement::white_noise}) {
        Sites before(std::size_t{256} * 256, 0);
        for (const double wished : {kLeastDensity, 0.03, 0.06, 0.12, 0.25, 0.5, 1.0}) {
            const Sites sites = place(placement, even_density(wished), kSeed);
            for (std::size_t i = 0; i < sites.size(); ++i) ASSERT_GE(sites[i], before[i]) << to_string(placement);
            before = sites;
        }
    }
}

TEST(Quincunx, IsTheLatticeOfTheDensity) {
    for (int lattice = 0; lattice <= 6; ++lattice) {
        const double density = std::exp2(-lattice);
        const Sites sites = place_quincunx(even_density(density), kSeed);
        EXPECT_EQ(mean(sites), density);
        // Square lattices of edge 2^(lattice/2), straight or diagonal: four neighbours at that distance.
        const Distances distances = nearest_neighbours(sites, 256);
        EXPECT_NEAR(distances.least_px, std::sqrt(1.0 / density), 1e-9);
        EXPECT_NEAR(distances.mean_px, std::sqrt(1.0 / density), 1e-9);
    }
}

}  // namespace
}  // namespace macula
