#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "protocol/base/error.h"
#include "scenes/scene.h"

namespace macula {

/// Decodes a PNG, JPEG or WebP file in memory; channels and their type stay as they are. `srgb` is left false.
/// Errors: `input_file` with the reason, not naming the image: an unknown format, broken or cut off, animated, a side
/// over `max_side_px`, or more than `max_texels`.
Expected<TextureImage> decode_image(std::span<const std::uint8_t> bytes, std::size_t max_side_px,
                                    std::size_t max_texels);

/// Of an environment's texels: so much that sums over the largest map, times whatever reflects them, stay finite. The
/// sun's disc, if an overcast sky is 1, is about 1e6.
inline constexpr float kGreatestRadiance = 1e15F;

/// Decodes a Radiance HDR or OpenEXR file in memory, for an environment: grey or RGB, f16 or f32 as the file has it;
/// alpha and further channels are left out. Values that no light has are repaired: negative ones and NaN become 0,
/// greater ones than kGreatestRadiance become that, or, of f16, infinite ones 65504. Errors: as decode_image.
Expected<TextureImage> decode_environment(std::span<const std::uint8_t> bytes, std::size_t max_side_px,
                                          std::size_t max_texels);

/// Reads such a file, up to 16384 x 8192 pixels. Errors: `input_file`, naming the file.
Expected<TextureImage> load_environment(const std::filesystem::path& file);

}  // namespace macula
