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

/// Mean distance of the samples at each level: 16 / sqrt(count).
inline constexpr std::array<float, 22> kSpacing_px = {16.0F,  8.0F,   7.155F, 6.532F, 5.657F, 5.06F, 4.619F, 4.0F,
                                                      3.578F, 3.266F, 2.828F, 2.53F,  2.309F, 2.0F,  1.789F, 1.633F,
                                                      1.512F, 1.414F, 1.265F, 1.155F, 1.069F, 1.0F};

}  // namespace macula
