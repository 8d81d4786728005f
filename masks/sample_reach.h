#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "masks/tile_tables.h"

namespace macula {

/// Bounding boxes of the pixels that interpolate a sample; they tell which samples beyond the window's edge are
/// worth a ray.
class SampleReach {
public:
    /// Relative to the sample, edges included, in pixels.
    struct Box {
        std::int8_t left = 0;
        std::int8_t top = 0;
        std::int8_t right = 0;
        std::int8_t bottom = 0;
    };

    explicit SampleReach(const TileTables& tables);

    /// Of the sample of `rank` in a tile on `cell` (4 y + x), among pixels that use `level`, 1..kFullLevel - 1.
    [[nodiscard]] const Box& box(int level, int cell, int rank) const {
        return boxes_[first_[level] + cell * kLevelCounts[level] + rank];
    }

private:
    std::array<int, kLevelTotal> first_{};  ///< per level, index of its first box
    std::vector<Box> boxes_;
};

}  // namespace macula
