#include "server/render/nearest_offsets.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <tuple>

namespace macula {

std::vector<SamplePosition> nearest_offsets() {
    constexpr int kRadius_px = 16;  // kernels::kNearbyRadius_px
    std::vector<SamplePosition> offsets;
    for (int y = -kRadius_px; y <= kRadius_px; ++y)
        for (int x = -kRadius_px; x <= kRadius_px; ++x)
            if (x * x + y * y <= kRadius_px * kRadius_px)
                offsets.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
    std::sort(offsets.begin(), offsets.end(), [](SamplePosition a, SamplePosition b) {
        const auto key = [](SamplePosition p) {
            return std::tuple(p.x_px * p.x_px + p.y_px * p.y_px, std::abs(p.x_px), p.x_px, p.y_px);
        };
        return key(a) < key(b);
    });
    return offsets;
}

}  // namespace macula
