// Figures of clips whose error is known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "server/kernels/camera.h"
#include "tests/metrics/clip_meter.h"

namespace macula::test {
namespace {

constexpr int kWidth = 94;
constexpr int kHeight = 104;
const Tangents kTangents{-1.397283F, 1.250510F, -1.477517F, 1.464221F};  // the Vive's left eye
const glm::vec3 kForward(0.0F, 0.0F, -1.0F);

Rgba8 grey(int value) {
    return static_cast<Rgba8>(value) * 0x010101U | 0xFF000000U;
}

ColorImage constant(int value) {
    return {kWidth, kHeight, grey(value)};
}

ColorImage noise(std::uint32_t seed, int lowest, int highest) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> value(lowest, highest);
    ColorImage image(kWidth, kHeight);
    for (Rgba8& texel : image.texels) texel = grey(value(random));
    return image;
}

double eccentricity_by_kernel_deg(int x, int y, const glm::vec3& gaze) {
    const glm::vec4 edges(kTangents.left, kTangents.right, kTangents.bottom, kTangents.top);
    const glm::dvec3 direction =
        kernels::eye_ray_direction(glm::mat3(1.0F), edges, glm::vec2(kWidth, kHeight), glm::vec2(x, y) + 0.5F);
    const double cosine = glm::dot(direction, glm::dvec3(gaze)) / glm::length(direction);
    return glm::degrees(std::acos(std::min(cosine, 1.0)));
}

TEST(Eccentricity, IsTheAngleBetweenThePixelsRayAndTheGaze) {
    for (const glm::vec3 gaze :
         {kForward, glm::normalize(glm::vec3(0.6F, -0.3F, -1.0F)), glm::vec3(-1.0F, 0.0F, 0.0F)}) {
        const auto angles = eccentricity_deg(kTangents, kWidth, kHeight, gaze);
        ASSERT_EQ(angles.size(), static_cast<std::size_t>(kWidth) * kHeight);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                ASSERT_NEAR(angles[y * kWidth + x], eccentricity_by_kernel_deg(x, y, gaze), 2e-3) << x << ", " << y;
            }
        }
    }
}

TEST(Eccentricity, OfAPixelAt45DegreesIs45) {
    const auto angles = eccentricity_deg({-1.5F, 1.5F, -1.5F, 1.5F}, 3, 3, kForward);
    EXPECT_NEAR(angles[4], 0.0F, 1e-5F);
    EXPECT_NEAR(angles[5], 45.0F, 1e-5F);
    EXPECT_NEAR(angles[1], 45.0F, 1e-5F);
    EXPECT_NEAR(angles[0], glm::degrees(std::atan(std::sqrt(2.0F))), 1e-4F);
}

TEST(ClipMeter, ConstantOffsetHasThePsnrOfTheOffset) {
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    const ColorImage reference = noise(1, 0, 200);
    ColorImage shown = reference;
    for (Rgba8& texel : shown.texels) texel += 0x0A0A0AU;
    meter.add(shown, reference, kForward);
    const ClipFigures figures = meter.figures();
    EXPECT_EQ(figures.frames, 1);
    EXPECT_NEAR(figures.psnr_db, 20.0 * std::log10(255.0 / 10.0), 1e-9);
    EXPECT_NEAR(figures.foveal_psnr_db, figures.psnr_db, 1e-9);
    EXPECT_TRUE(std::isnan(figures.flicker)) << "a single frame does not flicker";
    EXPECT_TRUE(std::isnan(figures.worst_flicker));
    for (const double flicker : figures.ring_flicker) EXPECT_TRUE(std::isnan(flicker));
}

TEST(ClipMeter, OneChannelOfThreeThatIsWrongCountsAThird) {
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    ColorImage shown = constant(50);
    for (Rgba8& texel : shown.texels) texel += 20U << 16U;  // blue
    meter.add(shown, constant(50), kForward);
    EXPECT_NEAR(meter.figures().psnr_db, 20.0 * std::log10(255.0 / 20.0) + 10.0 * std::log10(3.0), 1e-9);
}

TEST(ClipMeter, EqualPicturesHaveInfinitePsnrAndNoFlicker) {
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    for (std::uint32_t i = 0; i < 3; ++i) meter.add(noise(i, 0, 255), noise(i, 0, 255), kForward);
    const ClipFigures figures = meter.figures();
    EXPECT_EQ(figures.psnr_db, std::numeric_limits<double>::infinity());
    EXPECT_EQ(figures.foveal_psnr_db, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(figures.ssim, 1.0, 1e-6);
    EXPECT_EQ(figures.flicker, 0.0);
    EXPECT_EQ(figures.worst_flicker, 0.0);
}

TEST(ClipMeter, PsnrIsOfTheErrorOfAllFramesTogether) {
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    meter.add(constant(100), constant(100), kForward);
    meter.add(constant(110), constant(100), kForward);
    EXPECT_NEAR(meter.figures().psnr_db, -10.0 * std::log10(10.0 * 10.0 / 2.0 / (255.0 * 255.0)), 1e-9);
}

TEST(ClipMeter, FovealWindowFollowsTheGaze) {
    // Only pixels within the foveal radius of where the gaze is at each frame are wrong.
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    double wrong = 0.0;
    for (const float slope : {0.0F, 0.5F, -0.7F}) {
        const glm::vec3 gaze = glm::normalize(glm::vec3(slope, 0.2F, -1.0F));
        ColorImage shown = constant(100);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                if (eccentricity_by_kernel_deg(x, y, gaze) > kFovealRadius_deg) continue;
                shown.at(x, y) = grey(130);
                wrong += 1.0;
            }
        }
        meter.add(shown, constant(100), gaze);
    }
    const ClipFigures figures = meter.figures();
    EXPECT_NEAR(figures.foveal_psnr_db, 20.0 * std::log10(255.0 / 30.0), 1e-9);
    const double share = wrong / (3.0 * kWidth * kHeight);
    EXPECT_NEAR(figures.psnr_db, 20.0 * std::log10(255.0 / 30.0) - 10.0 * std::log10(share), 1e-9);
}

TEST(ClipMeter, GazeThatIsNeverOnThePictureHasNoFovealWindow) {
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    meter.add(constant(100), constant(101), glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_TRUE(std::isnan(meter.figures().foveal_psnr_db));
    EXPECT_FALSE(std::isnan(meter.figures().psnr_db));
}

TEST(ClipMeter, FlickerIsTheChangeOfTheErrorByRing) {
    // The error of each ring alternates between 0 and a step of its own.
    constexpr std::array<int, kRingEnd_deg.size()> kStep = {1, 2, 4, 8, 16};
    const glm::vec3 gaze = glm::normalize(glm::vec3(0.3F, 0.1F, -1.0F));
    ColorImage off = constant(100);
    ColorImage on = off;
    double squares = 0.0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const double angle_deg = eccentricity_by_kernel_deg(x, y, gaze);
            std::size_t ring = 0;
            while (angle_deg > kRingEnd_deg[ring]) ++ring;
            on.at(x, y) = grey(100 + kStep[ring]);
            squares += kStep[ring] * kStep[ring];
        }
    }
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    for (const ColorImage* shown : {&off, &on, &off, &on}) meter.add(*shown, constant(90), gaze);
    const ClipFigures figures = meter.figures();
    for (std::size_t ring = 0; ring < kStep.size(); ++ring) {
        EXPECT_NEAR(figures.ring_flicker[ring], kStep[ring] / 255.0, 1e-9) << "ring " << ring;
    }
    EXPECT_NEAR(figures.flicker, std::sqrt(squares / (kWidth * kHeight)) / 255.0, 1e-9);
    EXPECT_NEAR(figures.worst_flicker, figures.flicker, 1e-9);
}

TEST(ClipMeter, ReferenceThatMovesWithTheClipDoesNotFlicker) {
    // The picture is another one in each frame; its error stays.
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    for (std::uint32_t i = 0; i < 4; ++i) {
        const ColorImage reference = noise(i, 0, 200);
        ColorImage shown = reference;
        for (Rgba8& texel : shown.texels) texel += 0x050505U;
        meter.add(shown, reference, kForward);
    }
    EXPECT_EQ(meter.figures().flicker, 0.0);
    EXPECT_NEAR(meter.figures().psnr_db, 20.0 * std::log10(255.0 / 5.0), 1e-9);
}

TEST(ClipMeter, PictureThatLagsBehindItsReferenceFlickers) {
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    meter.add(constant(100), constant(100), kForward);
    meter.add(constant(100), constant(103), kForward);
    EXPECT_NEAR(meter.figures().flicker, 3.0 / 255.0, 1e-9);
}

TEST(ClipMeter, WorstStepIsTheOneThatPops) {
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    for (const int value : {100, 101, 100, 140, 140}) meter.add(constant(value), constant(100), kForward);
    EXPECT_NEAR(meter.figures().worst_flicker, 40.0 / 255.0, 1e-9);
    EXPECT_NEAR(meter.figures().flicker, std::sqrt((1.0 + 1.0 + 1600.0 + 0.0) / 4.0) / 255.0, 1e-9);
}

TEST(ClipMeter, HiddenPixelsDoNotCount) {
    std::vector<std::uint8_t> hidden(static_cast<std::size_t>(kWidth) * kHeight, 0);
    for (std::size_t i = 0; i < hidden.size() / 2; ++i) hidden[i] = 1;
    ClipMeter meter(kTangents, kWidth, kHeight, hidden);
    for (const int junk : {0, 255, 30}) {
        ColorImage shown = constant(104);
        for (std::size_t i = 0; i < hidden.size(); ++i) {
            if (hidden[i] != 0) shown.texels[i] = grey(junk);
        }
        meter.add(shown, constant(100), kForward);
    }
    const ClipFigures figures = meter.figures();
    EXPECT_NEAR(figures.psnr_db, 20.0 * std::log10(255.0 / 4.0), 1e-9);
    EXPECT_EQ(figures.flicker, 0.0);
    const double a = 104.0 / 255.0;
    const double b = 100.0 / 255.0;
    EXPECT_NEAR(figures.ssim, (2.0 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-5);
}

TEST(ClipMeter, RingsFarFromTheGazeAreEmptyIfItIsAtTheEdge) {
    // 80 degrees to the right: the nearest pixel is 28 degrees away, the farthest beyond 90.
    const float angle = glm::radians(80.0F);
    ClipMeter meter(kTangents, kWidth, kHeight, {});
    const glm::vec3 gaze(std::sin(angle), 0.0F, -std::cos(angle));
    meter.add(constant(100), constant(100), gaze);
    meter.add(constant(110), constant(100), gaze);
    const ClipFigures figures = meter.figures();
    for (const int ring : {0, 1, 2}) EXPECT_TRUE(std::isnan(figures.ring_flicker[ring])) << "ring " << ring;
    for (const int ring : {3, 4}) EXPECT_NEAR(figures.ring_flicker[ring], 10.0 / 255.0, 1e-9) << "ring " << ring;
    EXPECT_NEAR(figures.flicker, 10.0 / 255.0, 1e-9);
}

}  // namespace
}  // namespace macula::test
