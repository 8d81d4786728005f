#pragma once

#include <cstddef>
#include <cstdint>

#include "masks/rank_tile.h"
#include "masks/sample_plan.h"
#include "server/render/tracer.h"

namespace macula::test {

/// A plan made straight from the definition in sample_plan.h, independently of the samplers: `level(tile_x, tile_y)`
/// gives the level of each tile, guard ring included, and `traced(x, y)` whether a sampled pixel is traced.
template <class Level, class Traced>
SamplePlan tile_plan(const RankTile& rank_tile, int width_px, int height_px, glm::ivec2 phase_px, Level&& level,
                     Traced&& traced) {
    SamplePlan plan;
    plan.width_px = width_px;
    plan.height_px = height_px;
    plan.phase_px = phase_px;
    plan.origin_px = glm::ivec2(-kTileEdge_px) - phase_px % kTileEdge_px;
    const auto tiles_for = [](int pixels, int origin) {
        return (pixels - origin + kTileEdge_px - 1) / kTileEdge_px + 1;
    };
    plan.tiles_x = tiles_for(width_px, plan.origin_px.x);
    plan.tiles_y = tiles_for(height_px, plan.origin_px.y);
    plan.offset.push_back(0);
    for (int tile_y = 0; tile_y < plan.tiles_y; ++tile_y) {
        for (int tile_x = 0; tile_x < plan.tiles_x; ++tile_x) {
            const auto tile_level = static_cast<std::uint8_t>(level(tile_x, tile_y));
            const int count = kLevelCounts[tile_level];
            const std::uint32_t first = plan.offset.back();
            plan.level.push_back(tile_level);
            plan.offset.push_back(first + static_cast<std::uint32_t>(count));
            plan.position.resize(plan.offset.back());
            plan.incomplete.push_back(0);
            for (int i = 0; i < kTileArea_px; ++i) {
                const int x = plan.origin_px.x + kTileEdge_px * tile_x + i % kTileEdge_px;
                const int y = plan.origin_px.y + kTileEdge_px * tile_y + i / kTileEdge_px;
                const auto on_torus = [](int pixel, int phase) { return (pixel + phase + 64) % RankTile::kEdge_px; };
                const int rank = rank_tile.at(on_torus(x, phase_px.x), on_torus(y, phase_px.y));
                if (rank >= count) continue;
                const std::uint32_t address = first + static_cast<std::uint32_t>(count == kTileArea_px ? i : rank);
                plan.position[address] = {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
                if (traced(x, y)) {
                    plan.trace_order.push_back(address);
                    if (x >= 0 && y >= 0 && x < width_px && y < height_px) ++plan.traced_in_window;
                } else {
                    plan.untraced.push_back(address);
                    plan.incomplete.back() = 1;
                }
            }
        }
    }
    return plan;
}

/// What a tracer would find: `color(x, y)` and `inverse_depth(x, y)` at the plan's traced samples.
template <class Color, class InverseDepth>
Samples sample_picture(const SamplePlan& plan, Color&& color, InverseDepth&& inverse_depth) {
    Samples samples;
    samples.color.assign(plan.address_count(), 0x00ABCDEFU);  // must never be shown
    samples.inverse_depth_per_m.assign(plan.address_count(), -1.0F);
    samples.object_id.assign(plan.address_count(), 0U);
    for (const std::uint32_t address : plan.trace_order) {
        const SamplePosition at = plan.position[address];
        samples.color[address] = color(at.x_px, at.y_px);
        samples.inverse_depth_per_m[address] = inverse_depth(at.x_px, at.y_px);
    }
    return samples;
}

}  // namespace macula::test
