// Reconstruction of mesh plans by GL, against C++, on every kind of context.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "protocol/gl/context.h"
#include "server/render/mesh_reconstructors.h"
#include "tests/support/mesh_cases.h"

namespace macula {
namespace {

using test::Case;
using test::channel_difference;
using test::Picture;
using test::random_mesh_case;

std::string check_table(ContextKind kind, std::uint32_t first, std::uint32_t last) {
    auto context = make_gl_context(kind);
    if (!context) return context.error().message;
    auto gl = make_gl_table_reconstructor(std::move(*context));
    if (!gl) return gl.error().message;
    const auto reference = make_reference_table_reconstructor();
    for (std::uint32_t seed = first; seed <= last; ++seed) {
        const Case random = random_mesh_case(seed);
        const Picture expected = test::reconstruct(*reference, random.plan, random.samples);
        const Picture result = test::reconstruct(**gl, random.plan, random.samples);
        if (expected.color.texels != result.color.texels ||
            expected.inverse_depth.texels != result.inverse_depth.texels)
            return "seed " + std::to_string(seed) + ": " +
                   test::write_three_pictures("table-gl-seed-" + std::to_string(seed), expected.color, result.color);
    }
    return {};
}

// GL computes a value from its slopes over a triangle, which are rounded, and continues them from the picture's corner:
// some 1e-7 of the largest value, 4.4 per metre, is lost for every pixel of the way, at most 120.
constexpr float kDepthTolerance = 4.4F * 120.0F * 2.4e-7F;

struct Deviation {
    int color = 0;
    float depth = 0.0F;
};

Deviation deviation(const Picture& expected, const Picture& result) {
    Deviation largest;
    for (std::size_t i = 0; i < expected.color.texels.size(); ++i) {
        largest.color = std::max(largest.color, channel_difference(expected.color.texels[i], result.color.texels[i]));
        largest.depth =
            std::max(largest.depth, std::abs(expected.inverse_depth.texels[i] - result.inverse_depth.texels[i]));
    }
    return largest;
}

std::string check_raster(ContextKind kind, std::uint32_t first, std::uint32_t last) {
    auto context = make_gl_context(kind);
    if (!context) return context.error().message;
    auto gl = make_gl_raster_reconstructor(std::move(*context));
    if (!gl) return gl.error().message;
    const auto oracle = make_cpu_raster_reconstructor();
    for (std::uint32_t seed = first; seed <= last; ++seed) {
        const Case random = random_mesh_case(seed);
        const Picture expected = test::reconstruct(*oracle, random.plan, random.samples);
        const Picture result = test::reconstruct(**gl, random.plan, random.samples);
        const Deviation largest = deviation(expected, result);
        if (largest.color > 1 || !(largest.depth <= kDepthTolerance))
            return "seed " + std::to_string(seed) + ", color off by " + std::to_string(largest.color) +
                   ", inverse depth by " + std::to_string(largest.depth) + ": " +
                   test::write_three_pictures("raster-gl-seed-" + std::to_string(seed), expected.color, result.color);
    }
    return {};
}

TEST(MeshReconstructGl, TableEqualsReferenceToTheBitOnEglSurfaceless) {
    EXPECT_EQ(check_table(ContextKind::surfaceless, 1, 60), "");
}
TEST(MeshReconstructGl, TableEqualsReferenceToTheBitOnOsMesa) {
    EXPECT_EQ(check_table(ContextKind::osmesa, 1, 60), "");
}
TEST(MeshReconstructGl, RasterIsWithinOneCodeValueOfTheOracleOnEglSurfaceless) {
    EXPECT_EQ(check_raster(ContextKind::surfaceless, 1, 60), "");
}
TEST(MeshReconstructGl, RasterIsWithinOneCodeValueOfTheOracleOnOsMesa) {
    EXPECT_EQ(check_raster(ContextKind::osmesa, 1, 60), "");
}
TEST(MeshReconstructGl, BothOnTheBestContextHere) {
    EXPECT_EQ(check_table(ContextKind::automatic, 101, 120), "");
    EXPECT_EQ(check_raster(ContextKind::automatic, 101, 120), "");
}

TEST(MeshReconstructGl, SessionsReconstructAtOnce) {
    std::vector<std::string> wrong(4);
    std::vector<std::thread> sessions;
    for (std::size_t i = 0; i < wrong.size(); ++i)
        sessions.emplace_back([&, i] {
            const auto seed = static_cast<std::uint32_t>(200 + 100 * i);
            const ContextKind kind = i % 2 == 0 ? ContextKind::surfaceless : ContextKind::osmesa;
            wrong[i] = i < 2 ? check_table(kind, seed, seed + 10) : check_raster(kind, seed, seed + 10);
        });
    for (std::thread& session : sessions) session.join();
    for (const std::string& text : wrong) EXPECT_EQ(text, "");
}

/// A full mesh of the window's size, whose samples differ as much as samples can.
Case full_case() {
    Case full;
    full.plan = test::whole_mesh_plan(test::make_mesh({111, 83}, [](int, int) { return true; }));
    full.samples = test::sample_picture(
        full.plan, [](int x, int y) { return 0xFF000000U | static_cast<Rgba8>(x * 54321 ^ y * 777); },
        [](int x, int y) { return static_cast<float>((7 * x * x + 3 * y) % 5); });
    return full;
}

TEST(MeshReconstructGl, FullMeshShowsTheColoursToTheBitAndTheDepthsButForTheRoundingOfSlopes) {
    const Case full = full_case();
    const Picture expected = test::reconstruct(*make_reference_table_reconstructor(), full.plan, full.samples);
    for (const ContextKind kind : {ContextKind::surfaceless, ContextKind::osmesa}) {
        auto raster = make_gl_raster_reconstructor(make_gl_context(kind).value());
        ASSERT_TRUE(raster) << raster.error().message;
        const Picture result = test::reconstruct(**raster, full.plan, full.samples);
        EXPECT_EQ(expected.color.texels, result.color.texels);
        EXPECT_LE(deviation(expected, result).depth, kDepthTolerance);
        RecordProperty("largest_depth_deviation", std::to_string(deviation(expected, result).depth));
    }
}

TEST(MeshReconstructGl, MeshesMayAlternate) {
    std::vector<Case> cases;
    for (std::uint32_t seed = 500; seed < 503; ++seed) cases.push_back(random_mesh_case(seed));
    const auto table_oracle = make_reference_table_reconstructor();
    const auto raster_oracle = make_cpu_raster_reconstructor();
    auto table = make_gl_table_reconstructor(make_gl_context(ContextKind::surfaceless).value());
    auto raster = make_gl_raster_reconstructor(make_gl_context(ContextKind::surfaceless).value());
    ASSERT_TRUE(table) << table.error().message;
    ASSERT_TRUE(raster) << raster.error().message;
    for (const std::size_t i : {0U, 1U, 0U, 1U, 2U, 0U, 2U, 1U}) {
        const auto& [plan, samples] = cases[i];
        EXPECT_EQ(test::reconstruct(*table_oracle, plan, samples).color.texels,
                  test::reconstruct(**table, plan, samples).color.texels);
        EXPECT_LE(
            deviation(test::reconstruct(*raster_oracle, plan, samples), test::reconstruct(**raster, plan, samples))
                .color,
            1);
    }
}

TEST(MeshReconstructGl, PlanWithoutAMeshIsRefused) {
    SamplePlan plan;
    plan.width_px = plan.height_px = 1;
    plan.position.resize(1);
    Rgba8 color = 0;
    float depth = 0.0F;
    for (const auto make : {make_gl_table_reconstructor, make_gl_raster_reconstructor}) {
        auto made = make(make_gl_context(ContextKind::surfaceless).value());
        ASSERT_TRUE(made) << made.error().message;
        const auto refused = (*made)->reconstruct(plan, {}, {&color, 1, &depth, 1});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::option);
    }
}

}  // namespace
}  // namespace macula
