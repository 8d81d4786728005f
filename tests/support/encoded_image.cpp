#include "tests/support/encoded_image.h"

#include <memory>
#include <stdexcept>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace macula {

std::vector<std::uint8_t> encode_image(const char* format, int width, int height, int channels,
                                       const std::vector<std::uint8_t>& values, int bits) {
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    OIIO::ImageSpec spec(width, height, channels, bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    spec["Compression"] = "jpeg:100";
    if (channels == 2 || channels == 4) spec.alpha_channel = channels - 1;
    if (!output || !output->set_ioproxy(&memory) || !output->open(std::string("memory.") + format, spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, values.data()) || !output->close())
        throw std::runtime_error("cannot encode the test image");
    return file;
}

}  // namespace macula
