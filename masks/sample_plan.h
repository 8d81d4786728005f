#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "masks/grid_layout.h"
#include "masks/levels.h"

namespace macula {

class MeshTable;

/// Pixel that a ray goes through, at its centre unless the plan says where. May lie outside the window (guard samples):
/// of a tile plan by up to two tiles, of a mesh by up to kMeshReach_px.
struct SamplePosition {
    std::int16_t x_px = 0;
    std::int16_t y_px = 0;
};

/// Where in its pixel a sample lies, in 1/256 of a pixel from the left and upper edge; 128 is the centre.
struct PlaceInPixel {
    std::uint8_t x = 128;
    std::uint8_t y = 128;
};

/// Which pixels of one eye's image get a ray, and where each result lives.
///
/// All samplers fill the first part: samples are numbered by addresses. What a reconstruction needs beside it depends
/// on the kind of sampler, and only the fields of that kind are filled: a tile plan has levels, a mesh plan a mesh, a
/// grid plan grids.
///
/// Tiles: the image is covered by 16x16 tiles, shifted left and up by `phase_px mod 16`, with a ring of one guard
/// tile around the tiles that touch the window: tile (0, 0) is the top left guard tile and begins at pixel
/// `origin_px`. A tile at level l owns kLevelCounts[l] consecutive addresses from `offset`. Sample k of a
/// tile is the pixel of rank order k (address offset + k), except in a full tile, where the address is
/// offset + 16 y + x. Some addresses are never traced: samples in the hidden area, and guard samples that no
/// visible pixel interpolates.
///
/// Mesh: the samples are sites of a triangulated mask that was moved to the gaze. All sites that a visible pixel
/// interpolates (MeshPixel) are traced.
///
/// Grids: the samples lie on regular grids, in general between pixel centres.
struct SamplePlan {
    int width_px = 0;
    int height_px = 0;
    std::vector<SamplePosition> position;  ///< per address
    std::vector<PlaceInPixel> place;       ///< per address; empty: all lie at the centre of their pixel
    std::vector<float> spacing;            ///< per address, mean distance of the samples there in pixels; empty: levels
    std::vector<std::uint32_t> trace_order;  ///< addresses to trace, each once, in an order coherent for packets
    std::vector<std::uint32_t> untraced;     ///< addresses that are never traced; `trace_order` has the others
    std::uint32_t traced_in_window = 0;      ///< entries of trace_order inside the window
    /// 1 for each pixel of the window that the lens hides, row-major; null: all are visible.
    std::shared_ptr<const std::vector<std::uint8_t>> hidden;

    // Tiles.
    glm::ivec2 phase_px = glm::ivec2(0);   ///< shift of the rank tile, each in [0, 64)
    glm::ivec2 origin_px = glm::ivec2(0);  ///< top left pixel of tile (0, 0): -16 - (phase mod 16)
    int tiles_x = 0;                       ///< guard columns included
    int tiles_y = 0;
    std::vector<std::uint8_t> level;       ///< per tile, row-major: index into kLevelCounts
    std::vector<std::uint32_t> offset;     ///< per tile: first address; one more entry holds the total
    std::vector<std::uint8_t> incomplete;  ///< per tile: 1 if some of its addresses are untraced

    // Mesh.
    std::shared_ptr<const MeshTable> mesh;
    glm::ivec2 mesh_origin_px = glm::ivec2(0);  ///< pixel of the mask at the window's top left pixel

    // Grids.
    GridLayout grids;

    [[nodiscard]] std::uint32_t address_count() const {
        return offset.empty() ? static_cast<std::uint32_t>(position.size()) : offset.back();
    }
    [[nodiscard]] bool has_tiles() const { return !level.empty(); }
    [[nodiscard]] bool has_mesh() const { return mesh != nullptr; }
    [[nodiscard]] bool has_grids() const { return !grids.empty(); }
    /// Mean distance of the samples around an address, in pixels: 1 at full density, 4 at 16 samples a tile. A plan
    /// without tiles has one sample for each pixel.
    [[nodiscard]] float spacing_px(std::uint32_t address) const {
        if (!spacing.empty()) return spacing[address];
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
