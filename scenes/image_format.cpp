#include "scenes/image_format.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace macula {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::array<std::uint8_t, 3> kJpegSignature = {0xFF, 0xD8, 0xFF};
constexpr std::array<std::uint8_t, 4> kExrSignature = {0x76, 0x2F, 0x31, 0x01};

template <std::size_t N>
bool begins_with(Bytes bytes, const std::array<std::uint8_t, N>& signature) {
    return bytes.size() >= N && std::equal(signature.begin(), signature.end(), bytes.begin());
}

bool has_text(Bytes bytes, std::size_t at, std::string_view text) {
    return bytes.size() >= at + text.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

/// Walks the chunks (length, type, data, checksum) to IEND. OpenImageIO 2.4 leaks where libpng runs out of bytes.
bool is_cut_off_png(Bytes bytes) {
    constexpr std::size_t kAroundData = 12;
    Bytes rest = bytes.subspan(kPngSignature.size());
    while (rest.size() >= kAroundData) {
        const std::size_t length = std::size_t{rest[0]} << 24U | std::size_t{rest[1]} << 16U |
                                   std::size_t{rest[2]} << 8U | std::size_t{rest[3]};
        if (length > rest.size() - kAroundData) return true;
        if (std::memcmp(&rest[4], "IEND", 4) == 0) return false;
        rest = rest.subspan(kAroundData + length);
    }
    return true;
}

/// Position of the last marker FF `code`; -1 if there is none.
std::ptrdiff_t last_marker(Bytes bytes, std::uint8_t code) {
    for (std::size_t i = bytes.size(); i >= 2; --i)
        if (bytes[i - 2] == 0xFF && bytes[i - 1] == code) return static_cast<std::ptrdiff_t>(i - 2);
    return -1;
}

/// libjpeg fills what is missing with grey and is content; a whole file has an end marker after its last scan, and
/// entropy-coded data cannot contain either marker.
bool is_cut_off_jpeg(Bytes bytes) {
    constexpr std::uint8_t kStartOfScan = 0xDA;
    constexpr std::uint8_t kEndOfImage = 0xD9;
    return last_marker(bytes, kEndOfImage) <= last_marker(bytes, kStartOfScan);
}

/// Little-endian number.
std::size_t number(Bytes bytes, std::size_t at, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8U | bytes[at + i];
    return value;
}

/// The WebP reader allocates its canvas before it tells the size. RFC 9649: the first chunk is VP8X with the canvas,
/// or VP8 (RFC 6386, 9.1) or VP8L with the image itself.
std::string webp_defect(Bytes bytes, std::size_t max_side_px, std::size_t max_texels) {
    constexpr std::size_t kHeaderBytes = 30;
    constexpr std::size_t kAnimated = 2;
    if (bytes.size() < kHeaderBytes) return "the WebP data is cut off";
    if (has_text(bytes, 12, "VP8X")) {
        if ((bytes[20] & kAnimated) != 0) return "animated WebP images are not supported";
        return size_defect(number(bytes, 24, 3) + 1, number(bytes, 27, 3) + 1, max_side_px, max_texels);
    }
    if (has_text(bytes, 12, "VP8L")) {
        const std::size_t bits = number(bytes, 21, 4);
        return size_defect((bits & 0x3FFFU) + 1, (bits >> 14U & 0x3FFFU) + 1, max_side_px, max_texels);
    }
    return size_defect(number(bytes, 26, 2) & 0x3FFFU, number(bytes, 28, 2) & 0x3FFFU, max_side_px, max_texels);
}

}  // namespace

std::optional<ImageFormat> image_format(Bytes bytes) {
    if (begins_with(bytes, kPngSignature)) return ImageFormat::png;
    if (begins_with(bytes, kJpegSignature)) return ImageFormat::jpeg;
    if (has_text(bytes, 0, "RIFF") && has_text(bytes, 8, "WEBP")) return ImageFormat::webp;
    if (has_text(bytes, 0, "#?RADIANCE") || has_text(bytes, 0, "#?RGBE")) return ImageFormat::hdr;
    if (begins_with(bytes, kExrSignature)) return ImageFormat::exr;
    return std::nullopt;
}

const char* format_name(ImageFormat format) {
    constexpr std::array kNames = {"PNG", "JPEG", "WebP", "HDR", "EXR"};
    return kNames.at(static_cast<std::size_t>(format));
}

const char* reader_name(ImageFormat format) {
    constexpr std::array kNames = {"png", "jpeg", "webp", "hdr", "openexr"};
    return kNames.at(static_cast<std::size_t>(format));
}

std::string image_defect(ImageFormat format, Bytes bytes, std::size_t max_side_px, std::size_t max_texels) {
    if (format == ImageFormat::png && is_cut_off_png(bytes)) return "the PNG data is cut off";
    if (format == ImageFormat::jpeg && is_cut_off_jpeg(bytes)) return "the JPEG data is cut off";
    if (format == ImageFormat::webp) return webp_defect(bytes, max_side_px, max_texels);
    return {};
}

std::string size_defect(std::size_t width_px, std::size_t height_px, std::size_t max_side_px, std::size_t max_texels) {
    if (width_px == 0 || height_px == 0) return "it has no pixels";
    if (width_px <= max_side_px && height_px <= max_side_px && width_px * height_px <= max_texels) return {};
    return "it is too large: " + std::to_string(width_px) + " x " + std::to_string(height_px) + " pixels";
}

}  // namespace macula
