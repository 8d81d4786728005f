// What pixels of a mask interpolate, against a search through all triangles with rational weights.

#include "masks/mesh/mesh_table.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace macula {
namespace {

constexpr unsigned kSeed = 20261122;

using glm::ivec2;

std::int64_t cross(ivec2 a, ivec2 b) {
    return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
}

/// A corner that weighs something at a pixel: weight `part` of `whole`.
struct Corner {
    ivec2 at;
    std::int64_t part;
    std::int64_t whole;
};

/// Corners with weight at a pixel in one triangle, heaviest first, of equal ones the first row by row; none if the
/// pixel lies outside.
std::vector<Corner> corners_at(const SampleMesh& mesh, const SampleMesh::Triangle& triangle, ivec2 pixel) {
    std::array<ivec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = {mesh.site[triangle[i]].x_px, mesh.site[triangle[i]].y_px};
    const std::int64_t whole = -cross(p[1] - p[0], p[2] - p[0]);
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const ivec2 next = p[(i + 1) % 3];
        const std::int64_t part = -cross(next - pixel, p[(i + 2) % 3] - pixel);
        if (part < 0) return {};
        if (part > 0) corners.push_back({p[i], part, whole});
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
        return std::tuple(-a.part, a.at.y, a.at.x) < std::tuple(-b.part, b.at.y, b.at.x);
    });
    return corners;
}

/// Checks every pixel against every triangle.
void expect_right(const MeshTable& table) {
    const SampleMesh& mesh = table.mesh();
    std::vector<double> share(mesh.site.size());
    const auto site_at = [&mesh](ivec2 at) {
        return static_cast<std::size_t>(std::find_if(mesh.site.begin(), mesh.site.end(),
                                                     [at](auto p) { return p.x_px == at.x && p.y_px == at.y; }) -
                                        mesh.site.begin());
    };
    for (int y = 0; y < mesh.height_px; ++y) {
        for (int x = 0; x < mesh.width_px; ++x) {
            const ivec2 pixel(x, y);
            const MeshPixel& entry = table.pixels()[static_cast<std::size_t>(y * mesh.width_px + x)];
            const std::array<ivec2, 3> at = {pixel + ivec2(entry.ax, entry.ay), pixel + ivec2(entry.bx, entry.by),
                                             pixel + ivec2(entry.cx, entry.cy)};
            const std::array<int, 3> weight = {256 - entry.weight_b - entry.weight_c, entry.weight_b, entry.weight_c};
            int containing = 0;
            for (const SampleMesh::Triangle& triangle : mesh.triangle) {
                const std::vector<Corner> corners = corners_at(mesh, triangle, pixel);
                if (corners.empty()) continue;
                ++containing;
                // All triangles around a pixel on an edge give the same corners.
                for (std::size_t i = 0; i < 3; ++i) {
                    if (i >= corners.size()) {
                        ASSERT_EQ(at[i], at[0]) << x << ", " << y;
                        ASSERT_EQ(weight[i], 0);
                        continue;
                    }
                    ASSERT_EQ(at[i], corners[i].at) << x << ", " << y << " corner " << i;
                    const double exact =
                        256.0 * static_cast<double>(corners[i].part) / static_cast<double>(corners[i].whole);
                    ASSERT_NEAR(weight[i], exact, i == 0 ? 1.0 : i == 1 ? 1.5 : 0.5) << x << ", " << y;
                }
            }
            ASSERT_GT(containing, 0);
            ASSERT_TRUE(weight[0] >= weight[1] && weight[1] >= 0 && weight[2] >= 0);
            for (std::size_t i = 0; i < 3; ++i) share[std::min(site_at(at[i]), share.size() - 1)] += weight[i] / 256.0;
        }
    }
    ASSERT_NEAR(std::accumulate(share.begin(), share.end(), 0.0), 1.0 * mesh.width_px * mesh.height_px, 1e-6);
    for (std::size_t i = 0; i < share.size(); ++i) ASSERT_NEAR(table.spacing_px()[i], std::sqrt(share[i]), 1e-5);
}

bool equal(const MeshPixel& a, const MeshPixel& b) {
    const auto all = [](const MeshPixel& p) {
        return std::tuple(p.ax, p.ay, p.bx, p.by, p.cx, p.cy, p.weight_b, p.weight_c);
    };
    return all(a) == all(b);
}

MeshTable table_of(SampleMesh mesh) {
    return MeshTable::make(std::move(mesh)).value();
}

class RandomMesh : public testing::TestWithParam<unsigned> {};

TEST_P(RandomMesh, PixelsInterpolateTheTriangleTheyLieIn) {
    std::mt19937 random(kSeed + GetParam());
    const auto whole = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const int width_px = whole(2, 50);
    const int height_px = whole(2, 40);
    const float density = std::array{0.0F, 0.01F, 0.05F, 0.2F, 0.5F, 0.8F, 1.0F}[GetParam() % 7];
    SampleMesh mesh = test::make_mesh(
        width_px, height_px, {0, 0},
        [&](int, int) { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random) < density; }, whole(1, 60));
    const MeshTable table = table_of(mesh);
    expect_right(table);
    if (HasFatalFailure()) return;

    // Neither the order of triangles nor which corner comes first matters.
    std::shuffle(mesh.triangle.begin(), mesh.triangle.end(), random);
    for (SampleMesh::Triangle& t : mesh.triangle) std::rotate(t.begin(), t.begin() + whole(0, 2), t.end());
    const MeshTable other = table_of(std::move(mesh));
    for (std::size_t i = 0; i < table.pixels().size(); ++i) ASSERT_TRUE(equal(table.pixels()[i], other.pixels()[i]));
    EXPECT_TRUE(std::ranges::equal(table.spacing_px(), other.spacing_px()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMesh, testing::Range(0U, 42U));

/// Squares of `step_px` between sites, each cut along one of its diagonals.
SampleMesh lattice(std::mt19937& random, int columns, int rows, int step_px) {
    SampleMesh mesh;
    mesh.width_px = (columns - 1) * step_px + 1;
    mesh.height_px = (rows - 1) * step_px + 1;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x)
            mesh.site.push_back({static_cast<std::int16_t>(x * step_px), static_cast<std::int16_t>(y * step_px)});
    }
    for (int y = 0; y + 1 < rows; ++y) {
        for (int x = 0; x + 1 < columns; ++x) {
            const auto a = static_cast<std::uint32_t>(y * columns + x);
            const std::uint32_t b = a + 1;
            const std::uint32_t c = a + static_cast<std::uint32_t>(columns);
            const std::uint32_t d = c + 1;
            if (random() % 2 == 0) {
                mesh.triangle.push_back({a, c, b});
                mesh.triangle.push_back({b, c, d});
            } else {
                mesh.triangle.push_back({a, d, b});
                mesh.triangle.push_back({a, c, d});
            }
        }
    }
    return mesh;
}

TEST(MeshTable, WhereAllPixelsAreSitesDiagonalsDoNotMatter) {
    std::mt19937 random(kSeed);
    const MeshTable table = table_of(lattice(random, 23, 17, 1));
    for (const MeshPixel& p : table.pixels()) EXPECT_TRUE(equal(p, MeshPixel{}));
    for (const float spacing_px : table.spacing_px()) EXPECT_EQ(spacing_px, 1.0F);
    for (int y = 0; y < table.blocks().count().y; ++y) {
        for (int x = 0; x < table.blocks().count().x; ++x) EXPECT_EQ(table.blocks().reach_px({x, y}), 0);
    }
}

TEST(MeshTable, LargeTrianglesReachTheirCorners) {
    std::mt19937 random(kSeed);
    const MeshTable table = table_of(lattice(random, 3, 3, 128));
    expect_right(table);
    // Far from the mask's edge a site of a lattice stands for a square, whichever way that is cut.
    const MeshTable fine = table_of(lattice(random, 9, 9, 7));
    double total = 0.0;
    for (const float spacing_px : fine.spacing_px()) total += double{spacing_px} * spacing_px;
    EXPECT_NEAR(total, 57.0 * 57.0, 1e-3);
}

TEST(MeshTable, RefusesTrianglesBeyondReach) {
    std::mt19937 random(kSeed);
    const auto refused = MeshTable::make(lattice(random, 2, 2, 129));
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::input_file);
    EXPECT_NE(refused.error().message.find("more than 127 pixels away"), std::string::npos) << refused.error().message;
    EXPECT_TRUE(MeshTable::make(lattice(random, 2, 2, 128)).has_value());
    EXPECT_FALSE(MeshTable::make(lattice(random, 2, 2, 3000)).has_value());
}

TEST(MeshTable, FarCornersWithoutWeightAreWithinReach) {
    // Pixels on an edge lie between its ends, which are near; the triangles' third corners are as far as can be.
    constexpr int kLast = 16383;
    SampleMesh mesh;
    mesh.width_px = kLast + 1;
    mesh.height_px = 2;
    for (const int y : {0, 1}) {
        for (int x = 0; x < kLast; x += 128)
            mesh.site.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
        mesh.site.push_back({kLast, static_cast<std::int16_t>(y)});
    }
    const auto row = static_cast<std::uint32_t>(mesh.site.size() / 2);
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
        mesh.triangle.push_back({i, 2 * row - 1, i + 1});
        mesh.triangle.push_back({0, row + i, row + i + 1});
    }
    const auto table = MeshTable::make(mesh);
    ASSERT_TRUE(table.has_value()) << table.error().message;
    for (int x = 0; x <= kLast; ++x) {
        for (const int y : {0, 1}) {
            const MeshPixel& p = table->pixels()[static_cast<std::size_t>(y * mesh.width_px + x)];
            const int before = x % 128;
            const int between = std::min(128, kLast - (x - before));
            const bool first_is_nearer = 2 * before <= between;
            EXPECT_EQ(p.ax, before == 0 ? 0 : x == kLast ? 0 : first_is_nearer ? -before : between - before);
            EXPECT_EQ(p.ay, 0);
            EXPECT_EQ(p.weight_c, 0);
            if (before == 0 || x == kLast) continue;
            EXPECT_EQ(p.bx, first_is_nearer ? between - before : -before);
            EXPECT_NEAR(p.weight_b, 256.0 * std::min(before, between - before) / between, 0.5);
        }
    }
}

TEST(MeshTable, NamesAPixelThatNoTriangleCovers) {
    std::mt19937 random(kSeed);
    SampleMesh mesh = lattice(random, 4, 3, 10);
    mesh.triangle.erase(mesh.triangle.begin() + 4, mesh.triangle.begin() + 6);  // the square of (20, 0)
    const auto refused = MeshTable::make(mesh);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::input_file);
    EXPECT_NE(refused.error().message.find("no triangle covers pixel (21, 0)"), std::string::npos)
        << refused.error().message;
    mesh.triangle.clear();
    EXPECT_FALSE(MeshTable::make(mesh).has_value());
}

TEST(MeshTable, BlocksHoldEachSiteOnceInMortonOrder) {
    std::mt19937 random(kSeed);
    SampleMesh made = test::foveal_mesh(random, 75, 50, {40, 20}, 10.0F, 0.05F);
    std::shuffle(made.triangle.begin(), made.triangle.end(), random);
    const MeshTable table = table_of(std::move(made));
    const SampleMesh& mesh = table.mesh();
    const MeshBlocks& blocks = table.blocks();
    ASSERT_EQ(blocks.count(), ivec2(5, 4));
    const auto code = [](int pixel) {
        int c = 0;
        for (int bit = 0; bit < 4; ++bit)
            c |= (pixel >> bit & 1) << 2 * bit | (pixel >> (4 + bit) & 1) << (2 * bit + 1);
        return c;
    };
    std::set<std::tuple<int, int, float>> listed;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) {
            const MeshBlocks::Block block = blocks.block({x, y});
            ASSERT_EQ(block.pixel.size(), blocks.sites({x, y}));
            for (std::size_t i = 0; i < block.pixel.size(); ++i) {
                listed.emplace(16 * x + block.pixel[i] % 16, 16 * y + block.pixel[i] / 16, block.spacing_px[i]);
                if (i == 0) continue;
                ASSERT_LT(code(block.pixel[i - 1]), code(block.pixel[i]));
            }
            int reach_px = 0;
            for (int py = 16 * y; py < std::min(16 * y + 16, 50); ++py) {
                for (int px = 16 * x; px < std::min(16 * x + 16, 75); ++px) {
                    const MeshPixel& p = table.pixels()[static_cast<std::size_t>(py * 75 + px)];
                    for (const int offset : {p.ax, p.ay, p.bx, p.by, p.cx, p.cy})
                        reach_px = std::max(reach_px, std::abs(offset));
                }
            }
            ASSERT_EQ(blocks.reach_px({x, y}), reach_px);
        }
    }
    std::set<std::tuple<int, int, float>> expected;
    for (std::size_t i = 0; i < mesh.site.size(); ++i)
        expected.emplace(mesh.site[i].x_px, mesh.site[i].y_px, table.spacing_px()[i]);
    EXPECT_EQ(listed, expected);
    EXPECT_GT(table.memory_bytes(), table.pixels().size_bytes() + table.spacing_px().size_bytes());
}

}  // namespace
}  // namespace macula
