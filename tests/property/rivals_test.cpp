// Plans of the published samplers: counts, what is traced for whom, and where.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/support/grid_cases.h"

namespace macula {
namespace {

using test::grid_samplers;
using test::make_grid_sampler;
using test::place_px;

/// Addresses that a pixel interpolates.
using Reads = std::vector<std::uint32_t>;

Reads rectangular_reads(const GridLayout& layout, int x, int y) {
    Reads reads;
    for (const RectangularGrid& grid : layout.rectangular) {
        const GridPlace column = GridPlace::unpacked(grid.columns[static_cast<std::size_t>(x)]);
        const GridPlace row = GridPlace::unpacked(grid.rows[static_cast<std::size_t>(y)]);
        const std::uint32_t shown = std::min(column.shown, row.shown);
        if (shown == 0) continue;
        for (std::uint32_t j = row.index; j <= row.index + (row.weight > 0 ? 1 : 0); ++j)
            for (std::uint32_t i = column.index; i <= column.index + (column.weight > 0 ? 1 : 0); ++i) {
                EXPECT_LT(i, static_cast<std::uint32_t>(grid.count.x));
                EXPECT_LT(j, static_cast<std::uint32_t>(grid.count.y));
                reads.push_back(grid.offset + j * static_cast<std::uint32_t>(grid.count.x) + i);
            }
        if (shown == 256) return reads;
    }
    ADD_FAILURE() << "nothing covers pixel " << x << ", " << y;
    return reads;
}

/// The corners of the cell that the documented mapping puts a pixel in.
Reads log_polar_reads(const LogPolarGrid& grid, int x, int y) {
    const double away_x = x + 0.5 - double{grid.centre_px.x};
    const double away_y = y + 0.5 - double{grid.centre_px.y};
    const double part = std::log(std::max(1.0, std::hypot(away_x, away_y))) / grid.log_radius;
    const double u = std::max(0.0, part * part * part * part * (grid.count.x - 1) - grid.phase.x);
    double v = std::atan2(away_y, away_x) / (2.0 * std::numbers::pi) * grid.count.y - grid.phase.y;
    if (v < 0.0) v += grid.count.y;
    if (v < 0.0) v += grid.count.y;
    const int left = static_cast<int>(u);
    const int right = std::min(left + 1, grid.count.x - 1);
    const int above = static_cast<int>(v) % grid.count.y;
    const int below = (above + 1) % grid.count.y;
    Reads reads;
    for (const int row : {above, below})
        for (const int column : {left, right}) reads.push_back(static_cast<std::uint32_t>(row * grid.count.x + column));
    return reads;
}

std::vector<bool> traced_set(const SamplePlan& plan) {
    std::vector<bool> traced(plan.address_count());
    std::uint32_t in_window = 0;
    for (const std::uint32_t address : plan.trace_order) {
        EXPECT_FALSE(traced.at(address)) << "address " << address << " is traced twice";
        traced[address] = true;
        const SamplePosition at = plan.position[address];
        in_window += at.x_px >= 0 && at.y_px >= 0 && at.x_px < plan.width_px && at.y_px < plan.height_px ? 1 : 0;
    }
    EXPECT_EQ(plan.traced_in_window, in_window);
    std::vector<bool> seen = traced;
    for (const std::uint32_t address : plan.untraced) {
        EXPECT_FALSE(seen.at(address)) << "address " << address << " is untraced and else";
        seen[address] = true;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0);
    return traced;
}

TEST(Rivals, EveryVisiblePixelIsInterpolatedFromTracedSamplesAndNoOthersAreTraced) {
    const Display display = test::small_display(132, 108);
    for (const std::string& name : grid_samplers())
        for (const double share : {0.6, 0.27, 0.05}) {
            const auto sampler = make_grid_sampler(name, display, share);
            SamplePlan plan;
            for (std::uint32_t seed = 1; seed <= 8; ++seed) {
                SCOPED_TRACE(name + " " + std::to_string(share) + " seed " + std::to_string(seed));
                std::mt19937 random(seed);
                sampler->plan(test::random_request(random), plan);
                const std::vector<bool> traced = traced_set(plan);
                std::vector<bool> read(traced.size());
                int missing = 0;
                for (int y = 0; y < plan.height_px; ++y)
                    for (int x = 0; x < plan.width_px; ++x) {
                        if (!test::is_visible(plan, x, y)) continue;
                        const Reads reads = plan.grids.rectangular.empty() ? log_polar_reads(plan.grids.log_polar, x, y)
                                                                           : rectangular_reads(plan.grids, x, y);
                        for (const std::uint32_t address : reads) {
                            read[address] = true;
                            missing += traced[address] ? 0 : 1;
                        }
                    }
                EXPECT_EQ(missing, 0);
                if (!plan.grids.rectangular.empty()) {
                    EXPECT_EQ(read, traced);
                }
                if (testing::Test::HasFailure()) return;
            }
        }
}

TEST(Rivals, SamplesLieWhereTheLayoutSays) {
    const Display display = test::small_display();
    for (const std::string& name : grid_samplers()) {
        const auto sampler = make_grid_sampler(name, display, 0.3);
        SamplePlan plan;
        for (std::uint32_t seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(name + " seed " + std::to_string(seed));
            std::mt19937 random(seed);
            sampler->plan(test::random_request(random), plan);
            const double rounding = 0.501 / 256.0;
            for (const RectangularGrid& grid : plan.grids.rectangular)
                for (int i = 0; i < grid.count.x * grid.count.y; ++i) {
                    const int column = i % grid.count.x;
                    const int row = i / grid.count.x;
                    const glm::dvec2 at = place_px(plan, grid.offset + static_cast<std::uint32_t>(i));
                    ASSERT_NEAR(at.x, double{grid.first_px.x} + column * double{grid.step_px.x}, rounding);
                    ASSERT_NEAR(at.y, double{grid.first_px.y} + row * double{grid.step_px.y}, rounding);
                }
            const LogPolarGrid& polar = plan.grids.log_polar;
            for (int i = 0; i < polar.count.x * polar.count.y; ++i) {
                const glm::dvec2 at = place_px(plan, static_cast<std::uint32_t>(i));
                const int column = i % polar.count.x;
                const int row = i / polar.count.x;
                const double part = (column + double{polar.phase.x}) / (polar.count.x - 1);
                const double radius = std::exp(polar.log_radius * std::pow(part, 0.25));
                const double angle = 2.0 * std::numbers::pi * (row + double{polar.phase.y}) / polar.count.y;
                ASSERT_NEAR(at.x, polar.centre_px.x + radius * std::cos(angle), 1.5 * rounding);
                ASSERT_NEAR(at.y, polar.centre_px.y + radius * std::sin(angle), 1.5 * rounding);
            }
        }
    }
}

TEST(Rivals, CountsAreTheSharesAtTheAxis) {
    const Display display = test::without_outline(load_display("desktop").value());
    for (const std::string& name : grid_samplers())
        for (const double share : {0.54, 0.41, 0.27, 0.18}) {
            SamplePlan plan;
            make_grid_sampler(name, display, share)->plan({}, plan);
            EXPECT_NEAR(plan.traced_share(), share, 0.002) << name;
        }
}

TEST(Rivals, FullIsEveryVisiblePixelAtItsCentre) {
    const Display display = test::small_display();
    for (const std::string name : {"uniform", "layers"}) {
        const auto sampler = make_grid_sampler(name, display, 1.0);
        SamplePlan plan;
        std::mt19937 random(7);
        sampler->plan(test::random_request(random), plan);
        EXPECT_TRUE(plan.place.empty());
        std::vector<std::uint8_t> traced(plan.hidden->size());
        for (const std::uint32_t address : plan.trace_order) {
            const SamplePosition at = plan.position[address];
            ++traced.at(static_cast<std::size_t>(at.y_px) * static_cast<std::size_t>(plan.width_px) +
                        static_cast<std::size_t>(at.x_px));
            EXPECT_EQ(plan.spacing_px(address), 1.0F);
        }
        for (std::size_t i = 0; i < traced.size(); ++i) ASSERT_EQ(traced[i], (*plan.hidden)[i] == 0 ? 1 : 0) << name;
    }
}

TEST(Rivals, LogPolarHasNoFullResolution) {
    for (const double share : {1.0, 0.0, 1.5}) {
        const auto sampler = LogPolarSampler::make(test::small_display(), kLeftEye, share);
        ASSERT_FALSE(sampler);
        EXPECT_EQ(sampler.error().code, ErrorCode::option);
    }
}

// The kernel function is the share of the columns inside a radius: (ln r / L)^4.
TEST(Rivals, LogPolarDensityIsTheKernelFunction) {
    const Display display = test::without_outline(test::small_display());
    SamplePlan plan;
    make_grid_sampler("log-polar", display, 0.5)->plan({}, plan);
    const LogPolarGrid& grid = plan.grids.log_polar;
    for (const double radius : {4.0, 9.0, 25.0, 60.0}) {
        int inside = 0;
        for (const std::uint32_t address : plan.trace_order)
            inside += glm::distance(place_px(plan, address), glm::dvec2(grid.centre_px)) < radius ? 1 : 0;
        const double expected = std::pow(std::log(radius) / grid.log_radius, 4.0) * (grid.count.x - 1) * grid.count.y;
        EXPECT_NEAR(inside, expected, 1.05 * grid.count.y) << radius;
    }
}

/// Samples of three layers around the axis, by the paper's model with covered samples left out.
double layer_samples(const Display& display, const LinearMar& law, double inner_deg, double middle_deg) {
    const Tangents& edge = display.eyes[kLeftEye].tangents;
    const double pixel = (double{edge.right} - edge.left) / display.eye_width_px;  // square ones
    const double cycle_deg = 2.0 * std::atan(pixel) * 180.0 / std::numbers::pi;
    const auto step = [&](double e) { return std::max(1.0, (law.foveal_deg + law.slope * e) / cycle_deg); };
    const auto area = [&](double e, double less_px) {
        const double reach = std::tan(e * std::numbers::pi / 180.0) - less_px * pixel;
        const double width = std::min<double>(edge.right, reach) - std::max<double>(edge.left, -reach);
        const double height = std::min<double>(edge.top, reach) - std::max<double>(edge.bottom, -reach);
        return std::max(0.0, width) * std::max(0.0, height) / (pixel * pixel);
    };
    const double fade = kFadeSamples;
    return area(inner_deg, 0.0) +
           (area(middle_deg, 0.0) - area(inner_deg, fade * step(inner_deg))) / std::pow(step(inner_deg), 2.0) +
           (1.0 * display.eye_width_px * display.eye_height_px - area(middle_deg, fade * step(middle_deg))) /
               std::pow(step(middle_deg), 2.0);
}

TEST(Rivals, LayersHaveTheLeastSamplesThatTheLawAllows) {
    const Display display = load_display("vive").value();
    for (const double slope : {0.0275, 0.022, 0.01}) {
        const LinearMar law{.slope = slope};
        const LayerChoice chosen = choose_layers(display, kLeftEye, law);
        const double to_deg = 180.0 / std::numbers::pi;
        const double inner_deg = to_deg * chosen.radius_rad[0];
        const double middle_deg = to_deg * chosen.radius_rad[1];
        EXPECT_NEAR(chosen.samples, layer_samples(display, law, inner_deg, middle_deg), 2e-3 * chosen.samples);
        // The MAR at the layers' inner edges, in pixels of 2 atan(1 / 571.04) degrees a cycle.
        EXPECT_NEAR(chosen.step_px[1], (1.0 / 48.0 + slope * inner_deg) / 0.200671, 2e-3);
        EXPECT_NEAR(chosen.step_px[2], (1.0 / 48.0 + slope * middle_deg) / 0.200671, 4e-3);
        double least = 1e12;
        for (double inner = (0.200671 - 1.0 / 48.0) / slope; inner < 55.0; inner += 0.25)
            for (double middle = inner; middle < 56.0; middle += 0.25)
                least = std::min(least, layer_samples(display, law, inner, middle));
        EXPECT_LE(chosen.samples, 1.002 * least) << slope;
    }
}

// Along the gaze's row a layer ends at its radius, and has come in whole where its fade ends.
TEST(Rivals, LayersEndAtTheirRadiusAndFadeSmoothly) {
    const Display display = test::without_outline(test::small_display(1050, 850));
    LayerSampler sampler(display, kLeftEye, 0.27);
    PlanRequest request;
    request.gaze_eye = glm::normalize(glm::vec3(-0.3F, 0.2F, -1.0F));
    SamplePlan plan;
    sampler.plan(request, plan);
    const double row_tangent = 0.2;
    for (std::size_t layer = 0; layer < 2; ++layer) {
        const std::vector<std::uint32_t>& columns = plan.grids.rectangular[layer].columns;
        const auto shown = [&](int x) { return GridPlace::unpacked(columns[static_cast<std::size_t>(x)]).shown; };
        const int gaze_x = 450;  // 1.2 - .3 of 2.1
        int edge = gaze_x;
        while (edge > 0 && shown(edge) > 0) --edge;  // the first column without
        const glm::dvec3 outer(-1.2 + 2.1 * (edge + 1.0) / 1050.0, row_tangent, -1.0);
        const double angle_rad = std::acos(glm::dot(glm::normalize(outer), glm::dvec3(request.gaze_eye)));
        EXPECT_NEAR(angle_rad, sampler.layers().radius_rad[layer], 0.002) << layer;
        const double fade_px = kFadeSamples * sampler.layers().step_px[layer + 1];
        EXPECT_NEAR(shown(edge + static_cast<int>(std::lround(0.5 * fade_px))), 128.0, 1.5 * 256.0 / fade_px);
        EXPECT_EQ(shown(edge + 2 + static_cast<int>(fade_px)), 256U);
        for (int x = edge + 1; x < gaze_x; ++x) ASSERT_GE(shown(x), shown(x - 1));
    }
}

}  // namespace
}  // namespace macula
