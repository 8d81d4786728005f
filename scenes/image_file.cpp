#include "scenes/image_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace macula {
namespace {

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

bool is_png(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= kPngSignature.size() &&
           std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin());
}

bool is_jpeg(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

/// Walks the chunks (length, type, data, checksum) to IEND. OpenImageIO 2.4 leaks where libpng runs out of bytes.
bool is_cut_off_png(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kAroundData = 12;
    std::span<const std::uint8_t> rest = bytes.subspan(kPngSignature.size());
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
std::ptrdiff_t last_marker(std::span<const std::uint8_t> bytes, std::uint8_t code) {
    for (std::size_t i = bytes.size(); i >= 2; --i)
        if (bytes[i - 2] == 0xFF && bytes[i - 1] == code) return static_cast<std::ptrdiff_t>(i - 2);
    return -1;
}

/// libjpeg fills what is missing with grey and is content; a whole file has an end marker after its last scan, and
/// entropy-coded data cannot contain either marker.
bool is_cut_off_jpeg(std::span<const std::uint8_t> bytes) {
    constexpr std::uint8_t kStartOfScan = 0xDA;
    constexpr std::uint8_t kEndOfImage = 0xD9;
    return last_marker(bytes, kEndOfImage) <= last_marker(bytes, kStartOfScan);
}

/// Spreads 1 to 4 channels, tightly packed at the front of `rgba`, to four.
void expand_channels(std::vector<std::uint8_t>& rgba, int channels) {
    if (channels == 4) return;
    const auto n = static_cast<std::size_t>(channels);
    for (std::size_t i = rgba.size() / 4; i-- > 0;) {
        std::array<std::uint8_t, 4> texel = {0, 0, 0, 255};
        std::memcpy(texel.data(), &rgba[i * n], n);
        if (channels == 2) texel[3] = texel[1];
        if (channels <= 2) texel[1] = texel[2] = texel[0];
        std::memcpy(&rgba[i * 4], texel.data(), 4);
    }
}

Expected<TextureImage> decode(std::span<const std::uint8_t> bytes, const char* format, std::size_t max_side_px,
                              std::size_t max_texels) {
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input) return fail(ErrorCode::input_file, std::string("OpenImageIO has no reader for ") + format);
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&memory) || !input->open(std::string("memory.") + format, spec, config))
        return fail(ErrorCode::input_file, "it cannot be decoded: " + input->geterror());
    const auto width = static_cast<std::size_t>(std::max(spec.width, 0));
    const auto height = static_cast<std::size_t>(std::max(spec.height, 0));
    if (width == 0 || height == 0 || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > 4)
        return fail(ErrorCode::input_file, "it has no pixels or too many channels");
    if (width > max_side_px || height > max_side_px || width * height > max_texels)
        return fail(ErrorCode::input_file,
                    "it is too large: " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    TextureImage image;
    image.width_px = spec.width;
    image.height_px = spec.height;
    image.rgba.resize(width * height * 4);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, image.rgba.data()))
        return fail(ErrorCode::input_file, "it cannot be decoded: " + input->geterror());
    expand_channels(image.rgba, spec.nchannels);
    return image;
}

}  // namespace

Expected<TextureImage> decode_image(std::span<const std::uint8_t> bytes, std::size_t max_side_px,
                                    std::size_t max_texels) {
    const bool png = is_png(bytes);
    if (!png && !is_jpeg(bytes)) return fail(ErrorCode::input_file, "it is neither PNG nor JPEG");
    if (png && is_cut_off_png(bytes)) return fail(ErrorCode::input_file, "the PNG data is cut off");
    if (!png && is_cut_off_jpeg(bytes)) return fail(ErrorCode::input_file, "the JPEG data is cut off");
    try {
        return decode(bytes, png ? "png" : "jpeg", max_side_px, max_texels);
    } catch (const std::exception& exception) {
        return fail(ErrorCode::input_file, std::string("it cannot be decoded: ") + exception.what());
    }
}

}  // namespace macula
