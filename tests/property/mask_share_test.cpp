#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "masks/make/density.h"
#include "masks/make/mask.h"
#include "masks/make/placement.h"
#include "tests/support/small_display.h"

namespace macula {
namespace {

constexpr std::array kPlacements = {Placement::void_and_cluster, Placement::floyd_steinberg, Placement::poisson_disk,
                                    Placement::white_noise, Placement::quincunx};

Recipe recipe_of(const Display& display, const std::string& sampling, Placement placement = Placement::void_and_cluster,
                 MaskGeometry geometry = MaskGeometry::flat) {
    return {display, parse_sampling(sampling).value(), placement, geometry, 3};
}

void expect_share(const Recipe& recipe) {
    const auto mask = make_mask(recipe);
    ASSERT_TRUE(mask) << mask.error().message;
    const glm::ivec2 window_px(recipe.display.eye_width_px, recipe.display.eye_height_px);
    EXPECT_EQ(glm::ivec2(mask->width_px, mask->height_px), 2 * window_px);
    EXPECT_EQ(mask->gaze_px, window_px);
    EXPECT_EQ(mask->recipe, to_json(recipe));
    EXPECT_NEAR(sampled_share(*mask, window_px, axis_px(recipe.display, kLeftEye)), recipe.preset.share, 0.002)
        << mask->recipe;
}

TEST(MaskShare, IsThePresetsForEachPlacement) {
    for (const char* sampling : {"54", "41", "27", "18", "paper-54", "paper-41", "paper-27", "paper-18"})
        for (const Placement placement : kPlacements)
            expect_share(recipe_of(test::small_display(), sampling, placement));
}

TEST(MaskShare, IsThePresetsForOtherLawsAndGeometries) {
    for (const Placement placement : kPlacements)
        expect_share(recipe_of(test::small_display(), "27", placement, MaskGeometry::planar));
    expect_share(recipe_of(test::small_display(), "paper-41", Placement::poisson_disk, MaskGeometry::planar));
    expect_share(recipe_of(test::small_display(), "watson-33"));
    expect_share(recipe_of(test::small_display(240, 64), "hvvr-12"));  // pixels that are not square
}

TEST(MaskShare, OfALawWithoutPercentageIsWhatTheLawGives) {
    const Recipe recipe = recipe_of(test::small_display(756, 840), "geisler-perry", Placement::floyd_steinberg);
    const Mask mask = make_mask(recipe).value();
    const double px_per_deg = pixels_per_degree(recipe.display, kLeftEye, 0.0, 0.0);
    const glm::ivec2 axis = axis_px(recipe.display, kLeftEye);
    double expected = 0.0;
    for (int y = 0; y < 840; ++y) {
        for (int x = 0; x < 756; ++x) {
            const double eccentricity_deg =
                std::hypot(x - axis.x, y - axis.y) / (756 / (1.250510 + 1.397283) * std::numbers::pi / 180.0);
            const double cutoff_cpd = 2.3 * std::log(64.0) / (0.106 * (eccentricity_deg + 2.3));
            expected += std::clamp(std::pow(2.0 * cutoff_cpd / px_per_deg, 2.0), 4.0 / 256, 1.0);
        }
    }
    EXPECT_NEAR(sampled_share(mask, {756, 840}, axis), expected / (756.0 * 840.0), 0.001);
}

TEST(MaskShare, OutOfReachIsAnError) {
    for (const auto& [display, sampling] :
         {std::pair(test::small_display(), "1"), {test::small_display(), "hvvr-1.2"}}) {
        const auto mask = make_mask(recipe_of(display, sampling));
        ASSERT_FALSE(mask);
        EXPECT_EQ(mask.error().code, ErrorCode::option);
        EXPECT_NE(mask.error().message.find("1.6 % everywhere"), std::string::npos) << mask.error().message;
    }
}

/// Geisler and Perry's e2, exponent 2, for the published shares in flat geometry, as found by an implementation of its
/// own.
TEST(MaskLaw, HasTheKnownConstants) {
    const Display vive = load_display("vive").value();
    for (const auto& [sampling, e2_deg] : {std::pair("geisler-perry-54", 5.83),
                                           std::pair("geisler-perry-41", 4.65),
                                           {"geisler-perry-27", 3.40},
                                           {"geisler-perry-18", 2.57}}) {
        const AcuityLaw law = mask_law(recipe_of(vive, sampling, Placement::white_noise));
        EXPECT_NEAR(2.3 * law.stretch, e2_deg, 0.02 * e2_deg) << sampling;
    }
}

TEST(MaskField, IsThatOfTheDisplayForAGazeOnTheAxis) {
    const Display vive = load_display("vive").value();
    const double px_per_tangent = 1512 / (1.250510 + 1.397283);
    const MaskField planar(vive, MaskGeometry::planar);
    const MaskField flat(vive, MaskGeometry::flat);
    for (const double tangent : {0.0, 0.3, 1.0, 1.4}) {
        const double angle_deg = std::atan(tangent) * 180.0 / std::numbers::pi;
        const glm::dvec2 offset_px(0.6 * tangent * px_per_tangent, -0.8 * tangent * px_per_tangent);
        EXPECT_NEAR(planar.eccentricity_deg(offset_px), angle_deg, 0.001 * angle_deg + 1e-9);
        EXPECT_NEAR(planar.px_per_deg(angle_deg), pixels_per_degree(vive, kLeftEye, tangent, 0.0), 0.001);
        EXPECT_NEAR(flat.eccentricity_deg(offset_px), tangent * 180.0 / std::numbers::pi, 0.001 * angle_deg + 1e-9);
        EXPECT_NEAR(flat.px_per_deg(angle_deg), 9.967, 0.001);
    }
    EXPECT_EQ(flat.eccentricity_deg({0.0, 1e6}), 180.0);
}

TEST(DensityMap, IsTheWishedDensityOfEachPixel) {
    const Display display = test::small_display();
    for (const MaskGeometry geometry : {MaskGeometry::flat, MaskGeometry::planar}) {
        const MaskField field(display, geometry);
        const AcuityLaw law = mask_law(recipe_of(display, "27", Placement::void_and_cluster, geometry));
        const DensityMap map = make_density_map(field, law, {376, 416}, {188, 208});
        EXPECT_EQ(map.at(188, 208), 1.0F);
        for (int y = 0; y < 416; y += 7) {
            for (int x = 0; x < 376; x += 5) {
                const double wished = wished_density(field, law, field.eccentricity_deg({x - 188, y - 208}));
                ASSERT_NEAR(map.at(x, y), wished, 0.002) << x << ", " << y;
                ASSERT_GE(map.at(x, y), static_cast<float>(kLeastDensity));
            }
        }
    }
}

TEST(Mask, FollowsTheLawFromRingToRing) {
    const Display display = test::small_display(378 + 2, 420);
    for (const Placement placement : kPlacements) {
        const Recipe recipe = recipe_of(display, "27", placement);
        const Mask mask = make_mask(recipe).value();
        const MaskField field(display, recipe.geometry);
        const AcuityLaw law = mask_law(recipe);
        constexpr double kRing_deg = 6.0;
        std::vector<double> count(40);
        std::vector<double> expected(40);
        std::vector<double> variance(40);
        // Not of the border: it has sites of its own.
        for (int y = 1; y + 1 < mask.height_px; ++y) {
            for (int x = 1; x + 1 < mask.width_px; ++x) {
                const double eccentricity_deg = field.eccentricity_deg(glm::dvec2(x, y) - glm::dvec2(mask.gaze_px));
                const auto ring = static_cast<std::size_t>(eccentricity_deg / kRing_deg);
                const double wished = wished_density(field, law, eccentricity_deg);
                count[ring] += mask.sampled[static_cast<std::size_t>(y) * mask.width_px + x];
                expected[ring] += placed_density(placement, wished);
                variance[ring] += wished * (1.0 - wished);
            }
        }
        for (std::size_t ring = 0; ring < count.size(); ++ring) {
            EXPECT_NEAR(count[ring], expected[ring], 0.02 * expected[ring] + 4.0 * std::sqrt(variance[ring]))
                << to_string(placement) << ", ring " << ring;
        }
    }
}

TEST(Mask, OfFullIsAllPixelsOfTheWindow) {
    const Recipe recipe = recipe_of(test::small_display(), "full");
    const Mask mask = make_mask(recipe).value();
    EXPECT_EQ(glm::ivec2(mask.width_px, mask.height_px), glm::ivec2(188, 208));
    EXPECT_EQ(mask.gaze_px, axis_px(recipe.display, kLeftEye));
    EXPECT_EQ(mask.sampled, std::vector<std::uint8_t>(std::size_t{188} * 208, 1));
}

TEST(CloseBorder, LeavesNoGapAndKeepsTheRest) {
    Mask mask{61, 40, {30, 20}, std::vector<std::uint8_t>(std::size_t{61} * 40, 0), {}};
    mask.sampled[20] = 1;
    mask.sampled[5 * 61 + 5] = 1;
    close_border(mask);
    const auto at = [&mask](int x, int y) { return static_cast<int>(mask.sampled[y * 61 + x]); };
    const auto gap = [](int count, auto&& pixel) {
        int longest = 0;
        for (int i = 0, run = 0; i < count; ++i) longest = std::max(longest, run = pixel(i) != 0 ? 0 : run + 1);
        return longest;
    };
    for (const int y : {0, 39}) EXPECT_LT(gap(61, [&](int x) { return at(x, y); }), 8);
    for (const int x : {0, 60}) EXPECT_LT(gap(40, [&](int y) { return at(x, y); }), 8);
    EXPECT_EQ(at(0, 0) + at(60, 0) + at(0, 39) + at(60, 39) + at(20, 0) + at(5, 5), 6);
    int inside = 0;
    for (int y = 1; y < 39; ++y)
        for (int x = 1; x < 60; ++x) inside += at(x, y);
    EXPECT_EQ(inside, 1);
}

TEST(SampledShare, CountsTheWindowAroundTheGaze) {
    Mask mask{32, 32, {16, 16}, std::vector<std::uint8_t>(32 * 32, 0), {}};
    for (int y = 16; y < 20; ++y)
        for (int x = 16; x < 20; ++x) mask.sampled[y * 32 + x] = 1;
    EXPECT_DOUBLE_EQ(sampled_share(mask, {8, 8}, {0, 0}), 0.25);
    EXPECT_DOUBLE_EQ(sampled_share(mask, {8, 8}, {7, 7}), 1.0 / 64);
    EXPECT_DOUBLE_EQ(sampled_share(mask, {64, 64}, {32, 32}), 16.0 / 4096);  // beyond the mask nothing is sampled
    EXPECT_EQ(sampled_share(mask, {8, 8}, {100, 0}), 0.0);
}

TEST(AxisPx, LiesOffTheMiddleOnTheSideOfTheNose) {
    const Display vive = load_display("vive").value();
    EXPECT_EQ(axis_px(vive, kLeftEye), glm::ivec2(797, 836));
    EXPECT_EQ(axis_px(vive, kRightEye), glm::ivec2(714, 836));
}

}  // namespace
}  // namespace macula
