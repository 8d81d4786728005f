#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "masks/mesh/mesh_quality.h"
#include "tests/support/triangulated.h"

namespace macula {
namespace {

using testing::scattered_sites;
using testing::triangulated;

SampleMesh lattice(int side, bool (*taken)(int x, int y)) {
    std::vector<SamplePosition> site;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            if (taken(x, y)) site.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
    return triangulated(side, side, site);
}

TEST(MeshQuality, FullGridIsHalfSquares) {
    const TriangleQuality q = triangle_quality(lattice(41, [](int, int) { return true; }));
    EXPECT_EQ(q.triangles, 3200U);
    EXPECT_EQ(q.doubled_area_px2, 3200);
    EXPECT_DOUBLE_EQ(q.longest_edge_px, std::sqrt(2.0));
    EXPECT_NEAR(q.smallest_angle_min_rad, M_PI / 4, 1e-6);
    EXPECT_NEAR(q.smallest_angle_median_rad, M_PI / 4, 1e-6);
    EXPECT_NEAR(q.aspect_p50, (1.0 + std::sqrt(2.0)) / 2.0, 1e-6);  // R = sqrt(2) / 2, r = 1 - sqrt(2) / 2
    EXPECT_NEAR(q.aspect_p99, q.aspect_p50, 1e-6);
}

TEST(MeshQuality, ThreeFourFive) {
    SampleMesh mesh;
    mesh.site = {{0, 0}, {0, 30}, {40, 0}};
    mesh.triangle = {{0, 1, 2}};
    const TriangleQuality q = triangle_quality(mesh);
    EXPECT_EQ(q.doubled_area_px2, 1200);
    EXPECT_DOUBLE_EQ(q.longest_edge_px, 50.0);
    EXPECT_NEAR(q.smallest_angle_min_rad, std::atan(0.75), 1e-6);
    EXPECT_NEAR(q.aspect_p50, 1.25, 1e-6);  // R = 25, r = 10
    EXPECT_EQ(triangle_quality(SampleMesh{}).triangles, 0U);
    EXPECT_EQ(triangle_quality(SampleMesh{}).aspect_p99, 0.0);
}

TEST(MeshQuality, QuantilesAreTakenOverTriangles) {
    // 98 right triangles of legs 10 and 10, two of legs 10 and 1.
    SampleMesh mesh;
    mesh.site = {{0, 0}, {0, 10}, {10, 0}, {1, 0}};
    mesh.triangle.assign(98, {0, 1, 2});
    mesh.triangle.insert(mesh.triangle.begin() + 40, 2, {0, 1, 3});
    const TriangleQuality q = triangle_quality(mesh);
    EXPECT_NEAR(q.smallest_angle_min_rad, std::atan(0.1), 1e-6);
    EXPECT_NEAR(q.smallest_angle_p1_rad, std::atan(0.1), 1e-6);
    EXPECT_NEAR(q.smallest_angle_median_rad, M_PI / 4, 1e-6);
    EXPECT_NEAR(q.aspect_p50, (1.0 + std::sqrt(2.0)) / 2.0, 1e-6);
    const double thin = 10.0 * std::sqrt(101.0) * (11.0 + std::sqrt(101.0)) / (4.0 * 100.0);
    EXPECT_NEAR(q.aspect_p99, thin, 1e-5);
}

TEST(MeshSpacing, Lattices) {
    const std::array<double, 3> edges = {0.0, 8.0, 1000.0};
    const auto full = spacing_rings(lattice(65, [](int, int) { return true; }), edges);
    ASSERT_EQ(full.size(), 2U);
    for (const SpacingRing& ring : full) {
        EXPECT_EQ(ring.sites, ring.pixels);
        EXPECT_EQ(ring.nearest_min_px, 1.0);
        EXPECT_EQ(ring.nearest_max_px, 1.0);
        EXPECT_EQ(ring.nearest_mean_px, 1.0);
        EXPECT_EQ(ring.regularity, std::numeric_limits<double>::infinity());
    }
    EXPECT_EQ(full[0].pixels, 193U);  // lattice points with x^2 + y^2 < 64, by Gauss
    EXPECT_EQ(full[0].pixels + full[1].pixels, 65U * 65U);

    const auto quincunx = spacing_rings(lattice(65, [](int x, int y) { return (x + y) % 2 == 0; }), edges);
    EXPECT_NEAR(quincunx[1].nearest_median_px, std::sqrt(2.0), 1e-6);
    EXPECT_EQ(quincunx[1].nearest_deviation_px, 0.0);
    EXPECT_EQ(quincunx[0].sites + quincunx[1].sites, 33U * 33U + 32U * 32U);
}

TEST(MeshSpacing, RingsLieWhereTheySay) {
    const SampleMesh mesh = lattice(65, [](int, int) { return true; });  // gaze at (32, 32)
    const std::array<double, 3> edges = {5.0, 6.0, 7.0};
    const auto rings = spacing_rings(mesh, edges);
    ASSERT_EQ(rings.size(), 2U);
    EXPECT_EQ(rings[1].inner_px, 6.0);
    EXPECT_EQ(rings[1].outer_px, 7.0);
    EXPECT_EQ(rings[0].pixels, 109U - 69U);  // x^2 + y^2 < 36, less those < 25: the inner edge belongs to the ring
    EXPECT_TRUE(spacing_rings(mesh, {}).empty());
    EXPECT_TRUE(spacing_rings(mesh, std::array{4.0}).empty());
    const auto empty = spacing_rings(mesh, std::array{100.0, 200.0});
    EXPECT_EQ(empty[0].sites, 0U);
    EXPECT_EQ(empty[0].nearest_mean_px, 0.0);
}

TEST(MeshSpacing, NearestNeighboursAreThoseOfAllPairs) {
    std::mt19937 random(20261122);
    const auto site = scattered_sites(90, 70, 0.1, random);
    std::vector<double> nearest;
    double sum = 0.0;
    double squares = 0.0;
    for (const SamplePosition& a : site) {
        double least = 1e9;
        for (const SamplePosition& b : site)
            if (&a != &b) least = std::min(least, std::hypot(a.x_px - b.x_px, a.y_px - b.y_px));
        nearest.push_back(least);
        sum += least;
        squares += least * least;
    }
    std::sort(nearest.begin(), nearest.end());
    const auto n = static_cast<double>(nearest.size());
    const SpacingRing ring = spacing_rings(triangulated(90, 70, site), std::array{0.0, 1000.0})[0];
    ASSERT_EQ(ring.sites, nearest.size());
    EXPECT_EQ(ring.pixels, 6300U);
    EXPECT_NEAR(ring.nearest_min_px, nearest.front(), 1e-5);
    EXPECT_NEAR(ring.nearest_median_px, nearest[nearest.size() / 2], 1e-5);
    EXPECT_NEAR(ring.nearest_p95_px, nearest[static_cast<std::size_t>(0.95 * n)], 0.3);
    EXPECT_NEAR(ring.nearest_max_px, nearest.back(), 1e-5);
    EXPECT_NEAR(ring.nearest_mean_px, sum / n, 1e-5);
    EXPECT_NEAR(ring.nearest_deviation_px, std::sqrt(squares / n - sum * sum / (n * n)), 1e-4);
}

TEST(MeshSpacing, IndependentSitesAreAsIrregularAsClarkAndEvansSay) {
    std::mt19937 random(20261122);
    const double density = 0.005;
    const SpacingRing ring = spacing_rings(triangulated(1200, 1000, scattered_sites(1200, 1000, density, random)),
                                           std::array{0.0, 450.0})[0];
    EXPECT_NEAR(static_cast<double>(ring.sites) / static_cast<double>(ring.pixels), density, 0.1 * density);
    EXPECT_NEAR(ring.nearest_mean_px, 0.5 / std::sqrt(density), 0.3);
    EXPECT_NEAR(ring.regularity, 1.0 / std::sqrt(4.0 / M_PI - 1.0), 0.1);
}

}  // namespace
}  // namespace macula
