// Push-pull, cells and nearest by GL compute programs against C++.

#include <gtest/gtest.h>

#include <string>

#include "protocol/gl/context.h"
#include "tests/support/scattered_cases.h"

namespace macula {
namespace {

using test::Case;
using test::Picture;

// Colour is integers all along. Inverse depth is computed as it is written on both sides, but GLSL's division may be
// wrong in the last bits.
constexpr float kDepthTolerance = 4e-7F;

std::string compare(const Picture& expected, const Picture& result) {
    for (int y = 0; y < expected.color.height_px; ++y)
        for (int x = 0; x < expected.color.width_px; ++x) {
            const float depth = expected.inverse_depth.at(x, y);
            if (expected.color.at(x, y) != result.color.at(x, y) ||
                !(std::abs(result.inverse_depth.at(x, y) - depth) <= kDepthTolerance * depth))
                return "pixel " + std::to_string(x) + ", " + std::to_string(y) + ": " +
                       std::to_string(expected.color.at(x, y)) + " at inverse depth " + std::to_string(depth) +
                       " against " + std::to_string(result.color.at(x, y)) + " at " +
                       std::to_string(result.inverse_depth.at(x, y));
        }
    return {};
}

std::string check_cases(Reconstruction kind, ContextKind context_kind, std::uint32_t seeds) {
    auto context = make_gl_context(context_kind);
    if (!context) return context.error().message;
    auto gl = make_gl_scattered_reconstructor(kind, std::move(*context));
    if (!gl) return gl.error().message;
    const auto cpu = make_cpu_scattered_reconstructor(kind);
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        Case random = seed % 4 == 0 ? test::mesh_case(seed, {93, 60}, 0.02 * seed) : test::random_case(seed);
        if (seed % 2 == 0) test::hide(random.plan, [](int x, int y) { return x + y < 20 || x * y % 5 == 0; });
        const Picture expected = test::reconstruct(*cpu, random.plan, random.samples);
        const Picture result = test::reconstruct(**gl, random.plan, random.samples);
        if (const std::string wrong = compare(expected, result); !wrong.empty())
            return to_string(kind) + ", seed " + std::to_string(seed) + ", " + wrong + ": " +
                   test::write_three_pictures(to_string(kind) + "-seed-" + std::to_string(seed), expected.color,
                                              result.color);
    }
    return {};
}

TEST(ScatteredGl, EqualsCppOnEglSurfaceless) {
    for (const Reconstruction kind : test::kScattered) EXPECT_EQ(check_cases(kind, ContextKind::surfaceless, 24), "");
}

TEST(ScatteredGl, EqualsCppOnOsMesa) {
    for (const Reconstruction kind : test::kScattered) EXPECT_EQ(check_cases(kind, ContextKind::osmesa, 4), "");
}

TEST(ScatteredGl, EqualsCppOnTheBestContextHere) {
    for (const Reconstruction kind : test::kScattered) EXPECT_EQ(check_cases(kind, ContextKind::automatic, 4), "");
}

TEST(ScatteredGl, RefusesPlansWithoutSamplesAtPixelCentres) {
    auto context = make_gl_context(ContextKind::automatic);
    ASSERT_TRUE(context) << context.error().message;
    const auto gl = make_gl_scattered_reconstructor(Reconstruction::cells, std::move(*context));
    ASSERT_TRUE(gl) << gl.error().message;
    EXPECT_EQ((*gl)->reconstruct({}, {}, {}).error().code, ErrorCode::option);
}

}  // namespace
}  // namespace macula
