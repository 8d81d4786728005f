// The sRGB coding against its definition.

#include <gtest/gtest.h>

#include <cmath>

#include "server/kernels/color.h"

namespace macula {
namespace {

double exact_srgb(double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

TEST(ColorKernel, SrgbCodingIsWithinAHundredthOfACode) {
    double worst = 0.0;
    for (int i = 0; i <= 1000000; ++i) {
        const double x = i * 1e-6;
        worst = std::max(worst, std::abs(kernels::srgb_from_linear(static_cast<float>(x)) - exact_srgb(x)));
    }
    EXPECT_LT(worst * 255.0, 0.01);
}

TEST(ColorKernel, CodesSurviveTheRoundTrip) {
    for (unsigned code = 0; code < 256; ++code) {
        const float x = kernels::linear_from_srgb(static_cast<float>(code) / 255.0F);
        EXPECT_EQ(kernels::srgb8_from_linear(glm::vec3(x, 0.0F, 1.0F)), 0xFFFF0000U | code);
    }
}

TEST(ColorKernel, ClampsToTheDisplay) {
    EXPECT_EQ(kernels::srgb8_from_linear(glm::vec3(-1.0F, 7.0F, 1e30F)), 0xFFFFFF00U);
}

}  // namespace
}  // namespace macula
