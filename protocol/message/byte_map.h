#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/error.h"

namespace macula {

/// Maps of one byte for each tile or block of a picture consist of long runs: they travel as one zstd frame.
std::vector<std::uint8_t> pack_map(std::span<const std::uint8_t> map);

/// Inverse of pack_map; never allocates more than `count` bytes for the result.
/// Errors: `protocol` if the frame is damaged or does not hold exactly `count` bytes.
Expected<std::vector<std::uint8_t>> unpack_map(std::span<const std::uint8_t> packed, std::size_t count);

}  // namespace macula
