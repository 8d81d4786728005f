// The published masks at the size of real displays, which takes too long for runs with sanitizers.

#include <gtest/gtest.h>

#include "masks/make/mask.h"

namespace macula {
namespace {

constexpr std::array kPlacements = {Placement::void_and_cluster, Placement::floyd_steinberg, Placement::poisson_disk,
                                    Placement::white_noise, Placement::quincunx};

void expect_share(const Display& display, const char* sampling, Placement placement) {
    const Recipe recipe{display, parse_sampling(sampling).value(), placement};
    int drawings = 0;
    const auto mask = make_mask(
        recipe, [&drawings](const std::string& stage, double) { drawings += stage == "placing the samples" ? 1 : 0; });
    ASSERT_TRUE(mask) << mask.error().message;
    EXPECT_NEAR(sampled_share(*mask, {display.eye_width_px, display.eye_height_px}, axis_px(display, kLeftEye)),
                recipe.preset.share, 0.002)
        << mask->recipe;
    EXPECT_LE(drawings, 3) << mask->recipe;
}

TEST(MaskPresets, HaveTheirSharesOnDesktop) {
    for (const char* sampling : {"54", "41", "27", "18", "paper-54", "paper-41", "paper-27", "paper-18"})
        for (const Placement placement : kPlacements)
            expect_share(load_display("desktop").value(), sampling, placement);
}

TEST(MaskPresets, HaveTheirSharesOnVive) {
    const Display vive = load_display("vive").value();
    for (const char* sampling : {"54", "41", "27", "18", "paper-54", "paper-41", "paper-27", "paper-18"})
        expect_share(vive, sampling, Placement::void_and_cluster);
    for (const Placement placement : kPlacements) expect_share(vive, "paper-27", placement);
}

}  // namespace
}  // namespace macula
