#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "masks/levels.h"

namespace macula {

/// Pixel whose centre a ray goes through. May lie outside the window by up to one tile (guard samples).
struct SamplePosition {
    std::int16_t x_px = 0;
    std::int16_t y_px = 0;
};

/// Which pixels of one eye's image get a ray, and where each result lives.
///
/// The image is covered by 16x16 tiles, shifted left and up by `phase_px mod 16`, with a ring of one guard
/// tile around the tiles that touch the window: tile (0, 0) is the top left guard tile and begins at pixel
/// `origin_px`. A tile at level l owns kLevelCounts[l] consecutive addresses from `offset`. Sample k of a
/// tile is the pixel of rank order k (address offset + k), except in a full tile, where the address is
/// offset + 16 y + x. Some addresses are never traced: samples in the hidden area, and guard samples that no
/// visible pixel interpolates.
struct SamplePlan {
    int width_px = 0;
    int height_px = 0;
    glm::ivec2 phase_px = glm::ivec2(0);   ///< shift of the rank tile, each in [0, 64)
    glm::ivec2 origin_px = glm::ivec2(0);  ///< top left pixel of tile (0, 0): -16 - (phase mod 16)
    int tiles_x = 0;                       ///< guard columns included
    int tiles_y = 0;
    std::vector<std::uint8_t> level;         ///< per tile, row-major: index into kLevelCounts
    std::vector<std::uint32_t> offset;       ///< per tile: first address; one more entry holds the total
    std::vector<SamplePosition> position;    ///< per address
    std::vector<std::uint32_t> trace_order;  ///< addresses to trace, each once, in an order coherent for packets
    std::vector<std::uint32_t> untraced;     ///< addresses that are never traced; `trace_order` has the others
    std::vector<std::uint8_t> incomplete;    ///< per tile: 1 if some of its addresses are untraced
    std::uint32_t traced_in_window = 0;      ///< entries of trace_order inside the window

    [[nodiscard]] std::uint32_t address_count() const { return offset.empty() ? 0U : offset.back(); }
    /// Mean distance of the samples around an address, in pixels: 1 at full density, 4 at 16 samples a tile. A plan
    /// without tiles has one sample for each pixel.
    [[nodiscard]] float spacing_px(std::uint32_t address) const {
        if (level.empty()) return 1.0F;
        const SamplePosition p = position[address];
        const int tile = (p.y_px - origin_px.y) / kTileEdge_px * tiles_x + (p.x_px - origin_px.x) / kTileEdge_px;
        return kSpacing_px[level[static_cast<std::size_t>(tile)]];
    }
    /// Share of the window's pixels that get a ray (hidden pixels count as pixels).
    [[nodiscard]] double traced_share() const {
        return static_cast<double>(traced_in_window) / (static_cast<double>(width_px) * height_px);
    }
};

/// What a plan is made for.
struct PlanRequest {
    glm::vec3 gaze_eye = glm::vec3(0.0F, 0.0F, -1.0F);  ///< unit vector in eye space
    glm::ivec2 phase_px = glm::ivec2(0);                ///< each in [0, 64)
};

/// Decides which pixels get a ray, for one eye of one session; keeps state from frame to frame (hysteresis).
/// One thread at a time.
class Sampler {
public:
    Sampler() = default;
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;
    virtual ~Sampler() = default;
    /// Fills `plan`, whose memory is reused.
    virtual void plan(const PlanRequest& request, SamplePlan& plan) = 0;
};

}  // namespace macula
