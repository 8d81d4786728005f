#include "masks/mesh/edge_distance.h"

#include <algorithm>

namespace macula {

EdgeDistance::EdgeDistance(glm::ivec2 size_px, const std::vector<std::uint8_t>& hidden)
    : size_px_(size_px), distance_px_(hidden.size()) {
    for (std::size_t i = 0; i < hidden.size(); ++i) distance_px_[i] = hidden[i] != 0 ? 0 : 255;
    // A pixel is at most one farther than any of its eight neighbours: once from the top left, once from the bottom
    // right (Rosenfeld and Pfaltz 1966), which is exact for this metric.
    const auto lower = [this](int x, int y, int direction) {
        std::uint8_t& here = distance_px_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px_.x) +
                                          static_cast<std::size_t>(x)];
        int nearest = at({x - direction, y});
        for (int dx = -1; dx <= 1; ++dx) nearest = std::min(nearest, at({x + dx, y - direction}));
        here = static_cast<std::uint8_t>(std::min<int>(here, nearest + 1));
    };
    for (int y = 0; y < size_px.y; ++y) {
        for (int x = 0; x < size_px.x; ++x) lower(x, y, 1);
    }
    for (int y = size_px.y - 1; y >= 0; --y) {
        for (int x = size_px.x - 1; x >= 0; --x) lower(x, y, -1);
    }
}

}  // namespace macula
