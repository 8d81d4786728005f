#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "masks/sample_plan.h"

namespace macula::test {

/// A plan that traces the pixels for which `wanted(x, y)` holds: raster addresses of the whole image, tiles of
/// full level without guard, traced tile by tile and in 4x4 blocks inside them.
template <class Wanted>
SamplePlan raster_plan(int width_px, int height_px, Wanted&& wanted) {
    SamplePlan plan;
    plan.width_px = width_px;
    plan.height_px = height_px;
    const auto total = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    plan.offset = {0, static_cast<std::uint32_t>(total)};
    plan.position.resize(total);
    for (int y0 = 0; y0 < height_px; y0 += kTileEdge_px) {
        for (int x0 = 0; x0 < width_px; x0 += kTileEdge_px) {
            for (int i = 0; i < kTileArea_px; ++i) {
                const int block = i / 16;
                const int x = x0 + 4 * (block % 4) + i % 4;
                const int y = y0 + 4 * (block / 4) + i % 16 / 4;
                if (x >= width_px || y >= height_px) continue;
                const auto address = static_cast<std::uint32_t>(y * width_px + x);
                plan.position[address] = {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
                (wanted(x, y) ? plan.trace_order : plan.untraced).push_back(address);
            }
        }
    }
    plan.traced_in_window = static_cast<std::uint32_t>(plan.trace_order.size());
    return plan;
}

/// A plan of every pixel; addresses are y * width + x.
inline SamplePlan full_plan(int width_px, int height_px) {
    return raster_plan(width_px, height_px, [](int, int) { return true; });
}

}  // namespace macula::test
