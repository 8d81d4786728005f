#pragma once

#include <string>

#include <OpenImageIO/imageio.h>

#include "protocol/base/error.h"

namespace macula {

/// Writes a picture by OpenImageIO; `pixels` are packed as the spec says. A file that could not be written whole is
/// taken away. Errors: `output`, naming the file.
Expected<void> write_picture(const std::string& path, const OIIO::ImageSpec& spec, const void* pixels);

}  // namespace macula
