#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "masks/law.h"
#include "masks/level_map.h"
#include "masks/tile_sampler.h"
#include "tests/support/law_for_share.h"

namespace macula {
namespace {

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
    const AcuityLaw law = law_for_share(load_display("vive").value(), kLeftEye, GetParam().share, shape);
    EXPECT_NEAR(2.3 * law.stretch, GetParam().e2_deg, 0.01 * GetParam().e2_deg);
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
                TileSampler sampler(display, eye, law_for_share(display, eye, share), tables);
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
    LevelMap(vive, kLeftEye, law_for_share(vive, kLeftEye, 0.01))
        .update(TileGrid({1512, 1680}, glm::ivec2(0)), {0.0F, 0.0F, -1.0F}, levels.data(), 95);
    EXPECT_GE(std::count(levels.begin(), levels.end(), 1), 95 * 105 - 4);
}

}  // namespace
}  // namespace macula
