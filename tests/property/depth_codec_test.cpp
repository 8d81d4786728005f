#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "protocol/codec/depth_codec.h"
#include "protocol/codec/depth_plane.h"
#include "tests/support/codec_pictures.h"

namespace macula {
namespace {

constexpr int kWidth_px = 160;  // not a multiple of a macroblock's 64 picture pixels, nor is the height
constexpr int kHeight_px = 100;
constexpr std::uint32_t kSeed = 20261122;

/// Of float arithmetic, relative to an inverse depth.
constexpr float kRounding = 1e-5F;

std::unique_ptr<DepthEncoder> encoder() {
    auto made = make_depth_encoder({.width_px = kWidth_px, .height_px = kHeight_px, .threads = 2});
    if (!made) ADD_FAILURE() << made.error().message;
    return made ? std::move(*made) : nullptr;
}

std::unique_ptr<DepthDecoder> decoder() {
    auto made = make_depth_decoder();
    if (!made) ADD_FAILURE() << made.error().message;
    return made ? std::move(*made) : nullptr;
}

float block_maximum(const InverseDepthImage& full, int block_x, int block_y) {
    float nearest = 0.0F;
    for (int y = 0; y < kDepthBlock_px; ++y) {
        for (int x = 0; x < kDepthBlock_px; ++x) {
            nearest = std::max(nearest, full.at(block_x * kDepthBlock_px + x, block_y * kDepthBlock_px + y));
        }
    }
    return nearest;
}

struct Plane {
    float gradient_x, gradient_y;  // 1/m per pixel
    InverseDepthImage picture;
};

/// A plane whose inverse depth stays between 0 and 1 / near_m over the picture.
Plane random_plane(std::mt19937& random, float near_m) {
    const auto uniform = [&](float low, float high) { return std::uniform_real_distribution(low, high)(random); };
    const float share_x = uniform(0.0F, 1.0F);
    Plane plane{uniform(-1.0F, 1.0F) * share_x / near_m / kWidth_px,
                uniform(-1.0F, 1.0F) * (1.0F - share_x) / near_m / kHeight_px,
                InverseDepthImage(kWidth_px, kHeight_px)};
    const float low = std::min(0.0F, plane.gradient_x * kWidth_px) + std::min(0.0F, plane.gradient_y * kHeight_px);
    const float high = std::max(0.0F, plane.gradient_x * kWidth_px) + std::max(0.0F, plane.gradient_y * kHeight_px);
    const float origin = uniform(-low, 1.0F / near_m - high);
    for (int y = 0; y < kHeight_px; ++y) {
        for (int x = 0; x < kWidth_px; ++x) {
            plane.picture.at(x, y) = std::max(
                0.0F, origin + plane.gradient_x * static_cast<float>(x) + plane.gradient_y * static_cast<float>(y));
        }
    }
    return plane;
}

TEST(DepthCodec, ErrorOfRandomPlanesStaysWithinTheDocumentedBound) {
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    std::mt19937 random(kSeed);
    const auto e = encoder();
    const auto d = decoder();
    float worst_share_of_bound = 0.0F;
    for (int trial = 0; trial < 60; ++trial) {
        const float near_m = std::exp(std::uniform_real_distribution(std::log(0.01F), std::log(10.0F))(random));
        const Plane plane = random_plane(random, near_m);
        const auto encoded = e->encode(plane.picture, near_m, trial % 7 == 3);
        ASSERT_TRUE(encoded) << encoded.error().message;
        EXPECT_EQ(encoded->keyframe, trial == 0 || trial % 7 == 3);
        InverseDepthImage quarter;
        const auto decoded = d->decode(encoded->bytes, near_m, quarter);
        ASSERT_TRUE(decoded) << decoded.error().message;
        ASSERT_EQ(quarter.width_px, kWidth_px / kDepthBlock_px);
        ASSERT_EQ(quarter.height_px, kHeight_px / kDepthBlock_px);

        const float rounding = kRounding / near_m;
        const float quantisation = depth_quantisation_error(near_m) + rounding;
        const float bound = quantisation + depth_block_error(plane.gradient_x, plane.gradient_y);
        float worst_quantisation = 0.0F;
        float worst = 0.0F;
        for (int y = 0; y < kHeight_px; ++y) {
            for (int x = 0; x < kWidth_px; ++x) {
                const int block_x = x / kDepthBlock_px;
                const int block_y = y / kDepthBlock_px;
                const float shown = quarter.at(block_x, block_y);
                worst_quantisation =
                    std::max(worst_quantisation, std::abs(shown - block_maximum(plane.picture, block_x, block_y)));
                worst = std::max(worst, std::abs(shown - plane.picture.at(x, y)));
            }
        }
        EXPECT_LE(worst_quantisation, quantisation) << "near " << near_m;
        EXPECT_LE(worst, bound) << "near " << near_m;
        worst_share_of_bound = std::max(worst_share_of_bound, worst / bound);
    }
    EXPECT_GT(worst_share_of_bound, 0.9F);  // the bound is tight
}

TEST(DepthCodec, ReprojectionErrorIsTheOneOfTheClosedForm) {
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    std::mt19937 random(kSeed);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    for (int trial = 0; trial < 1000; ++trial) {
        const double focal_px = uniform(100.0, 2000.0);
        const double tangent = uniform(-1.5, 1.5);
        const double inverse_depth = uniform(0.1, 10.0);
        const double error = uniform(-0.05, 0.05);
        const double translation_m = uniform(-0.05, 0.05);
        // The point of this pixel, seen from an eye that moved along X; then the point that the wrong depth makes of
        // it.
        const auto lands_px = [&](double inverse) {
            const double z_m = 1.0 / inverse;
            return focal_px * (tangent * z_m - translation_m) / z_m;
        };
        const double moved_px = std::abs(lands_px(inverse_depth) - lands_px(inverse_depth + error));
        EXPECT_NEAR(moved_px,
                    std::abs(reprojection_error_px(static_cast<float>(focal_px), static_cast<float>(translation_m),
                                                   static_cast<float>(error))),
                    1e-4);
    }
}

TEST(DepthCodec, TableOfTheDepthPage) {  // DEPTH.md, Vive, head moved by 20 mm
    constexpr float kFocal_px = 571.04F;
    EXPECT_NEAR(reprojection_error_px(kFocal_px, 0.02F, depth_quantisation_error(0.1F)), 0.224, 5e-4);
    EXPECT_NEAR(reprojection_error_px(kFocal_px, 0.02F, depth_quantisation_error(0.5F)), 0.045, 5e-4);
    // The steepest plane at 1 m: a normal of 45 degrees in the image, inverse depth changing by n / (d f) a pixel.
    const float gradient = std::sqrt(0.5F) / kFocal_px;
    EXPECT_NEAR(reprojection_error_px(kFocal_px, 0.02F, depth_block_error(gradient, -gradient)), 0.085, 5e-4);
}

TEST(DepthCodec, CodesSurviveTheStreamExactly) {
    const float near_m = 0.5F;
    const auto e = encoder();
    const auto d = decoder();
    for (int step = 0; step < 6; ++step) {
        InverseDepthImage full = room_depth(kWidth_px, kHeight_px, step);
        for (int y = 0; y < kHeight_px; ++y) {
            for (int x = 0; x < 40; ++x) {  // unpredictable codes beside the smooth ones
                full.at(x, y) =
                    2.0F *
                    static_cast<float>(hash(static_cast<std::uint32_t>(x + 41 * step), static_cast<std::uint32_t>(y)) >>
                                       8) /
                    16777216.0F;
            }
        }
        const auto encoded = e->encode(full, near_m, false);
        ASSERT_TRUE(encoded) << encoded.error().message;
        InverseDepthImage quarter;
        ASSERT_TRUE(d->decode(encoded->bytes, near_m, quarter));
        for (int y = 0; y < quarter.height_px; ++y) {
            for (int x = 0; x < quarter.width_px; ++x) {
                const std::uint8_t code = depth_code(block_maximum(full, x, y), near_m);
                ASSERT_EQ(quarter.at(x, y), inverse_depth_of(code, near_m)) << x << ", " << y << ", step " << step;
            }
        }
    }
}

TEST(DepthCodec, NothingHitStaysNothingHit) {
    InverseDepthImage full(kWidth_px, kHeight_px, 0.0F);
    full.at(6, 9) = 1.0F;     // one pixel is enough to fill its block
    full.at(20, 20) = -1.0F;  // not traced: no surface
    full.at(30, 30) = std::numeric_limits<float>::quiet_NaN();
    const auto encoded = encoder()->encode(full, 0.25F, false);
    ASSERT_TRUE(encoded);
    InverseDepthImage quarter;
    ASSERT_TRUE(decoder()->decode(encoded->bytes, 0.25F, quarter));
    for (int y = 0; y < quarter.height_px; ++y) {
        for (int x = 0; x < quarter.width_px; ++x) {
            if (x == 1 && y == 2)
                EXPECT_NEAR(quarter.at(x, y), 1.0F, depth_quantisation_error(0.25F));
            else
                EXPECT_EQ(quarter.at(x, y), 0.0F);
        }
    }
}

TEST(DepthCode, LimitsAndRoundTrip) {
    EXPECT_EQ(depth_code(0.0F, 0.1F), 0);
    EXPECT_EQ(depth_code(10.0F, 0.1F), 255);
    EXPECT_EQ(depth_code(1e30F, 0.1F), 255);  // nearer than near
    EXPECT_EQ(depth_code(-1.0F, 0.1F), 0);
    EXPECT_EQ(depth_code(std::numeric_limits<float>::quiet_NaN(), 0.1F), 0);
    EXPECT_EQ(depth_code(1.0F / (0.1F * 511.0F), 0.1F), 0);  // beyond 510 near
    EXPECT_EQ(depth_code(1.0F / (0.1F * 509.0F), 0.1F), 1);
    for (int code = 0; code <= kMaxDepthCode; ++code) {
        const auto c = static_cast<std::uint8_t>(code);
        EXPECT_EQ(depth_code(inverse_depth_of(c, 0.1F), 0.1F), c);
    }
}

TEST(DepthEncoder, RefusesWhatDoesNotFit) {
    for (const auto& [width, height] : {std::pair{164, 100}, std::pair{160, 98}, std::pair{32, 64}, std::pair{0, 0}}) {
        const auto made = make_depth_encoder({.width_px = width, .height_px = height});
        ASSERT_FALSE(made);
        EXPECT_EQ(made.error().code, ErrorCode::option);
        EXPECT_NE(made.error().message.find(std::to_string(width) + "x" + std::to_string(height)), std::string::npos);
    }
    const auto e = encoder();
    EXPECT_FALSE(e->encode(InverseDepthImage(kWidth_px, kHeight_px + 4), 0.1F, false));
    const InverseDepthImage full(kWidth_px, kHeight_px);
    for (const float near_m : {0.0F, -1.0F, std::numeric_limits<float>::infinity()}) {
        EXPECT_FALSE(e->encode(full, near_m, false)) << near_m;
    }
    EXPECT_TRUE(e->encode(full, 0.1F, false));
}

TEST(DepthDecoder, RecoversAtTheNextKeyframe) {
    const auto e = encoder();
    const auto d = decoder();
    InverseDepthImage quarter;
    for (int i = 0; i < 9; ++i) {
        const auto encoded = e->encode(room_depth(kWidth_px, kHeight_px, i), 0.5F, i == 6);
        ASSERT_TRUE(encoded);
        if (i == 3) continue;  // lost
        EXPECT_EQ(d->decode(encoded->bytes, 0.5F, quarter).has_value(), i < 3 || i >= 6) << "unit " << i;
    }
}

}  // namespace
}  // namespace macula
