#include "masks/mesh/edge_distance.h"

#include <algorithm>

namespace macula {
namespace {

constexpr int kFar_px = 127;

}  // namespace

EdgeDistance::EdgeDistance(glm::ivec2 size_px, const std::vector<std::uint8_t>& hidden)
    : stride_(size_px.x + 2 * kMargin_px),
      signed_px_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(size_px.y + 2 * kMargin_px), -kFar_px) {
    for (int y = 0; y < size_px.y; ++y) {
        const std::uint8_t* from = &hidden[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px.x)];
        std::int8_t* to = &signed_px_[index({0, y})];
        for (int x = 0; x < size_px.x; ++x) to[x] = from[x] != 0 ? -kFar_px : kFar_px;
    }
    // A pixel is at most one farther than any of its eight neighbours: once from the top left, once from the bottom
    // right (Rosenfeld and Pfaltz 1966), which is exact for this metric. The outermost pixels are as far as can be.
    const auto come_nearer = [this](int x, int y, int direction) {
        std::int8_t& here = signed_px_[index({x, y})];
        const std::int8_t* const beside = &here - direction;
        const std::int8_t* const before = beside - direction * (stride_ - 1);
        if (here > 0) {
            const int nearest = std::min({beside[0], before[-1], before[0], before[1]});
            here = static_cast<std::int8_t>(std::min<int>(here, std::max(nearest, 0) + 1));
        } else {
            const int nearest = std::max({beside[0], before[-1], before[0], before[1]});
            here = static_cast<std::int8_t>(std::max<int>(here, std::min(nearest, 1) - 1));
        }
    };
    const glm::ivec2 first(1 - kMargin_px);
    const glm::ivec2 last = size_px + kMargin_px - 2;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) come_nearer(x, y, 1);
    }
    for (int y = last.y; y >= first.y; --y) {
        for (int x = last.x; x >= first.x; --x) come_nearer(x, y, -1);
    }
}

}  // namespace macula
