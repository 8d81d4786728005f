#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "masks/mesh/delaunay_flip.h"
#include "tests/support/triangulated.h"

namespace macula {
namespace {

constexpr unsigned kSeed = 20261122;

LinkedTriangles linked(std::vector<SampleMesh::Triangle> triangles) {
    LinkedTriangles mesh;
    mesh.triangle = std::move(triangles);
    mesh.twin.assign(3 * mesh.triangle.size(), LinkedTriangles::kNone);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> side_of;
    for (std::uint32_t side = 0; side < mesh.twin.size(); ++side) side_of[{mesh.start(side), mesh.end(side)}] = side;
    for (const auto& [edge, side] : side_of) {
        const auto beyond = side_of.find({edge.second, edge.first});
        if (beyond != side_of.end()) mesh.twin[side] = beyond->second;
    }
    return mesh;
}

int cross(const SamplePosition& a, const SamplePosition& b, const SamplePosition& c) {
    return (b.x_px - a.x_px) * (c.y_px - a.y_px) - (b.y_px - a.y_px) * (c.x_px - a.x_px);
}

/// Turns a side wherever the quadrilateral around it is convex.
std::size_t scramble(LinkedTriangles& mesh, const std::vector<SamplePosition>& site, std::size_t tries,
                     std::mt19937& random) {
    std::size_t turned = 0;
    for (std::size_t i = 0; i < tries; ++i) {
        const auto side = static_cast<std::uint32_t>(random() % mesh.twin.size());
        const std::uint32_t other = mesh.twin[side];
        if (other == LinkedTriangles::kNone) continue;
        const SamplePosition a = site[mesh.apex(side)];
        const SamplePosition b = site[mesh.apex(other)];
        if (cross(a, site[mesh.start(side)], b) >= 0 || cross(b, site[mesh.end(side)], a) >= 0) continue;
        flip(mesh, side);
        ++turned;
    }
    return turned;
}

std::vector<SampleMesh::Triangle> canonical(std::vector<SampleMesh::Triangle> triangles) {
    for (SampleMesh::Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

void expect_links(const LinkedTriangles& mesh) {
    EXPECT_EQ(mesh.twin, linked(mesh.triangle).twin);
}

TEST(DelaunayFlip, FindsTheOneTriangulationAgain) {
    std::mt19937 random(kSeed);
    RecordProperty("seed", static_cast<int>(kSeed));
    for (int set = 0; set < 20; ++set) {
        std::vector<SamplePosition> site(400);  // no four are cocircular at that scale
        for (SamplePosition& s : site)
            s = {static_cast<std::int16_t>(static_cast<int>(random() % 32767) - 16383),
                 static_cast<std::int16_t>(static_cast<int>(random() % 32767) - 16383)};
        const auto delaunay = triangulate(site);
        LinkedTriangles mesh = linked(delaunay);
        EXPECT_EQ(make_delaunay(mesh, site), 0U);
        ASSERT_GT(scramble(mesh, site, 4000, random), 500U);
        expect_links(mesh);
        ASSERT_NE(canonical(mesh.triangle), canonical(delaunay));
        EXPECT_GT(make_delaunay(mesh, site), 300U);
        expect_links(mesh);
        EXPECT_EQ(canonical(mesh.triangle), canonical(delaunay));
    }
}

TEST(DelaunayFlip, ComesToAnEndOnCocircularSites) {
    std::mt19937 random(kSeed);
    SampleMesh full = testing::triangulated(40, 30, testing::scattered_sites(40, 30, 1.0, random));
    LinkedTriangles mesh = linked(full.triangle);
    scramble(mesh, full.site, 20'000, random);
    EXPECT_GT(make_delaunay(mesh, full.site), 100U);
    expect_links(mesh);
    for (const SampleMesh::Triangle& t : mesh.triangle)
        EXPECT_EQ(cross(full.site[t[0]], full.site[t[1]], full.site[t[2]]), -1) << "half of a pixel's square";
    full.triangle = mesh.triangle;
    EXPECT_EQ(mesh_defect(full), "");
}

}  // namespace
}  // namespace macula
