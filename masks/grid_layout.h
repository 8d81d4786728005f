#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace macula {

/// Where a pixel column (or row) of the window lies among the columns (or rows) of a grid, packed into 32 bits as the
/// reconstruction kernel reads it.
struct GridPlace {
    std::uint32_t index = 0;   ///< of the last sample at or before the pixel's centre; 15 bits
    std::uint32_t shown = 0;   ///< 0..256: how far the grid shows there; 256 all, 0 not at all
    std::uint32_t weight = 0;  ///< 0..255, in 1/256: of the next sample against this one; 0: that one is not read

    [[nodiscard]] std::uint32_t packed() const { return index << 17U | shown << 8U | weight; }
    static GridPlace unpacked(std::uint32_t bits) { return {bits >> 17U, bits >> 8U & 511U, bits & 255U}; }
};

/// Samples in rows and columns over a part of the window. Sample (column, row) has the address
/// offset + row * count.x + column and lies at first_px + step_px * (column, row), rounded to 1/256 px.
struct RectangularGrid {
    glm::vec2 first_px = glm::vec2(0.5F);  ///< place of sample (0, 0) in the window; pixel centres lie at +.5
    glm::vec2 step_px = glm::vec2(1.0F);   ///< at least 1
    glm::ivec2 count = glm::ivec2(0);      ///< columns and rows; 0: the grid shows nowhere
    std::uint32_t offset = 0;
    std::vector<std::uint32_t> columns;  ///< GridPlace of each pixel column of the window
    std::vector<std::uint32_t> rows;     ///< and of each pixel row. A pixel shows the grid as far as both of them do
};

/// Samples on circles around the gaze. Sample (column u, row v) has the address v * count.x + u and lies at the angle
/// 2 pi (v + phase.y) / count.y, from right to below, and the radius
/// exp(log_radius * ((u + phase.x) / (count.x - 1))^(1 / kLogPolarExponent)) px.
struct LogPolarGrid {
    glm::vec2 centre_px = glm::vec2(0.0F);
    float log_radius = 0.0F;            ///< natural logarithm of the distance of the window's farthest corner
    glm::vec2 phase = glm::vec2(0.0F);  ///< each in [0, 1)
    glm::ivec2 count = glm::ivec2(0);
};

/// Exponent of the kernel function, alpha: 4 is what the authors' study chose (masks/rivals/log_polar_sampler.h).
inline constexpr int kLogPolarExponent = 4;

/// Most grids of one plan.
inline constexpr int kMostGrids = 3;

/// How the samples of a grid plan lie.
struct GridLayout {
    std::vector<RectangularGrid> rectangular;  ///< finest first; each shows over the next, the last one everywhere
    LogPolarGrid log_polar;                    ///< where `rectangular` is empty and its count is not 0

    [[nodiscard]] bool empty() const { return rectangular.empty() && log_polar.count.x == 0; }
};

}  // namespace macula
