#include "server/offline/picture_file.h"

#include <exception>
#include <filesystem>
#include <memory>

namespace macula {
namespace {

/// What went wrong; empty if nothing did.
std::string try_to_write(const std::string& path, const OIIO::ImageSpec& spec, const void* pixels) {
    try {
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path);
        if (!output) return OIIO::geterror();
        const bool packed = !spec.channelformats.empty();
        if (!output->open(path, spec) || !output->write_image(packed ? OIIO::TypeDesc::UNKNOWN : spec.format, pixels) ||
            !output->close())
            return output->geterror();
        return {};
    } catch (const std::exception& exception) {
        return exception.what();
    }
}

}  // namespace

Expected<void> write_picture(const std::string& path, const OIIO::ImageSpec& spec, const void* pixels) {
    const std::string problem = try_to_write(path, spec, pixels);
    if (problem.empty()) return {};
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return fail(ErrorCode::output, path + ": it cannot be written: " + problem);
}

}  // namespace macula
