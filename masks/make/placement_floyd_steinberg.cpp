#include <algorithm>
#include <random>

#include "masks/make/placement.h"

namespace macula {
namespace {

/// The error field needs some way to settle, and loses what crosses a border: so much more is drawn, and cut off.
constexpr int kMargin_px = 64;
/// Width of the threshold's noise: enough to break up the chains of sites that plain error diffusion draws at low
/// densities, and little enough to keep the spectrum blue.
constexpr float kThresholdNoise = 0.5F;

}  // namespace

Sites place_floyd_steinberg(const DensityMap& density, std::uint32_t seed) {
    const int width = density.width_px;
    const int height = density.height_px;
    std::minstd_rand random(seed);
    constexpr float kNoisePerRandom = kThresholdNoise / static_cast<float>(std::minstd_rand::max());

    Sites sites(density.density.size());
    // With an element more on both sides, so that the diffusion needs no look at the borders.
    std::vector<float> error(static_cast<std::size_t>(width) + 2 * kMargin_px + 2);
    std::vector<float> error_below(error.size());
    for (int y = -kMargin_px; y < height; ++y) {
        const bool leftward = y % 2 != 0;
        const int step = leftward ? -1 : 1;
        const int begin = leftward ? width + kMargin_px - 1 : -kMargin_px;
        const int end = leftward ? -kMargin_px - 1 : width + kMargin_px;
        for (int x = begin; x != end; x += step) {
            const float wished = density.at(std::clamp(x, 0, width - 1), std::max(y, 0));
            float* here = &error[x + kMargin_px + 1];
            float* below = &error_below[x + kMargin_px + 1];
            const float value = wished + *here;
            const float noise = kNoisePerRandom * static_cast<float>(random()) - 0.5F * kThresholdNoise;
            const bool site = wished >= 1.0F || value > 0.5F + noise;
            const float rest = (value - (site ? 1.0F : 0.0F)) / 16.0F;
            here[step] += 7.0F * rest;
            below[-step] += 3.0F * rest;
            below[0] += 5.0F * rest;
            below[step] += rest;
            if (site && y >= 0 && x >= 0 && x < width) sites[static_cast<std::size_t>(y) * width + x] = 1;
        }
        error.swap(error_below);
        std::fill(error_below.begin(), error_below.end(), 0.0F);
    }
    return sites;
}

}  // namespace macula
