#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/base/error.h"
#include "scenes/scene.h"

namespace macula {

/// Decodes a PNG or JPEG file in memory to RGBA8; grey becomes RGB, a missing alpha 255. `srgb` is left false.
/// Errors: `input_file` with the reason, not naming the image: an unknown format, broken or cut off, a side over
/// `max_side_px`, or more than `max_texels`.
Expected<TextureImage> decode_image(std::span<const std::uint8_t> bytes, std::size_t max_side_px,
                                    std::size_t max_texels);

}  // namespace macula
