// Structural similarity against its closed form for constant pictures and against SciPy.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/metrics/ssim.h"

namespace macula::test {
namespace {

Rgba8 grey(int value) {
    return static_cast<Rgba8>(value) * 0x010101U | 0xFF000000U;
}

Rgba8 rgb(int red, int green, int blue) {
    return static_cast<Rgba8>(red % 256) | static_cast<Rgba8>(green % 256) << 8U |
           static_cast<Rgba8>(blue % 256) << 16U | 0xFF000000U;
}

double mean_ssim(const ColorImage& a, const ColorImage& b) {
    return test::mean_ssim(a, b, pixels_without_window(a.width_px, a.height_px, {}));
}

/// Two pictures with structure, 32x24 px, made of integers alone.
ColorImage pattern(bool changed) {
    ColorImage image(32, 24);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 32; ++x) {
            const int red = 7 * x + 13 * y + (changed ? 9 * (x % 5) : 0);
            const int green = x * y + (changed ? y : 0);
            image.at(x, y) = rgb(red, green, 5 * x + 3 * y * y);
        }
    }
    return image;
}

TEST(Ssim, OfConstantPicturesHasNoStructureToDiffer) {
    const double a = 100.0 / 255.0;
    const double b = 140.0 / 255.0;
    const double expected = (2.0 * a * b + 1e-4) / (a * a + b * b + 1e-4);
    EXPECT_NEAR(mean_ssim(ColorImage(40, 30, grey(100)), ColorImage(40, 30, grey(140))), expected, 1e-5);
}

TEST(Ssim, OfAPictureWithItselfIsOne) {
    EXPECT_NEAR(mean_ssim(pattern(false), pattern(false)), 1.0, 1e-6);
    EXPECT_NEAR(mean_ssim(ColorImage(40, 30, grey(255)), ColorImage(40, 30, grey(255))), 1.0, 1e-6);
}

// The values are what SciPy 1.17.1 gives in double precision:
//
//     import numpy as np
//     from scipy.ndimage import gaussian_filter
//     y, x = np.mgrid[0:24, 0:32]
//     luma = lambda r, g, b: (0.2126 * (r % 256) + 0.7152 * (g % 256) + 0.0722 * (b % 256)) / 255
//     a = luma(7 * x + 13 * y, x * y, 5 * x + 3 * y * y)
//     b = luma(7 * x + 13 * y + 9 * (x % 5), x * y + y, 5 * x + 3 * y * y)
//     blur = lambda v: gaussian_filter(v, 1.5, truncate=3.5)
//     ma, mb = blur(a), blur(b)
//     va, vb, c = blur(a * a) - ma * ma, blur(b * b) - mb * mb, blur(a * b) - ma * mb
//     s = (2 * ma * mb + 1e-4) * (2 * c + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4))
//     print(s[5:-5, 5:-5].mean(), s[5:-5, 11:-5].mean())
constexpr double kSciPyAll = 0.636351;
constexpr double kSciPyRight = 0.584402;

TEST(Ssim, EqualsSciPysOnPicturesWithStructure) {
    EXPECT_NEAR(mean_ssim(pattern(false), pattern(true)), kSciPyAll, 2e-6);
    EXPECT_NEAR(mean_ssim(pattern(true), pattern(false)), kSciPyAll, 2e-6);
}

TEST(Ssim, WindowsThatHoldAHiddenPixelDoNotCount) {
    std::vector<std::uint8_t> hidden(std::size_t{32} * 24, 0);
    ColorImage spoiled = pattern(true);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 6; ++x) {
            hidden[y * 32 + x] = 1;
            spoiled.at(x, y) = grey(255);
        }
    }
    const auto skipped = pixels_without_window(32, 24, hidden);
    EXPECT_NEAR(test::mean_ssim(pattern(false), spoiled, skipped), kSciPyRight, 2e-6);
}

TEST(Ssim, WithoutAWholeWindowIsNotANumber) {
    EXPECT_TRUE(std::isnan(mean_ssim(ColorImage(32, 10, grey(9)), ColorImage(32, 10, grey(9)))));
    EXPECT_TRUE(std::isnan(mean_ssim(ColorImage(7, 30, grey(9)), ColorImage(7, 30, grey(9)))));
}

}  // namespace
}  // namespace macula::test
