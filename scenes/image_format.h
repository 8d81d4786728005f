#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace macula {

/// Picture files that Macula reads.
enum class ImageFormat : std::uint8_t { png, jpeg, webp, hdr, exr };

/// Recognises a file by its first bytes.
std::optional<ImageFormat> image_format(std::span<const std::uint8_t> bytes);

/// Its name, for messages: "PNG".
const char* format_name(ImageFormat format);

/// What OpenImageIO calls it: "png".
const char* reader_name(ImageFormat format);

/// What is wrong with the outside of a file, in the cases that OpenImageIO's reader takes as good, leaks at or
/// allocates for: PNG and JPEG data cut off, an animated or oversized WebP canvas. Empty if nothing is.
std::string image_defect(ImageFormat format, std::span<const std::uint8_t> bytes, std::size_t max_side_px,
                         std::size_t max_texels);

/// What is wrong with an image of this size; empty if nothing is.
std::string size_defect(std::size_t width_px, std::size_t height_px, std::size_t max_side_px, std::size_t max_texels);

}  // namespace macula
