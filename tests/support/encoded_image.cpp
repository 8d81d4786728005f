#include "tests/support/encoded_image.h"

#include <memory>
#include <stdexcept>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace macula {

namespace {

std::vector<std::uint8_t> encode(const char* format, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
                                 const void* values) {
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output || !output->set_ioproxy(&memory) || !output->open(std::string("memory.") + format, spec) ||
        !output->write_image(type, values) || !output->close())
        throw std::runtime_error("cannot encode the test image");
    return file;
}

}  // namespace

std::vector<std::uint8_t> encode_image(const char* format, int width, int height, int channels,
                                       const std::vector<std::uint8_t>& values, int bits) {
    OIIO::ImageSpec spec(width, height, channels, bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    spec["Compression"] = "jpeg:100";
    if (channels == 2 || channels == 4) spec.alpha_channel = channels - 1;
    return encode(format, spec, OIIO::TypeDesc::UINT8, values.data());
}

std::vector<std::uint8_t> encode_radiance(const char* format, int width, int height, int channels,
                                          const std::vector<float>& values, bool half) {
    const OIIO::ImageSpec spec(width, height, channels, half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    return encode(format, spec, OIIO::TypeDesc::FLOAT, values.data());
}

}  // namespace macula
