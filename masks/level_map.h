#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/levels.h"

namespace macula {

/// The tiles that touch an image when the tile grid is shifted left and up by `phase_px mod 16`.
struct TileGrid {
    glm::ivec2 origin_px;  ///< top left pixel of tile (0, 0): -(phase mod 16)
    glm::ivec2 tiles;      ///< columns and rows

    TileGrid(glm::ivec2 size_px, glm::ivec2 phase_px)
        : origin_px(-(phase_px % kTileEdge_px)), tiles((size_px - origin_px + kTileEdge_px - 1) / kTileEdge_px) {}
};

/// An acuity law on one eye's display, quantised to levels: the level of a tile is the one whose density is the
/// nearest, in log, to what the law needs at the tile's centre.
class LevelMap {
public:
    /// `hysteresis`: a tile drops to a sparser level only when the need falls below this part of the boundary
    /// between the two; 1 is none.
    LevelMap(const Display& display, Eye eye, const AcuityLaw& law, double hysteresis = 1.0);

    /// Changes the law's stretch, at no cost.
    void set_stretch(double stretch);

    /// Computes the levels 1..kFullLevel of the grid's tiles, row-major, for a gaze in eye space. `levels` holds the
    /// levels of the frame before, rows `stride` apart, or zeros; it is overwritten.
    void update(const TileGrid& grid, const glm::vec3& gaze_eye, std::uint8_t* levels, int stride);

private:
    void update_row(const TileGrid& grid, int row, const glm::vec3& gaze_eye, std::uint8_t* levels);

    glm::vec2 tangent_at_zero_px_;
    glm::vec2 tangent_per_px_;
    double full_acuity_deg_;
    float steps_per_rad_ = 0.0F;                ///< from eccentricity to steps of the table
    float full_steps_ = 0.0F;                   ///< steps of full acuity
    std::vector<float> spacing_at_;             ///< table: spacing that the law allows; see the .cpp
    std::vector<float> spacing_rise_;           ///< to the next entry
    std::array<float, kFullLevel - 1> rise_{};  ///< below spacing [l - 1] the need is above level l
    std::array<float, kFullLevel - 1> keep_{};  ///< up to spacing [l - 1] a tile above level l stays above
    std::vector<float> steps_;                  ///< of one row, scratch, as those that follow
    std::vector<float> spacing_;
    std::vector<std::int32_t> risen_;
    std::vector<std::int32_t> kept_;
};

}  // namespace macula
