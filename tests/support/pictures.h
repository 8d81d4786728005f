#pragma once

#include <string>

#include "protocol/base/error.h"
#include "protocol/base/image.h"

namespace macula::test {

/// Errors: `output` with OpenImageIO's message.
Expected<void> write_png(const std::string& path, const ColorImage& image);
/// Errors: `input_file` with OpenImageIO's message.
Expected<ColorImage> read_png(const std::string& path);

/// How two pictures of the same size differ, in 1/255 of sRGB-coded channels.
struct PictureDifference {
    double largest_local = 0.0;  ///< largest absolute difference of means over 8x8 blocks, any channel
    double signed_mean = 0.0;    ///< largest absolute signed mean over the picture, any channel
    ColorImage picture;          ///< absolute difference times 8
};
PictureDifference compare(const ColorImage& a, const ColorImage& b);

}  // namespace macula::test
