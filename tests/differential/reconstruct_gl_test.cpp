// Reconstruction by the GL compute program against the reference, on every kind of context.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "protocol/gl/context.h"
#include "tests/support/reconstruct_cases.h"

namespace macula {
namespace {

using test::Case;
using test::Picture;

// Colours are integers from samples to pixels, so that a difference of 1 is already more than expected. Inverse depth
// differs by roundings: GL may fuse products and sums.
constexpr int kColorTolerance = 1;
constexpr float kDepthTolerance = 4e-7F;  // of the largest inverse depth in the case, 4.4 per metre

int channel_difference(Rgba8 a, Rgba8 b) {
    int largest = 0;
    for (unsigned shift = 0; shift < 32; shift += 8)
        largest =
            std::max(largest, std::abs(static_cast<int>(a >> shift & 255U) - static_cast<int>(b >> shift & 255U)));
    return largest;
}

/// Empty if the pictures agree; else where they do not.
std::string compare(const Picture& reference, const Picture& result) {
    for (int y = 0; y < reference.color.height_px; ++y)
        for (int x = 0; x < reference.color.width_px; ++x) {
            const float depth = reference.inverse_depth.at(x, y);
            if (channel_difference(reference.color.at(x, y), result.color.at(x, y)) > kColorTolerance ||
                !(std::abs(result.inverse_depth.at(x, y) - depth) <= kDepthTolerance * 4.4F))
                return "pixel " + std::to_string(x) + ", " + std::to_string(y) + ": inverse depth " +
                       std::to_string(depth) + " against " + std::to_string(result.inverse_depth.at(x, y));
        }
    return {};
}

std::string check_seeds(ContextKind kind, std::uint32_t first, std::uint32_t last) {
    auto context = make_gl_context(kind);
    if (!context) return context.error().message;
    auto gl = make_gl_reconstructor(std::move(*context), *test::shared_tables());
    if (!gl) return gl.error().message;
    const auto reference = make_reference_reconstructor(test::shared_tables());
    for (std::uint32_t seed = first; seed <= last; ++seed) {
        const Case random = test::random_case(seed);
        const Picture expected = test::reconstruct(*reference, random.plan, random.samples);
        const Picture result = test::reconstruct(**gl, random.plan, random.samples);
        if (const std::string wrong = compare(expected, result); !wrong.empty())
            return "seed " + std::to_string(seed) + ", " + wrong + ": " +
                   test::write_three_pictures("reconstruct-gl-seed-" + std::to_string(seed), expected.color,
                                              result.color);
    }
    return {};
}

TEST(ReconstructGl, EqualsReferenceOnEglSurfaceless) {
    EXPECT_EQ(check_seeds(ContextKind::surfaceless, 1, 100), "");
}

TEST(ReconstructGl, EqualsReferenceOnOsMesa) {
    EXPECT_EQ(check_seeds(ContextKind::osmesa, 1, 100), "");
}

TEST(ReconstructGl, EqualsReferenceOnTheBestContextHere) {
    EXPECT_EQ(check_seeds(ContextKind::automatic, 101, 120), "");
}

TEST(ReconstructGl, SessionsReconstructAtOnce) {
    std::vector<std::string> wrong(4);
    std::vector<std::thread> sessions;
    for (std::size_t i = 0; i < wrong.size(); ++i)
        sessions.emplace_back([&, i] {
            const auto seed = static_cast<std::uint32_t>(200 + 100 * i);
            wrong[i] = check_seeds(i % 2 == 0 ? ContextKind::surfaceless : ContextKind::osmesa, seed, seed + 20);
        });
    for (std::thread& session : sessions) session.join();
    for (const std::string& text : wrong) EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace macula
