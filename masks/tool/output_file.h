#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/error.h"

namespace macula {

/// Whether a file could be written there, as far as can be told without writing: asked before long work. Errors:
/// `output`, naming the path.
Expected<void> check_writable(const std::string& path);

/// Writes a file that appears whole or not at all (written beside as PATH.partial, renamed). "-" is standard output.
/// Errors: `output`, naming the path.
Expected<void> write_whole(const std::string& path, std::string_view bytes);
Expected<void> write_whole(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace macula
