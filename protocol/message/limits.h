#pragma once

#include <cstddef>
#include <cstdint>

namespace macula {

/// What decode_message accepts; PROTOCOL.md has the same table for people.
inline constexpr std::size_t kMaxName_bytes = 64;      ///< names of clients, displays, presets and codecs
inline constexpr std::size_t kMaxToken_bytes = 128;    ///< Hello.token
inline constexpr std::size_t kMaxText_bytes = 1024;    ///< names of scenes and renderers, reasons
inline constexpr std::size_t kMaxCodecs = 16;          ///< Hello.codecs
inline constexpr std::size_t kMaxOutlinePoints = 256;  ///< Hello.eyes[].visible_outline; 0, or 3 and more

inline constexpr int kMinEyeEdge_px = 64;
inline constexpr int kMaxEyeEdge_px = 4096;
inline constexpr int kEyeEdgeStep_px = 4;
inline constexpr float kMinRefresh_hz = 1.0F;
inline constexpr float kMaxRefresh_hz = 1000.0F;
inline constexpr float kMaxTangent = 10.0F;

inline constexpr int kRankTileStep_px = 16;  ///< rank tiles are squares of whole 16x16 cells
inline constexpr int kMaxRankTile_px = 256;
inline constexpr int kMaxTilesAcross = kMaxEyeEdge_px / 16 + 1;  ///< a shifted grid needs one tile more
inline constexpr int kMaxLevel = 21;                             ///< kFullLevel of masks/levels.h
inline constexpr std::uint32_t kMaxTraced = 2U * kMaxEyeEdge_px * kMaxEyeEdge_px;
inline constexpr float kMinNear_m = 1e-4F;
inline constexpr float kMaxNear_m = 1e4F;

/// Frame.moving; the map's bytes are 0 for what is still and 1..kMaxMovingObjects for these.
inline constexpr std::size_t kMaxMovingObjects = 254;

/// Positions in metres and velocities, per component; entries of moving objects' matrices.
inline constexpr float kMaxMagnitude = 1e6F;

/// Times lie within +-2^60 ns (36 years), so that sums and differences of a few cannot overflow.
inline constexpr std::int64_t kMaxTime_ns = std::int64_t{1} << 60;

/// How far from 1 the length of a direction or quaternion may be; decode_message normalises it.
inline constexpr float kUnitTolerance = 1e-3F;

}  // namespace macula
