#pragma once

#include <string>
#include <vector>

#include "protocol/base/error.h"
#include "protocol/base/image.h"

namespace macula::test {

/// Writes pictures of one size as a NumPy array (format 1.0) of bytes, [frame][row][column][red, green, blue], for
/// metrics that other programs compute. Errors: `output`, naming the file.
Expected<void> write_npy(const std::string& path, const std::vector<ColorImage>& frames);

}  // namespace macula::test
