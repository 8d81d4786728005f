#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace macula {

/// How far each pixel of a window is from the nearest that is not seen: one that the lens hides, or any beyond the
/// window's edge. Distances are the larger of those in x and in y.
class EdgeDistance {
public:
    /// `hidden`: 1 for each hidden pixel, row-major.
    EdgeDistance(glm::ivec2 size_px, const std::vector<std::uint8_t>& hidden);

    /// 0 for a pixel that is not seen, wherever it lies; at most 255.
    [[nodiscard]] int at(glm::ivec2 pixel) const {
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size_px_.x || pixel.y >= size_px_.y) return 0;
        return row(pixel.y)[pixel.x];
    }
    /// Distances of a row of the window.
    [[nodiscard]] const std::uint8_t* row(int y_px) const {
        return distance_px_.data() + static_cast<std::ptrdiff_t>(y_px) * size_px_.x;
    }

private:
    glm::ivec2 size_px_;
    std::vector<std::uint8_t> distance_px_;
};

}  // namespace macula
