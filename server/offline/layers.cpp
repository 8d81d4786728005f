#include "server/offline/layers.h"

#include <array>
#include <limits>
#include <vector>

#include "server/kernels/color.h"

namespace macula {
namespace {

float depth_of(float inverse_depth_per_m) {
    return inverse_depth_per_m > 0.0F ? 1.0F / inverse_depth_per_m : std::numeric_limits<float>::infinity();
}

/// What needs no interpolation.
void scatter(const Shot& shot, Layers& layers) {
    const SamplePlan& plan = shot.plan;
    for (const std::uint32_t address : plan.trace_order) {
        const SamplePosition at = plan.position[address];
        if (at.x_px < 0 || at.y_px < 0 || at.x_px >= plan.width_px || at.y_px >= plan.height_px) continue;
        layers.radiance.at(at.x_px, at.y_px) = shot.samples.radiance[address];
        layers.color.at(at.x_px, at.y_px) = shot.samples.color[address];
        layers.depth_m.at(at.x_px, at.y_px) = depth_of(shot.samples.inverse_depth_per_m[address]);
        layers.object.at(at.x_px, at.y_px) = shot.samples.object_id[address];
        layers.traced.at(at.x_px, at.y_px) = 1;
    }
}

/// Samples of each pixel's 16x16 tile: by the plan's levels, or where it has none, as many of its pixels as were
/// traced.
void count_in_tiles(const SamplePlan& plan, Layers& layers) {
    const glm::ivec2 origin_px = plan.has_tiles() ? plan.origin_px : glm::ivec2(0);
    const int tiles_x = plan.has_tiles() ? plan.tiles_x : (plan.width_px + kTileEdge_px - 1) / kTileEdge_px;
    const auto tile_of = [&](int x, int y) {
        const glm::ivec2 tile = (glm::ivec2(x, y) - origin_px) / kTileEdge_px;
        return static_cast<std::size_t>(tile.y) * tiles_x + tile.x;
    };
    std::vector<std::uint16_t> count(tile_of(plan.width_px - 1, plan.height_px - 1) + 1, 0);
    for (int y = 0; y < plan.height_px; ++y) {
        for (int x = 0; x < plan.width_px; ++x) count[tile_of(x, y)] += layers.traced.at(x, y);
    }
    for (int y = 0; y < plan.height_px; ++y) {
        for (int x = 0; x < plan.width_px; ++x) {
            const std::size_t tile = tile_of(x, y);
            layers.tile_samples.at(x, y) = plan.has_tiles() ? kLevelCounts[plan.level[tile]] : count[tile];
        }
    }
}

std::array<float, 256> make_decode_table() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = kernels::linear_from_srgb(static_cast<float>(i) / 255.0F);
    return table;
}

Expected<void> interpolate(const Shot& shot, Reconstructor& reconstructor, float exposure, Layers& layers) {
    InverseDepthImage inverse_depth(shot.plan.width_px, shot.plan.height_px);
    const auto stride = static_cast<std::size_t>(shot.plan.width_px);
    auto done = reconstructor.reconstruct(shot.plan, shot.samples,
                                          {layers.color.texels.data(), stride, inverse_depth.texels.data(), stride});
    if (!done) return done;
    const std::array<float, 256> decode = make_decode_table();
    for (std::size_t i = 0; i < layers.color.texels.size(); ++i) {
        const Rgba8 c = layers.color.texels[i];
        layers.radiance.texels[i] =
            glm::vec3(decode[c & 255U], decode[c >> 8U & 255U], decode[c >> 16U & 255U]) / exposure;
        layers.depth_m.texels[i] = depth_of(inverse_depth.texels[i]);
    }
    return {};
}

}  // namespace

Expected<Layers> make_layers(const Shot& shot, Reconstructor* reconstructor, float exposure) {
    const int width_px = shot.plan.width_px;
    const int height_px = shot.plan.height_px;
    Layers layers;
    layers.radiance = {width_px, height_px, glm::vec3(0.0F)};
    layers.color = {width_px, height_px, 0xFF000000U};
    layers.depth_m = {width_px, height_px, std::numeric_limits<float>::infinity()};
    layers.object = {width_px, height_px};
    layers.traced = {width_px, height_px};
    layers.tile_samples = {width_px, height_px};
    scatter(shot, layers);
    count_in_tiles(shot.plan, layers);
    if (reconstructor == nullptr) return layers;
    if (auto done = interpolate(shot, *reconstructor, exposure, layers); !done) return tl::unexpected(done.error());
    return layers;
}

}  // namespace macula
