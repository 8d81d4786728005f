// Reconstruction of grid plans on the CPU: against the rule in other words and closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>

#include "server/render/grid_reconstructors.h"
#include "tests/support/grid_cases.h"
#include "tests/support/reconstruct_cases.h"

namespace macula {
namespace {

using test::grid_samplers;
using test::is_visible;
using test::make_grid_sampler;
using test::Picture;

Picture reconstruct(const SamplePlan& plan, const Samples& samples) {
    return test::reconstruct(*make_cpu_grid_reconstructor(), plan, samples);
}

int channel(Rgba8 color, int shift) {
    return static_cast<int>(color >> shift & 255U);
}

TEST(GridReconstruct, FullShowsEachPixelItsOwnSample) {
    const Display display = test::small_display();
    for (const std::string name : {"uniform", "layers"}) {
        SamplePlan plan;
        std::mt19937 random(3);
        make_grid_sampler(name, display, 1.0)->plan(test::random_request(random), plan);
        std::uniform_real_distribution<float> depth(0.0F, 4.0F);
        ColorImage colors(plan.width_px, plan.height_px, 0xFF000000U);
        InverseDepthImage depths(plan.width_px, plan.height_px);
        const Samples samples = test::trace_picture(
            plan,
            [&](double x, double y) {
                return colors.at(static_cast<int>(x), static_cast<int>(y)) = static_cast<Rgba8>(random()) | 0xFF000000U;
            },
            [&](double x, double y) { return depths.at(static_cast<int>(x), static_cast<int>(y)) = depth(random); });
        const Picture picture = reconstruct(plan, samples);
        EXPECT_EQ(picture.color.texels, colors.texels) << name;
        EXPECT_EQ(picture.inverse_depth.texels, depths.texels) << name;
    }
}

// A pixel lies between samples whose places and weights are rounded to 1/256, of a pixel and of their distance.
TEST(GridReconstruct, RampsAreReproduced) {
    const Display display = test::small_display();
    const double red = 0.9;
    const double green = -0.6;
    for (const std::string& name : grid_samplers()) {
        const auto sampler = make_grid_sampler(name, display, 0.3);
        SamplePlan plan;
        for (std::uint32_t seed = 1; seed <= 12; ++seed) {
            SCOPED_TRACE(name + " seed " + std::to_string(seed));
            std::mt19937 random(seed);
            sampler->plan(test::random_request(random), plan);
            const auto ramp = [&](double x, double y) {
                const auto byte = [](double value) {
                    return static_cast<Rgba8>(std::lround(std::clamp(value, 0.0, 255.0)));
                };
                return byte(50.0 + red * x) | byte(200.0 + green * y) << 8U | 0xFF000000U;
            };
            const auto depth = [](double x, double y) { return static_cast<float>(2.0 + 0.001 * x - 0.0008 * y); };
            const Picture picture = reconstruct(plan, test::trace_picture(plan, ramp, depth));
            for (int y = 0; y < plan.height_px; ++y)
                for (int x = 0; x < plan.width_px; ++x) {
                    if (!is_visible(plan, x, y)) {
                        ASSERT_EQ(picture.color.at(x, y), 0xFF000000U);
                        ASSERT_EQ(picture.inverse_depth.at(x, y), 0.0F);
                        continue;
                    }
                    // How far the mean place of the samples may be from the pixel's centre, beside rounding. On a
                    // circle it is nearer to the gaze; between the innermost ones circles are unevenly spaced.
                    double away_px = 0.03;
                    if (plan.grids.rectangular.empty()) {
                        const LogPolarGrid& grid = plan.grids.log_polar;
                        const double radius = glm::distance(glm::dvec2(x + 0.5, y + 0.5), glm::dvec2(grid.centre_px));
                        const double half_angle = std::numbers::pi / grid.count.y;
                        away_px += radius * (1.0 - std::cos(half_angle)) + (radius < 12.0 ? 1.2 : 0.15);
                    }
                    const double x_px = x + 0.5;
                    const double y_px = y + 0.5;
                    ASSERT_NEAR(channel(picture.color.at(x, y), 0), 50.0 + red * x_px, 1.0 + red * away_px);
                    ASSERT_NEAR(channel(picture.color.at(x, y), 8), 200.0 + green * y_px, 1.0 - green * away_px);
                    ASSERT_NEAR(picture.inverse_depth.at(x, y), depth(x_px, y_px), 0.0018 * away_px + 1e-6);
                }
        }
    }
}

/// Weighted mean of up to four samples, those left out that have no depth.
struct Mean {
    std::array<double, 3> color = {};
    double weight = 0.0;

    void add(double part, Rgba8 sample) {
        for (int c = 0; c < 3; ++c) color[static_cast<std::size_t>(c)] += part * channel(sample, 8 * c);
        weight += part;
    }
};

// By places: four neighbours on each lattice, and the fade by the distance to the edge of what the grid shows.
TEST(GridReconstruct, LayersAreInterpolatedAndFadeByPlaces) {
    const Display display = test::small_display();
    LayerSampler sampler(display, kLeftEye, 0.4);
    SamplePlan plan;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 random(seed);
        sampler.plan(test::random_request(random), plan);
        Samples samples = test::trace_picture(
            plan, [&](double, double) { return static_cast<Rgba8>(random()) | 0xFF000000U; },
            [](double, double) { return 1.0F; });
        for (float& depth : samples.inverse_depth_per_m)
            if (random() % 8 == 0) depth = -1.0F;
        const Picture picture = reconstruct(plan, samples);
        for (int y = 0; y < plan.height_px; ++y)
            for (int x = 0; x < plan.width_px; ++x) {
                if (!is_visible(plan, x, y)) continue;
                std::array<double, 3> expected = {};
                double left = 1.0;
                double least_weight = 1.0;
                for (const RectangularGrid& grid : plan.grids.rectangular) {
                    const double shown = std::min(GridPlace::unpacked(grid.columns[static_cast<std::size_t>(x)]).shown,
                                                  GridPlace::unpacked(grid.rows[static_cast<std::size_t>(y)]).shown) /
                                         256.0;
                    if (shown == 0.0) continue;
                    const double u = (x + 0.5 - double{grid.first_px.x}) / grid.step_px.x;
                    const double v = (y + 0.5 - double{grid.first_px.y}) / grid.step_px.y;
                    Mean mean;
                    for (int j = 0; j < 2; ++j)
                        for (int i = 0; i < 2; ++i) {
                            const int column = static_cast<int>(std::floor(u)) + i;
                            const int row = static_cast<int>(std::floor(v)) + j;
                            const double part = (1.0 - std::abs(u - column)) * (1.0 - std::abs(v - row));
                            if (part < 1e-3) continue;
                            const auto address = grid.offset + static_cast<std::size_t>(row * grid.count.x + column);
                            if (samples.inverse_depth_per_m.at(address) >= 0.0F) mean.add(part, samples.color[address]);
                        }
                    least_weight = std::min(least_weight, mean.weight);
                    for (std::size_t c = 0; c < 3; ++c) expected[c] += left * shown * mean.color[c] / mean.weight;
                    left *= 1.0 - shown;
                }
                if (least_weight < 0.1) continue;  // little is left where so much is untraced, but rounding
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(channel(picture.color.at(x, y), 8 * static_cast<int>(c)), expected[c],
                                1.0 + 1.0 / least_weight)
                        << "pixel " << x << ", " << y;
            }
    }
}

/// A plan of 2x2 samples 4 pixels apart around a window of 4x4 pixels.
SamplePlan four_samples() {
    SamplePlan plan;
    plan.width_px = 4;
    plan.height_px = 4;
    plan.position.resize(4);
    RectangularGrid grid;
    grid.first_px = {0.0F, 0.0F};
    grid.step_px = {4.0F, 4.0F};
    grid.count = {2, 2};
    for (std::uint32_t i = 0; i < 4; ++i) grid.columns.push_back(GridPlace{0, 256, 32 + 64 * i}.packed());
    grid.rows = grid.columns;
    plan.grids.rectangular.push_back(grid);
    return plan;
}

TEST(GridReconstruct, FourSamplesAreWeighedByDistance) {
    Samples samples;
    samples.color = {0xFF000000U, 0xFF0000FFU, 0xFF00FF00U, 0xFFFF0000U};
    samples.inverse_depth_per_m = {1.0F, 1.1F, 1.2F, 1.16F};
    const Picture picture = reconstruct(four_samples(), samples);
    // Pixel (2, 0): 5/8 to the right, 1/8 down.
    EXPECT_EQ(picture.color.at(2, 0), 0xFF000000U | 139U | 12U << 8U | 20U << 16U);
    EXPECT_NEAR(picture.inverse_depth.at(2, 0), (21.0 + 35.0 * 1.1 + 3.0 * 1.2 + 5.0 * 1.16) / 64.0, 1e-6);
}

TEST(GridReconstruct, UntracedSamplesAreLeftOutAndTheOthersScaled) {
    Samples samples;
    samples.color = {0xFF000000U, 0xFF0000FFU, 0xFF00FF00U, 0xFFFF0000U};
    samples.inverse_depth_per_m = {1.0F, -1.0F, 1.2F, 1.16F};
    const Picture picture = reconstruct(four_samples(), samples);
    EXPECT_EQ(picture.color.at(2, 0), 0xFF000000U | 26U << 8U | 44U << 16U);  // 3/29 and 5/29 of 255
    EXPECT_NEAR(picture.inverse_depth.at(2, 0), (21.0 + 3.0 * 1.2 + 5.0 * 1.16) / 29.0, 1e-5);
    samples.inverse_depth_per_m = {-1.0F, -1.0F, -1.0F, -1.0F};
    const Picture nothing = reconstruct(four_samples(), samples);
    EXPECT_EQ(nothing.color.at(2, 0), 0xFF000000U);
    EXPECT_EQ(nothing.inverse_depth.at(2, 0), 0.0F);
}

TEST(GridReconstruct, DepthIsNotInterpolatedBetweenSurfaces) {
    Samples samples;
    samples.color.assign(4, 0xFF000000U);
    samples.inverse_depth_per_m = {1.0F, 2.0F, 1.0F, 0.0F};
    const Picture picture = reconstruct(four_samples(), samples);
    EXPECT_EQ(picture.inverse_depth.at(0, 0), 1.0F);
    EXPECT_EQ(picture.inverse_depth.at(3, 0), 2.0F);
    EXPECT_EQ(picture.inverse_depth.at(3, 3), 0.0F);
}

TEST(GridReconstruct, OtherPlansAreRefused) {
    SamplePlan plan = four_samples();
    plan.grids.rectangular.clear();
    Samples samples;
    const auto done = make_cpu_grid_reconstructor()->reconstruct(plan, samples, {});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::option);
}

/// PSNR of red inside and outside of 5 degrees around the gaze.
struct Quality {
    double inside_db = 0.0;
    double outside_db = 0.0;
};

Quality quality_of(const std::string& name, const Display& display) {
    PlanRequest request;
    request.gaze_eye = glm::normalize(glm::vec3(-0.15F, 0.1F, -1.0F));
    SamplePlan plan;
    make_grid_sampler(name, display, 0.18)->plan(request, plan);
    // Stripes of all directions, down to 3 pixels a cycle.
    const auto picture = [](double x, double y) {
        const double value = 128.0 + 60.0 * std::sin(2.1 * x) * std::sin(1.3 * y) + 60.0 * std::sin(0.5 * x + 0.7 * y);
        return static_cast<Rgba8>(std::lround(value)) | 0xFF000000U;
    };
    const Picture made = reconstruct(plan, test::trace_picture(plan, picture, [](double, double) { return 1.0F; }));
    double error_inside = 0.0;
    double error_outside = 0.0;
    int inside = 0;
    int outside = 0;
    const Tangents& edge = display.eyes[kLeftEye].tangents;
    for (int y = 0; y < plan.height_px; ++y)
        for (int x = 0; x < plan.width_px; ++x) {
            const glm::dvec3 direction(edge.left + (edge.right - edge.left) * (x + 0.5) / plan.width_px,
                                       edge.top - (edge.top - edge.bottom) * (y + 0.5) / plan.height_px, -1.0);
            const double cosine = glm::dot(glm::normalize(direction), glm::dvec3(request.gaze_eye));
            const bool near = cosine > std::cos(5.0 * std::numbers::pi / 180.0);
            const double error = channel(made.color.at(x, y), 0) - channel(picture(x + 0.5, y + 0.5), 0);
            (near ? error_inside : error_outside) += error * error;
            ++(near ? inside : outside);
        }
    const auto psnr = [](double error, int count) {
        return 10.0 * std::log10(255.0 * 255.0 * count / std::max(error, 1e-9));
    };
    return {psnr(error_inside, inside), psnr(error_outside, outside)};
}

TEST(GridReconstruct, FoveatedGridsAreSharperAtTheGazeThanUniformOnes) {
    const Display display = test::without_outline(test::small_display(700, 568));
    const Quality uniform = quality_of("uniform", display);
    const Quality layers = quality_of("layers", display);
    const Quality log_polar = quality_of("log-polar", display);
    EXPECT_GT(layers.inside_db, uniform.inside_db + 20.0);
    EXPECT_GT(log_polar.inside_db, uniform.inside_db + 6.0);
    EXPECT_LT(layers.outside_db, uniform.outside_db);
    EXPECT_LT(log_polar.outside_db, uniform.outside_db);
}

}  // namespace
}  // namespace macula
