#pragma once

#include <cstdint>
#include <vector>

#include "protocol/base/image.h"

namespace macula::test {

/// Pixels from the centre of the window of SSIM to its edge.
inline constexpr int kSsimReach_px = 5;

/// 1 for each pixel whose window of SSIM leaves the picture or holds a pixel of `hidden`, row-major. `hidden`: 1 for
/// each pixel that does not count, row-major, or empty.
std::vector<std::uint8_t> pixels_without_window(int width_px, int height_px, const std::vector<std::uint8_t>& hidden);

/// Mean structural similarity of the luma of two pictures of one size (Wang, Bovik, Sheikh, Simoncelli, Image Quality
/// Assessment, IEEE TIP 2004: equation 13 with a Gaussian window of standard deviation 1.5 px, K1 .01, K2 .03, L 1)
/// over the pixels that `skipped` is 0 for, which has a value for each pixel; NaN if it is 1 everywhere.
double mean_ssim(const ColorImage& a, const ColorImage& b, const std::vector<std::uint8_t>& skipped);

}  // namespace macula::test
