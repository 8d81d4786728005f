#pragma once

#include <cstdint>
#include <vector>

namespace macula {

/// A picture file in memory ("png", "jpeg" or "webp"), written by OpenImageIO. `values` has `channels` per pixel, row 0
/// on top; with `bits` = 16 each value v becomes 257 v.
std::vector<std::uint8_t> encode_image(const char* format, int width, int height, int channels,
                                       const std::vector<std::uint8_t>& values, int bits = 8);

/// The same of radiance ("hdr" or "openexr"), stored as half or float; HDR has a format of its own.
std::vector<std::uint8_t> encode_radiance(const char* format, int width, int height, int channels,
                                          const std::vector<float>& values, bool half);

}  // namespace macula
