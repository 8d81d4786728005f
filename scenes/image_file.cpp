#include "scenes/image_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "scenes/image_format.h"

namespace macula {
namespace {

TexelType texel_type(const OIIO::TypeDesc& type) {
    if (type.basetype == OIIO::TypeDesc::UINT16) return TexelType::u16;
    if (type.basetype == OIIO::TypeDesc::HALF) return TexelType::f16;
    return type.basetype == OIIO::TypeDesc::FLOAT ? TexelType::f32 : TexelType::u8;
}

OIIO::TypeDesc oiio_type(TexelType type) {
    constexpr std::array kTypes = {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16, OIIO::TypeDesc::HALF,
                                   OIIO::TypeDesc::FLOAT};
    return kTypes.at(static_cast<std::size_t>(type));
}

struct DecodeLimits {
    std::size_t side_px;
    std::size_t texels;
    bool environment;  ///< colour only, however many channels there are
};

Expected<TextureImage> decode(std::span<const std::uint8_t> bytes, ImageFormat format, const DecodeLimits& limits,
                              bool straight_alpha = true) {
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
    const char* reader = reader_name(format);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(reader);
    if (!input) return fail(ErrorCode::input_file, std::string("OpenImageIO has no reader for ") + format_name(format));
    OIIO::ImageSpec config;
    if (straight_alpha) config["oiio:UnassociatedAlpha"] = 1;
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&memory) || !input->open(std::string("memory.") + reader, spec, config))
        return fail(ErrorCode::input_file, "it cannot be decoded: " + input->geterror());
    const auto width = static_cast<std::size_t>(std::max(spec.width, 0));
    const auto height = static_cast<std::size_t>(std::max(spec.height, 0));
    if (std::string defect = size_defect(width, height, limits.side_px, limits.texels); !defect.empty())
        return fail(ErrorCode::input_file, std::move(defect));
    if (spec.depth > 1 || spec.nchannels < 1 || (spec.nchannels > 4 && !limits.environment))
        return fail(ErrorCode::input_file, "it is a volume, or has no or too many channels");
    TextureImage image;
    image.width_px = spec.width;
    image.height_px = spec.height;
    image.channels = limits.environment ? (spec.nchannels < 3 ? 1 : 3) : spec.nchannels;
    image.type = texel_type(spec.format);
    image.texels.resize(image.texel_count() * image.texel_bytes());
    if (!input->read_image(0, 0, 0, image.channels, oiio_type(image.type), image.texels.data()))
        return fail(ErrorCode::input_file, "it cannot be decoded: " + input->geterror());
    return image;
}

/// OpenImageIO's third-party readers may throw.
Expected<TextureImage> decode_or_fail(std::span<const std::uint8_t> bytes, ImageFormat format,
                                      const DecodeLimits& limits, bool straight_alpha = true) {
    try {
        return decode(bytes, format, limits, straight_alpha);
    } catch (const std::exception& exception) {
        return fail(ErrorCode::input_file, std::string("it cannot be decoded: ") + exception.what());
    }
}

/// The WebP reader of OpenImageIO 2.4 multiplies alpha into the colours, whatever it is asked for; later ones obey.
/// It has disobeyed if asking makes no difference. Colours under a low alpha lose bits.
Expected<TextureImage> with_straight_alpha(TextureImage image, std::span<const std::uint8_t> bytes,
                                           const DecodeLimits& limits) {
    if (image.channels != 4) return image;
    Expected<TextureImage> multiplied = decode_or_fail(bytes, ImageFormat::webp, limits, false);
    if (!multiplied) return multiplied;
    if (multiplied->texels != image.texels) return image;
    for (std::size_t i = 0; i < image.texels.size(); i += 4) {
        const unsigned alpha = image.texels[i + 3];
        for (std::size_t c = i; c < i + 3 && alpha > 0; ++c)
            image.texels[c] = static_cast<std::uint8_t>(std::min(255U, (image.texels[c] * 255U + alpha / 2) / alpha));
    }
    return image;
}

/// Replaces each value by `repaired(value)`.
template <class Value, class Repaired>
void repair_values(std::vector<std::uint8_t>& texels, Repaired&& repaired) {
    for (std::size_t at = 0; at < texels.size(); at += sizeof(Value)) {
        Value value;
        std::memcpy(&value, &texels[at], sizeof(Value));
        value = repaired(value);
        std::memcpy(&texels[at], &value, sizeof(Value));
    }
}

void repair_radiance(TextureImage& image) {
    if (image.type == TexelType::f32) {
        repair_values<float>(image.texels,
                             [](float value) { return value > 0.0F ? std::min(value, kGreatestRadiance) : 0.0F; });
    } else if (image.type == TexelType::f16) {
        constexpr std::uint16_t kInfinity = 0x7C00;  // above it are the NaNs, and then all that is negative
        repair_values<std::uint16_t>(image.texels, [](std::uint16_t bits) {
            return bits == kInfinity ? static_cast<std::uint16_t>(kInfinity - 1)
                                     : (bits > kInfinity ? std::uint16_t{0} : bits);
        });
    }
}

}  // namespace

Expected<TextureImage> decode_image(std::span<const std::uint8_t> bytes, std::size_t max_side_px,
                                    std::size_t max_texels) {
    const std::optional<ImageFormat> format = image_format(bytes);
    if (!format || *format == ImageFormat::hdr || *format == ImageFormat::exr)
        return fail(ErrorCode::input_file, "it is neither PNG nor JPEG nor WebP");
    if (std::string defect = image_defect(*format, bytes, max_side_px, max_texels); !defect.empty())
        return fail(ErrorCode::input_file, std::move(defect));
    const DecodeLimits limits{max_side_px, max_texels, false};
    Expected<TextureImage> image = decode_or_fail(bytes, *format, limits);
    if (!image || *format != ImageFormat::webp) return image;
    return with_straight_alpha(*std::move(image), bytes, limits);
}

Expected<TextureImage> decode_environment(std::span<const std::uint8_t> bytes, std::size_t max_side_px,
                                          std::size_t max_texels) {
    const std::optional<ImageFormat> format = image_format(bytes);
    if (format != ImageFormat::hdr && format != ImageFormat::exr)
        return fail(ErrorCode::input_file, "it is neither HDR nor EXR");
    Expected<TextureImage> image = decode_or_fail(bytes, *format, {max_side_px, max_texels, true});
    if (image) repair_radiance(*image);
    return image;
}

Expected<TextureImage> load_environment(const std::filesystem::path& file) {
    constexpr std::size_t kMaxSide_px = std::size_t{1} << 14U;
    constexpr std::size_t kMaxTexels = kMaxSide_px * kMaxSide_px / 2;
    constexpr std::uint64_t kMaxBytes = kMaxTexels * 16;
    const std::string name = file.string();
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) return fail(ErrorCode::input_file, "cannot open " + name + ": " + error.message());
    if (size > kMaxBytes)
        return fail(ErrorCode::input_file, name + " is larger than " + std::to_string(kMaxBytes) + " bytes");
    std::vector<std::uint8_t> bytes(size);
    if (OIIO::Filesystem::read_bytes(name, bytes.data(), bytes.size()) != bytes.size())
        return fail(ErrorCode::input_file, "cannot read " + name);
    Expected<TextureImage> image = decode_environment(bytes, kMaxSide_px, kMaxTexels);
    if (!image) return fail(ErrorCode::input_file, name + ": " + image.error().message);
    image->name = name;
    return image;
}

}  // namespace macula
