#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

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

TEST(ParseSampling, TakesNamedLawsAloneAndWithAPercentage) {
    for (const NamedLaw& law : named_laws()) {
        const std::string name(law.name);
        const auto alone = parse_sampling(name);
        ASSERT_TRUE(alone) << name;
        EXPECT_EQ(alone->free, SamplingPreset::Free::nothing);
        EXPECT_EQ(alone->law.model.index(), law.model.index());
        EXPECT_EQ(alone->law.exponent, 2.0);
        EXPECT_EQ(alone->name, name);
        const auto stretched = parse_sampling(name + "-27.5");
        ASSERT_TRUE(stretched) << name;
        EXPECT_EQ(stretched->free, SamplingPreset::Free::stretch);
        EXPECT_DOUBLE_EQ(stretched->share, 0.275);
        EXPECT_EQ(stretched->law.model.index(), law.model.index());
        for (const char* wrong : {"-", "-0", "-100", "27", "-27-27", " ", "-full"})
            EXPECT_FALSE(parse_sampling(name + wrong)) << name << wrong;
    }
    for (const char* wrong : {"paper", "paper-55", "paper-54.0", "paper-", "gauss", "-27"})
        EXPECT_FALSE(parse_sampling(wrong)) << wrong;
}

TEST(ParseSampling, TakesConstantsOfGeislerAndPerrysLaw) {
    const auto preset = parse_sampling("law:e2=3.5,full=2,exponent=1");
    ASSERT_TRUE(preset) << preset.error().message;
    EXPECT_EQ(preset->free, SamplingPreset::Free::nothing);
    EXPECT_EQ(preset->law.full_acuity_deg, 2.0);
    EXPECT_EQ(preset->law.exponent, 1.0);
    const auto* model = std::get_if<GeislerPerry>(&preset->law.model);
    ASSERT_NE(model, nullptr);
    EXPECT_EQ(model->e2_deg, 3.5);
    EXPECT_EQ(model->alpha_deg, GeislerPerry{}.alpha_deg);
    for (const char* wrong : {"law:", "law:e2", "law:e2=0", "law:e3=1", "law:contrast=1", "law:e2=1,", "law:e2=nan"}) {
        const auto refused = parse_sampling(wrong);
        ASSERT_FALSE(refused) << wrong;
        EXPECT_EQ(refused.error().code, ErrorCode::option);
        EXPECT_NE(refused.error().message.find(wrong), std::string::npos) << refused.error().message;
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

TEST(SolveLaw, ReachesAShareWithEveryLaw) {
    const Display vive = load_display("vive").value();
    for (const NamedLaw& law : named_laws()) {
        const auto preset = parse_sampling(std::string(law.name) + "-27").value();
        EXPECT_NEAR(tile_share(vive, kLeftEye, *tile_law(vive, kLeftEye, preset)), 0.27, 0.001) << law.name;
        const auto alone = parse_sampling(std::string(law.name)).value();
        EXPECT_EQ(tile_law(vive, kLeftEye, alone)->stretch, 1.0);
    }
    EXPECT_FALSE(tile_law(vive, kLeftEye, parse_sampling("full").value()));
}

/// The laws of the published masks on a display.
class PaperMasks {
public:
    explicit PaperMasks(Display display) : display_(std::move(display)) {
        for (const char* percent : {"54", "41", "27", "18"})
            law_[percent] = *tile_law(display_, kLeftEye, parse_sampling(std::string("paper-") + percent).value());
    }

    /// Of the pixels that lie at an eccentricity, to the left of the axis.
    [[nodiscard]] double share(const std::string& percent, double eccentricity_deg) const {
        const double tangent = std::tan(eccentricity_deg * std::numbers::pi / 180.0);
        return needed_share(law_.at(percent), eccentricity_deg, pixels_per_degree(display_, kLeftEye, -tangent, 0.0));
    }
    /// Eccentricity up to which every pixel is sampled.
    [[nodiscard]] double fovea_deg(const std::string& percent) const {
        double e_deg = 0.0;
        while (share(percent, e_deg) >= 1.0) e_deg += 0.25;
        return e_deg;
    }

private:
    Display display_;
    std::map<std::string, AcuityLaw> law_;
};

class PaperPresets : public testing::TestWithParam<const char*> {};

TEST_P(PaperPresets, HaveThePublishedShares) {
    Display display = load_display(GetParam()).value();
    for (EyeDisplay& eye : display.eyes) eye.visible_outline.clear();  // shares count hidden pixels too
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    for (const auto& [name, share] : {std::pair("paper-54", .54), std::pair("paper-41", .41),
                                      std::pair("paper-27", .27), std::pair("paper-18", .18)}) {
        for (const Eye eye : {kLeftEye, kRightEye}) {
            TileSampler sampler(display, eye, tile_law(display, eye, parse_sampling(name).value()), tables);
            SamplePlan plan;
            sampler.plan({}, plan);
            EXPECT_NEAR(plan.traced_share(), share, 0.002) << name;
        }
    }
}

TEST_P(PaperPresets, HaveTheFoveasThatThePaperDescribes) {
    const PaperMasks masks(load_display(GetParam()).value());
    // 27: fewer samples in the fovea. 18: the fovea of 54. 41: an extended centre.
    EXPECT_LT(masks.fovea_deg("27"), 0.6 * masks.fovea_deg("54"));
    EXPECT_NEAR(masks.fovea_deg("18"), masks.fovea_deg("54"), 0.01);
    EXPECT_GT(masks.fovea_deg("41"), 1.1 * masks.fovea_deg("54"));
}

TEST_P(PaperPresets, StarveThePeripheryAsThePaperDescribes) {
    const PaperMasks masks(load_display(GetParam()).value());
    for (const double e_deg : {48.0, 54.0, 60.0}) {
        EXPECT_LT(masks.share("27", e_deg), 0.5 * masks.share("54", e_deg)) << e_deg;
        EXPECT_LT(masks.share("41", e_deg), 0.6 * masks.share("54", e_deg)) << e_deg;  // strongly reduced
        EXPECT_LT(masks.share("18", e_deg), 0.1 * masks.share("27", e_deg)) << e_deg;
    }
}

INSTANTIATE_TEST_SUITE_P(Displays, PaperPresets, testing::Values("vive", "desktop"));

}  // namespace
}  // namespace macula
