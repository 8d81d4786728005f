#pragma once

#include <array>
#include <cstdint>

namespace macula {

/// Edge of a screen tile.
inline constexpr int kTileEdge_px = 16;
inline constexpr int kTileArea_px = kTileEdge_px * kTileEdge_px;

/// Samples in a 16x16 tile at each level, sparse to dense; level 0 is an untraced tile (hidden area). Nested:
/// a denser level holds every sample of a sparser one.
inline constexpr std::array<std::uint16_t, 22> kLevelCounts = {0,  4,  5,  6,  8,  10,  12,  16,  20,  24,  32,
                                                               40, 48, 64, 80, 96, 112, 128, 160, 192, 224, 256};
inline constexpr int kLevelTotal = static_cast<int>(kLevelCounts.size());
inline constexpr int kFullLevel = kLevelTotal - 1;

}  // namespace macula
