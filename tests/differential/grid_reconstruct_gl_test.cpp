// Reconstruction of grid plans by the GL compute program against the kernel as C++.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "protocol/gl/context.h"
#include "server/render/grid_reconstructors.h"
#include "tests/support/grid_cases.h"
#include "tests/support/reconstruct_cases.h"

namespace macula {
namespace {

using test::Picture;

int channel_difference(Rgba8 a, Rgba8 b) {
    int largest = 0;
    for (unsigned shift = 0; shift < 32; shift += 8)
        largest =
            std::max(largest, std::abs(static_cast<int>(a >> shift & 255U) - static_cast<int>(b >> shift & 255U)));
    return largest;
}

/// Random colours and surfaces, and a sample in sixteen untraced or none; of a log-polar plan one surface, because
/// there a weight that rounds the other way may choose the other one of two.
Samples random_samples(const SamplePlan& plan, std::mt19937& random) {
    std::uniform_real_distribution<float> depth(0.01F, 4.0F);
    const bool surfaces = !plan.grids.rectangular.empty();
    Samples samples = test::trace_picture(
        plan, [&](double, double) { return static_cast<Rgba8>(random()) | 0xFF000000U; },
        [&](double x, double y) {
            if (!surfaces) return static_cast<float>(1.0 + 0.0005 * x + 0.0003 * y);
            return random() % 9 == 0 ? 0.0F : random() % 2 == 0 ? 1.0F + 0.05F * depth(random) : depth(random);
        });
    if (surfaces && random() % 2 == 0)
        for (float& inverse_depth : samples.inverse_depth_per_m)
            if (random() % 16 == 0) inverse_depth = -1.0F;
    return samples;
}

void expect_gl_equals_cpp(ContextKind kind, std::uint32_t first_seed) {
    auto context = make_gl_context(kind);
    ASSERT_TRUE(context) << context.error().message;
    auto gl = make_gl_grid_reconstructor(std::move(*context));
    ASSERT_TRUE(gl) << gl.error().message;
    const auto cpp = make_cpu_grid_reconstructor();
    const Display display = test::small_display();
    for (const std::string& name : test::grid_samplers())
        for (const double share : {0.5, 0.12, 1.0}) {
            if (name == "log-polar" && share == 1.0) continue;
            const auto sampler = test::make_grid_sampler(name, display, share);
            SamplePlan plan;
            for (std::uint32_t seed = first_seed; seed < first_seed + 6; ++seed) {
                SCOPED_TRACE(name + " " + std::to_string(share) + " seed " + std::to_string(seed));
                std::mt19937 random(seed);
                sampler->plan(test::random_request(random), plan);
                const Samples samples = random_samples(plan, random);
                const Picture expected = test::reconstruct(*cpp, plan, samples);
                const Picture result = test::reconstruct(**gl, plan, samples);
                if (name != "log-polar") {
                    EXPECT_EQ(result.color.texels, expected.color.texels);
                    EXPECT_EQ(result.inverse_depth.texels, expected.inverse_depth.texels);
                }
                for (std::size_t i = 0; i < expected.color.texels.size(); ++i) {
                    ASSERT_LE(channel_difference(expected.color.texels[i], result.color.texels[i]), 1) << "pixel " << i;
                    ASSERT_NEAR(expected.inverse_depth.texels[i], result.inverse_depth.texels[i], 1e-4)
                        << "pixel " << i;
                }
                if (testing::Test::HasFailure()) return;
            }
        }
}

TEST(GridReconstructGl, EqualsCppOnEglSurfaceless) {
    expect_gl_equals_cpp(ContextKind::surfaceless, 1);
}

TEST(GridReconstructGl, EqualsCppOnOsMesa) {
    expect_gl_equals_cpp(ContextKind::osmesa, 100);
}

}  // namespace
}  // namespace macula
