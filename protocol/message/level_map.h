#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/error.h"

namespace macula {

/// Level maps are a few kilobytes an eye and consist of long runs: they travel as one zstd frame.
std::vector<std::uint8_t> pack_levels(std::span<const std::uint8_t> level);

/// Inverse of pack_levels; never allocates more than `count` bytes for the result.
/// Errors: `protocol` if the frame is damaged or does not hold exactly `count` levels.
Expected<std::vector<std::uint8_t>> unpack_levels(std::span<const std::uint8_t> packed, std::size_t count);

}  // namespace macula
