#include "masks/law.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "masks/level_map.h"
#include "masks/tile_sampler.h"

namespace macula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(PixelsPerDegree, IsThePublishedOneAtTheCentreAndGrowsBySecantToTheThreeHalves) {
    const Display vive = load_display("vive").value();
    EXPECT_NEAR(pixels_per_degree(vive, kLeftEye, 0.0, 0.0), 9.967, 0.001);
    for (const double angle_deg : {5.0, 20.0, 40.0, 60.0}) {
        const double expected = 9.967 * std::pow(std::cos(angle_deg * kDegree), -1.5);
        EXPECT_NEAR(pixels_per_degree(vive, kLeftEye, 0.0, std::tan(angle_deg * kDegree)), expected, 1e-3 * expected);
        EXPECT_NEAR(pixels_per_degree(vive, kLeftEye, -std::tan(angle_deg * kDegree), 0.0), expected, 1e-3 * expected);
    }
}

TEST(PixelsPerDegree, IsTheRootOfThePixelsPerSolidAngle) {
    const Display vive = load_display("vive").value();
    const Tangents& edge = vive.eyes[kRightEye].tangents;
    const double width = (double{edge.right} - edge.left) / vive.eye_width_px;
    const double height = (double{edge.top} - edge.bottom) / vive.eye_height_px;
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.3, 0.2), std::pair(-1.1, 1.4), std::pair(0.7, -1.4)}) {
        // Solid angle of a pixel: the parallelogram of its corners' directions.
        const auto direction = [](double tx, double ty) { return glm::normalize(glm::dvec3(tx, ty, -1.0)); };
        const glm::dvec3 corner = direction(x - width / 2, y - height / 2);
        const glm::dvec3 across = direction(x + width / 2, y - height / 2) - corner;
        const glm::dvec3 up = direction(x - width / 2, y + height / 2) - corner;
        const double solid_angle_deg2 = glm::length(glm::cross(across, up)) / (kDegree * kDegree);
        EXPECT_NEAR(std::pow(pixels_per_degree(vive, kRightEye, x, y), 2.0) * solid_angle_deg2, 1.0, 5e-3);
    }
}

TEST(AcuityLaw, HasThePublishedCutoffFrequencies) {
    const AcuityLaw law;
    EXPECT_NEAR(cutoff_frequency_cpd(law, 0.0), 39.23, 0.01);  // ln 64 / .106
    EXPECT_NEAR(cutoff_frequency_cpd(law, law.e2_deg), 39.23 / 2, 0.01);
    AcuityLaw shifted;
    shifted.full_acuity_deg = 1.5;
    EXPECT_EQ(cutoff_frequency_cpd(shifted, 1.0), cutoff_frequency_cpd(law, 0.0));
    EXPECT_DOUBLE_EQ(cutoff_frequency_cpd(shifted, 10.0), cutoff_frequency_cpd(law, 8.5));
}

TEST(AcuityLaw, NeedsTheNyquistDensityToItsExponent) {
    AcuityLaw law;
    const double px_per_deg = 20.0;
    const double density = 2.0 * cutoff_frequency_cpd(law, 30.0) / px_per_deg;
    EXPECT_DOUBLE_EQ(needed_share(law, 30.0, px_per_deg), density * density);
    law.exponent = 1.0;
    EXPECT_DOUBLE_EQ(needed_share(law, 30.0, px_per_deg), density);
    EXPECT_EQ(needed_share(law, 0.0, px_per_deg), 1.0);
}

TEST(ParseSampling, TakesFullAndPercentages) {
    EXPECT_TRUE(parse_sampling("full").value().full);
    for (const auto& [text, share] : {std::pair("54", 0.54), std::pair("1", 0.01), std::pair("11.6", 0.116)}) {
        EXPECT_FALSE(parse_sampling(text).value().full);
        EXPECT_DOUBLE_EQ(parse_sampling(text).value().share, share);
    }
}

TEST(ParseSampling, RefusesOtherTextWithAHint) {
    for (const char* text : {"", "0", "100", "-5", "54%", "half", "nan", "1e9", " 54", "FULL", "0x20"}) {
        const auto parsed = parse_sampling(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_EQ(parsed.error().code, ErrorCode::option);
        EXPECT_NE(parsed.error().message.find("1 to 99"), std::string::npos) << parsed.error().message;
    }
}

struct PublishedLaw {
    double share;
    double exponent;
    double full_acuity_deg;
    double e2_deg;
};

/// Values that another implementation of the same method found for the Vive's left eye.
class SolveLaw : public testing::TestWithParam<PublishedLaw> {};

TEST_P(SolveLaw, FindsTheKnownE2) {
    AcuityLaw shape;
    shape.exponent = GetParam().exponent;
    shape.full_acuity_deg = GetParam().full_acuity_deg;
    const AcuityLaw law = solve_law(load_display("vive").value(), kLeftEye, GetParam().share, shape);
    EXPECT_NEAR(law.e2_deg, GetParam().e2_deg, 0.01 * GetParam().e2_deg);
}

INSTANTIATE_TEST_SUITE_P(Published, SolveLaw,
                         testing::Values(PublishedLaw{.54, 2, 0, 8.654}, PublishedLaw{.41, 2, 0, 6.490},
                                         PublishedLaw{.27, 2, 0, 4.444}, PublishedLaw{.18, 2, 0, 3.201},
                                         PublishedLaw{.116, 2, 0, 2.305}, PublishedLaw{.54, 1, 0, 5.647},
                                         PublishedLaw{.27, 1, 0, 2.271}, PublishedLaw{.54, 2, 1.5, 8.378},
                                         PublishedLaw{.18, 2, 1.5, 3.053}));

TEST(SolveLaw, GivesPlansOfTheWishedShareOnEachDisplay) {
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    for (const char* name : {"vive", "desktop"}) {
        Display display = load_display(name).value();
        for (EyeDisplay& eye : display.eyes) eye.visible_outline.clear();  // shares count hidden pixels too
        for (const double share : {.54, .41, .27, .18}) {
            for (const Eye eye : {kLeftEye, kRightEye}) {
                TileSampler sampler(display, eye, solve_law(display, eye, share), tables);
                SamplePlan plan;
                sampler.plan({}, plan);
                EXPECT_NEAR(plan.traced_share(), share, 0.002) << name;
            }
        }
    }
}

TEST(SolveLaw, BelowTheSparsestLevelGivesTheSparsestPlan) {
    const Display vive = load_display("vive").value();
    std::vector<std::uint8_t> levels(std::size_t{95} * 105);
    LevelMap(vive, kLeftEye, solve_law(vive, kLeftEye, 0.01))
        .update(TileGrid({1512, 1680}, glm::ivec2(0)), {0.0F, 0.0F, -1.0F}, levels.data(), 95);
    EXPECT_GE(std::count(levels.begin(), levels.end(), 1), 95 * 105 - 4);
}

/// The same quantisation, written the slow way.
int nearest_level(double need) {
    int nearest = 1;
    for (int level = 2; level <= kFullLevel; ++level) {
        const auto distance = [need](int l) { return std::abs(std::log(kLevelCounts[l] / 256.0 / need)); };
        if (distance(level) < distance(nearest)) nearest = level;
    }
    return nearest;
}

TEST(LevelMap, IsTheNearestLevelInLogOfTheNeedAtTheTilesCentre) {
    std::mt19937 random(20261122);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Display vive = load_display("vive").value();
    const Tangents& edge = vive.eyes[kLeftEye].tangents;
    for (int round = 0; round < 20; ++round) {
        AcuityLaw law;
        law.e2_deg = 5.0 + 4.0 * uniform(random);
        law.exponent = 1.5 + 0.5 * uniform(random);
        law.full_acuity_deg = round % 2 == 0 ? 0.0 : 1.5;
        const glm::dvec3 gaze =
            glm::normalize(glm::dvec3(uniform(random), uniform(random), round < 15 ? -1.0 : uniform(random)));
        const glm::ivec2 phase(static_cast<int>(random() % 64), static_cast<int>(random() % 64));
        const TileGrid grid({1512, 1680}, phase);
        std::vector<std::uint8_t> levels(static_cast<std::size_t>(grid.tiles.x) * grid.tiles.y);
        LevelMap(vive, kLeftEye, law).update(grid, glm::vec3(gaze), levels.data(), grid.tiles.x);
        for (int y = 0; y < grid.tiles.y; ++y) {
            for (int x = 0; x < grid.tiles.x; ++x) {
                const glm::dvec2 centre = glm::dvec2(grid.origin_px) + 16.0 * glm::dvec2(x, y) + 8.0;
                const glm::dvec2 tangent(edge.left + centre.x / 1512 * (double{edge.right} - edge.left),
                                         edge.top - centre.y / 1680 * (double{edge.top} - edge.bottom));
                const glm::dvec3 direction = glm::normalize(glm::dvec3(tangent, -1.0));
                const double angle = std::acos(glm::clamp(glm::dot(direction, gaze), -1.0, 1.0)) / kDegree;
                const double need = needed_share(law, angle, pixels_per_degree(vive, kLeftEye, tangent.x, tangent.y));
                const int level = levels[y * grid.tiles.x + x];
                // On a boundary single precision may choose either side.
                EXPECT_GE(level, nearest_level(need * 0.999)) << "need " << need;
                EXPECT_LE(level, nearest_level(need * 1.001)) << "need " << need;
            }
        }
        if (HasFailure()) return;
    }
}

}  // namespace
}  // namespace macula
