#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace macula {

/// Samples in rows and columns over a part of the window; sample (column, row) has the address
/// offset + row * count.x + column and lies at first_px + step_px * (column, row).
struct RectangularGrid {
    glm::vec2 first_px = glm::vec2(0.5F);  ///< place of sample (0, 0) in the window; pixel centres lie at +.5
    glm::vec2 step_px = glm::vec2(1.0F);
    glm::ivec2 count = glm::ivec2(0);  ///< columns and rows
    std::uint32_t offset = 0;
    /// Rectangle of the window that the grid is shown in, and the width inside its edge over which it fades into the
    /// next grid; 0 is a sharp edge.
    glm::vec2 begin_px = glm::vec2(0.0F);
    glm::vec2 end_px = glm::vec2(0.0F);
    float fade_px = 0.0F;
};

/// Samples on circles around the gaze (Meng et al. 2018, kernel log-polar mapping): sample (column u, row v) of `count`
/// lies at radius exp(log_radius * (u / count.x)^exponent) px and angle 2 pi v / count.y around the centre.
struct LogPolarGrid {
    glm::vec2 centre_px = glm::vec2(0.0F);
    float log_radius = 0.0F;  ///< natural logarithm of the distance of the farthest corner
    float exponent = 4.0F;    ///< alpha of the kernel function
    glm::ivec2 count = glm::ivec2(0);
};

/// How the samples of a grid plan lie.
struct GridLayout {
    std::vector<RectangularGrid> rectangular;  ///< finest first; the last one covers the window
    LogPolarGrid log_polar;                    ///< where `rectangular` is empty and its count is not 0

    [[nodiscard]] bool empty() const { return rectangular.empty() && log_polar.count.x == 0; }
};

}  // namespace macula
