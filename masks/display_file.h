#pragma once

#include <string>
#include <string_view>

#include "masks/display.h"
#include "protocol/base/error.h"

namespace macula {

/// Parses the JSON of a display file (masks/display.md) and checks it as validate_display does.
/// `source` names the file in messages. Errors: `input_file`, naming file and field.
Expected<Display> parse_display(std::string_view json, const std::string& source);

/// Reads a display file. Errors: `input_file`.
Expected<Display> read_display_file(const std::string& path);

}  // namespace macula
