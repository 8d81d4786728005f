// Triangulations against what defines them, in arithmetic of the test's own: circles by their centres in 128 bits,
// cover by area and edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "masks/mesh/triangulate.h"
#include "tests/support/triangulated.h"

namespace macula {
namespace {

using Sites = std::vector<SamplePosition>;
using Triangles = std::vector<SampleMesh::Triangle>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
__extension__ using Int128 = __int128;

constexpr unsigned kSeed = 20261122;
constexpr int kFarthest_px = 16383;

SamplePosition at(int x, int y) {
    return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
}

std::pair<int, int> key(const SamplePosition& s) {
    return {s.x_px, s.y_px};
}

std::int64_t cross(const SamplePosition& a, const SamplePosition& b, const SamplePosition& c) {
    return (std::int64_t{b.x_px} - a.x_px) * (std::int64_t{c.y_px} - a.y_px) -
           (std::int64_t{b.y_px} - a.y_px) * (std::int64_t{c.x_px} - a.x_px);
}

/// The circle through three sites: its centre times 2 * cross, which is whole, relative to the first.
struct Circle {
    SamplePosition a;
    Int128 scale = 0;
    Int128 x = 0;
    Int128 y = 0;

    explicit Circle(const SamplePosition& a_, const SamplePosition& b, const SamplePosition& c)
        : a(a_), scale(2 * cross(a_, b, c)) {
        const Int128 bx = b.x_px - a.x_px;
        const Int128 by = b.y_px - a.y_px;
        const Int128 cx = c.x_px - a.x_px;
        const Int128 cy = c.y_px - a.y_px;
        x = cy * (bx * bx + by * by) - by * (cx * cx + cy * cy);
        y = bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by);
    }
    [[nodiscard]] bool holds(const SamplePosition& s) const {
        const Int128 dx = scale * (s.x_px - a.x_px) - x;
        const Int128 dy = scale * (s.y_px - a.y_px) - y;
        return dx * dx + dy * dy < x * x + y * y;
    }
};

/// Doubled area of the convex hull, and the number of sites on its border, also in the middle of a side.
std::pair<std::int64_t, std::size_t> hull(const Sites& site) {
    std::vector<SamplePosition> sorted;
    std::set<std::pair<int, int>> distinct;
    for (const SamplePosition& s : site)
        if (distinct.insert(key(s)).second) sorted.push_back(s);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return key(a) < key(b); });
    // Andrew's monotone chains; sites in the middle of a side stay.
    const auto chain = [](const auto& from, const auto& to) {
        Sites turn;
        for (auto s = from; s != to; ++s) {
            while (turn.size() >= 2 && cross(turn[turn.size() - 2], turn.back(), *s) < 0) turn.pop_back();
            turn.push_back(*s);
        }
        turn.pop_back();
        return turn;
    };
    Sites border = chain(sorted.begin(), sorted.end());
    const Sites back = chain(sorted.rbegin(), sorted.rend());
    border.insert(border.end(), back.begin(), back.end());
    std::int64_t area = 0;
    for (std::size_t i = 1; i + 1 < border.size(); ++i) area += cross(border[0], border[i], border[i + 1]);
    return {area, border.size()};
}

void expect_delaunay(const Sites& site, const Triangles& triangles, const std::map<Edge, std::uint32_t>& apex) {
    if (site.size() <= 100) {
        for (const SampleMesh::Triangle& t : triangles) {
            const Circle circle(site[t[0]], site[t[1]], site[t[2]]);
            for (const SamplePosition& s : site)
                ASSERT_FALSE(circle.holds(s)) << "site " << s.x_px << ", " << s.y_px << " is in a circle";
        }
    }
    for (const auto& [edge, own] : apex) {  // which is enough (Delaunay 1934)
        const auto beyond = apex.find({edge.second, edge.first});
        if (beyond == apex.end()) continue;
        ASSERT_FALSE(Circle(site[edge.first], site[edge.second], site[own]).holds(site[beyond->second]))
            << "the neighbour's corner is in a circle";
    }
}

/// Everything that triangulate() promises.
void expect_triangulation(const Sites& site) {
    const Triangles triangles = triangulate(site);
    std::map<std::pair<int, int>, std::uint32_t> first;
    for (std::uint32_t i = 0; i < site.size(); ++i) first.emplace(key(site[i]), i);
    const auto [hull_area, border] = hull(site);
    if (hull_area == 0) {
        EXPECT_TRUE(triangles.empty());
        return;
    }
    std::map<Edge, std::uint32_t> apex;  // by directed edge
    std::set<std::uint32_t> corners;
    std::int64_t area = 0;
    for (const SampleMesh::Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            ASSERT_LT(t[k], site.size());
            ASSERT_EQ(first.at(key(site[t[k]])), t[k]) << "only the first of equal sites is a corner";
            ASSERT_TRUE(apex.emplace(Edge(t[k], t[(k + 1) % 3]), t[(k + 2) % 3]).second)
                << "an edge has two triangles on one side";
            corners.insert(t[k]);
        }
        ASSERT_LT(cross(site[t[0]], site[t[1]], site[t[2]]), 0) << "degenerate, or turns the wrong way";
        area -= cross(site[t[0]], site[t[1]], site[t[2]]);
    }
    const auto outer = static_cast<std::size_t>(std::count_if(apex.begin(), apex.end(), [&apex](const auto& side) {
        return !apex.contains({side.first.second, side.first.first});
    }));
    EXPECT_EQ(area, hull_area);
    EXPECT_EQ(outer, border);
    EXPECT_EQ(corners.size(), first.size()) << "every site is a corner";
    EXPECT_EQ(triangles.size(), 2 * first.size() - 2 - border) << "Euler's formula";
    expect_delaunay(site, triangles, apex);
}

Sites rectangle(int width, int height) {
    Sites site;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) site.push_back(at(x, y));
    return site;
}

TEST(Triangulate, NothingToCover) {
    EXPECT_TRUE(triangulate({}).empty());
    EXPECT_TRUE(triangulate({at(3, 4)}).empty());
    EXPECT_TRUE(triangulate({at(3, 4), at(-5, 6)}).empty());
    EXPECT_TRUE(triangulate({at(3, 4), at(3, 4), at(5, 6), at(3, 4), at(5, 6)}).empty());
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {-1, 1}, {7, -3}, {1, 300}}) {
        Sites line;
        for (int i = 0; i < 50; ++i) line.push_back(at(i * 37 % 50 * dx, i * 37 % 50 * dy));
        EXPECT_TRUE(triangulate(line).empty()) << dx << ", " << dy;
    }
}

TEST(Triangulate, OneTriangleInTheRightOrientation) {
    const Sites site = {at(0, 0), at(10, 0), at(0, 10)};
    const Triangles triangles = triangulate(site);
    ASSERT_EQ(triangles.size(), 1U);
    expect_triangulation(site);
    expect_triangulation({at(0, 10), at(10, 0), at(0, 0)});
    expect_triangulation({at(-kFarthest_px, -kFarthest_px), at(kFarthest_px, kFarthest_px),
                          at(kFarthest_px - 1, kFarthest_px), at(-kFarthest_px, kFarthest_px)});
}

TEST(Triangulate, FullGrid) {
    expect_triangulation(rectangle(2, 2));
    expect_triangulation(rectangle(2, 9));
    expect_triangulation(rectangle(61, 47));
}

TEST(Triangulate, DuplicatesCountOnce) {
    Sites site = rectangle(9, 7);
    const Triangles once = triangulate(site);
    std::mt19937 random(kSeed);
    for (int i = 0; i < 100; ++i) site.push_back(site[random() % site.size()]);
    expect_triangulation(site);
    EXPECT_EQ(triangulate(site), once);
}

TEST(Triangulate, SmallSetsOfEveryDensity) {
    std::mt19937 random(kSeed);
    RecordProperty("seed", static_cast<int>(kSeed));
    for (const int side : {3, 5, 9, 20, 100, 1000, 2 * kFarthest_px + 1}) {
        for (int set = 0; set < 300; ++set) {
            Sites site(3 + random() % 30);
            for (SamplePosition& s : site)
                s = at(static_cast<int>(random() % side) - side / 2, static_cast<int>(random() % side) - side / 2);
            SCOPED_TRACE("side " + std::to_string(side) + ", set " + std::to_string(set) + ", seed " +
                         std::to_string(kSeed));
            expect_triangulation(site);
            if (HasFatalFailure()) return;
        }
    }
}

TEST(Triangulate, AlmostCollinearSites) {
    std::mt19937 random(kSeed);
    for (int set = 0; set < 500; ++set) {
        const double angle = 2.0 * M_PI * set / 500.0;
        const int width = 1 + static_cast<int>(random() % 4);
        Sites site(3 + random() % 20);
        for (SamplePosition& s : site) {
            const double along = static_cast<double>(random() % 32001) - 16000.0;
            s = at(static_cast<int>(along * std::cos(angle)) + static_cast<int>(random() % width),
                   static_cast<int>(along * std::sin(angle)) + static_cast<int>(random() % width));
        }
        SCOPED_TRACE("set " + std::to_string(set) + ", seed " + std::to_string(kSeed));
        expect_triangulation(site);
        if (HasFatalFailure()) return;
    }
}

/// All whole points on a circle around the origin.
Sites circle(int squared_radius) {
    Sites site;
    const int radius = static_cast<int>(std::sqrt(squared_radius)) + 1;
    for (int x = -radius; x <= radius; ++x) {
        const int y = static_cast<int>(std::lround(std::sqrt(std::max(0, squared_radius - x * x))));
        if (x * x + y * y != squared_radius) continue;
        site.push_back(at(x, y));
        if (y != 0) site.push_back(at(x, -y));
    }
    return site;
}

TEST(Triangulate, CocircularSites) {
    const Sites on_circle = circle(5 * 5 * 13 * 13 * 17 * 17);
    ASSERT_EQ(on_circle.size(), 108U);  // 4 (2 + 1)^3, by Jacobi's two-square theorem
    expect_triangulation(on_circle);
    Sites with_centre = on_circle;
    with_centre.push_back(at(0, 0));
    expect_triangulation(with_centre);
    Sites rings = with_centre;
    for (const int squared : {5 * 5 * 13 * 13, 5 * 13 * 17, 325 * 325, 16 * 5 * 5 * 13 * 13})
        for (const SamplePosition& s : circle(squared)) rings.push_back(s);
    expect_triangulation(rings);
    Sites half;
    for (const SamplePosition& s : on_circle)
        if (s.x_px + 2 * s.y_px > 0) half.push_back(s);
    expect_triangulation(half);
}

TEST(Triangulate, AlmostCocircularSites) {
    std::mt19937 random(kSeed);
    for (const int radius : {50, 700, kFarthest_px}) {
        Sites site;
        for (int i = 0; i < 400; ++i) {
            const double angle = 2.0 * M_PI * static_cast<double>(random()) / 4294967296.0;
            site.push_back(at(static_cast<int>(std::lround(radius * std::cos(angle))),
                              static_cast<int>(std::lround(radius * std::sin(angle)))));
        }
        expect_triangulation(site);
    }
}

TEST(Triangulate, NestedQuincunxLattices) {
    Sites site;  // every pixel in the middle, then every second, fourth and eighth
    for (int y = -48; y <= 48; ++y) {
        for (int x = -48; x <= 48; ++x) {
            const int distance = std::max(std::abs(x), std::abs(y));
            const bool taken = distance < 12 || (distance < 24 && (x + y) % 2 == 0) ||
                               (distance < 36 && x % 2 == 0 && y % 2 == 0) ||
                               (x % 2 == 0 && y % 2 == 0 && (x + y) % 4 == 0);
            if (taken) site.push_back(at(x, y));
        }
    }
    expect_triangulation(site);
}

TEST(Triangulate, ClustersFarApartLeaveHoles) {
    std::mt19937 random(kSeed);
    for (int set = 0; set < 20; ++set) {
        Sites site;
        for (int cluster = 0; cluster < 6; ++cluster) {
            const int x = static_cast<int>(random() % 32700) - 16350;
            const int y = static_cast<int>(random() % 32700) - 16350;
            for (int i = 0; i < 40; ++i)
                site.push_back(at(x + static_cast<int>(random() % 9), y + static_cast<int>(random() % 9)));
        }
        SCOPED_TRACE("set " + std::to_string(set) + ", seed " + std::to_string(kSeed));
        expect_triangulation(site);
    }
    Sites frame;  // a full grid with a hole of cocircular sites
    for (const SamplePosition& s : rectangle(60, 60))
        if (s.x_px < 5 || s.x_px > 54 || s.y_px < 5 || s.y_px > 54) frame.push_back(s);
    expect_triangulation(frame);
}

TEST(Triangulate, MaskWithFullFovea) {
    std::mt19937 random(kSeed);
    Sites site;
    for (int y = 0; y < 150; ++y) {
        for (int x = 0; x < 160; ++x) {
            const double distance = std::hypot(x - 80, y - 75);
            const bool corner = (x == 0 || x == 159) && (y == 0 || y == 149);
            if (corner || distance < 30.0 ||
                static_cast<double>(random()) / 4294967296.0 < 900.0 / (distance * distance))
                site.push_back(at(x, y));
        }
    }
    expect_triangulation(site);
    EXPECT_EQ(mesh_defect(testing::triangulated(160, 150, site)), "");
}

TEST(Triangulate, DoesNotDependOnTheOrderOfTheSites) {
    const auto places = [](const Sites& site) {
        std::set<std::set<std::pair<int, int>>> set;
        for (const SampleMesh::Triangle& t : triangulate(site))
            set.insert({key(site[t[0]]), key(site[t[1]]), key(site[t[2]])});
        return set;
    };
    std::mt19937 random(kSeed);
    Sites site = testing::scattered_sites(60, 50, 0.4, random);
    const auto before = places(site);
    std::shuffle(site.begin(), site.end(), random);
    EXPECT_EQ(places(site), before);
}

}  // namespace
}  // namespace macula
