#include "server/render/nearest_columns.h"

#include <algorithm>
#include <cstddef>

#include "server/render/parallel_ranges.h"

namespace macula {

namespace {

constexpr int kColumnGrain = 128;
constexpr int kNoSample = 65535;

}  // namespace

void NearestColumns::find(const SampleImage& image) {
    above.resize(image.color.size());
    below.resize(image.color.size());
    const auto stride = static_cast<std::size_t>(image.width_px);
    // Row by row for many columns at a time, so that memory is read in order and vectors are full.
    parallel_ranges(0, image.width_px, kColumnGrain, [&](int first, int last) {
        std::vector<std::uint16_t> distance(static_cast<std::size_t>(last - first), kNoSample);
        const auto columns = distance.size();
        for (int y = 0; y < image.height_px; ++y) {
            const std::size_t row = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(first);
            for (std::size_t i = 0; i < columns; ++i) {
                const int farther = std::min(distance[i] + 1, kNoSample);
                distance[i] =
                    image.inverse_depth_per_m[row + i] < 0.0F ? static_cast<std::uint16_t>(farther) : std::uint16_t{0};
                above[row + i] = distance[i];
            }
        }
        std::fill(distance.begin(), distance.end(), static_cast<std::uint16_t>(kNoSample));
        for (int y = image.height_px - 1; y >= 0; --y) {
            const std::size_t row = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(first);
            for (std::size_t i = 0; i < columns; ++i) {
                below[row + i] = distance[i];
                const int farther = std::min(distance[i] + 1, kNoSample);
                distance[i] =
                    image.inverse_depth_per_m[row + i] < 0.0F ? static_cast<std::uint16_t>(farther) : std::uint16_t{1};
            }
        }
    });
}

}  // namespace macula
