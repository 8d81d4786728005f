#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace macula {

/// How far each pixel is from the edge of what is seen: of the window without the pixels that the lens hides. Distances
/// are the larger of those in x and in y.
class EdgeDistance {
public:
    /// Pixels may be asked for that lie at most so far beyond the window.
    static constexpr int kMargin_px = 128;

    /// `hidden`: 1 for each hidden pixel of the window, row-major.
    EdgeDistance(glm::ivec2 size_px, const std::vector<std::uint8_t>& hidden);

    /// Of a pixel that is seen, the distance to the nearest that is not, 1 or more; of another, 1 less the distance to
    /// the nearest that is, 0 or less. Within -127..127: what is farther has these values.
    [[nodiscard]] int at(glm::ivec2 pixel) const { return signed_px_[index(pixel)]; }
    /// The same for at({0, y}) and on, rows `stride()` apart.
    [[nodiscard]] const std::int8_t* row(int y_px) const { return signed_px_.data() + index({0, y_px}); }
    [[nodiscard]] int stride() const { return stride_; }
    /// Of a pixel among all that may be asked for, `size()` in number.
    [[nodiscard]] std::size_t index(glm::ivec2 pixel) const {
        return static_cast<std::size_t>(pixel.y + kMargin_px) * static_cast<std::size_t>(stride_) +
               static_cast<std::size_t>(pixel.x + kMargin_px);
    }
    [[nodiscard]] std::size_t size() const { return signed_px_.size(); }

private:
    int stride_;
    std::vector<std::int8_t> signed_px_;  ///< window and margin around it, row-major
};

}  // namespace macula
