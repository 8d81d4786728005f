#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "protocol/base/error.h"

namespace macula {

// What is looked at before a glTF file from outside is given to tinygltf.

/// tinygltf turns `extras` into values recursively; deeper JSON could exhaust its stack.
inline constexpr int kMaxJsonDepth = 128;

/// Greatest nesting of objects and arrays in a text that may be JSON.
inline int json_depth(std::string_view json) {
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

/// Whether bytes begin as a binary glTF file does.
inline bool is_glb(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// The JSON of a GLB container all of whose chunks lie inside the file: tinygltf forgets the second chunk's header when
/// it compares sizes. Errors: `input_file`.
inline Expected<std::string_view> glb_json(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    const auto refuse = [](const char* what) { return fail(ErrorCode::input_file, what); };
    const auto little_endian_32 = [bytes](std::size_t at) {
        return static_cast<std::size_t>(bytes[at]) | static_cast<std::size_t>(bytes[at + 1]) << 8U |
               static_cast<std::size_t>(bytes[at + 2]) << 16U | static_cast<std::size_t>(bytes[at + 3]) << 24U;
    };
    if (bytes.size() < kHeader + kChunkHeader) return refuse("the GLB header is cut off");
    if (little_endian_32(4) != 2) return refuse("the GLB container is not of version 2");
    const std::size_t length = little_endian_32(8);
    if (length > bytes.size() || length < kHeader + kChunkHeader) return refuse("the GLB file is cut off");
    const std::size_t json_bytes = little_endian_32(kHeader);
    if (json_bytes > length - kHeader - kChunkHeader) return refuse("the GLB JSON chunk is cut off");
    const std::size_t second = kHeader + kChunkHeader + json_bytes;
    if (second != length &&
        (length - second < kChunkHeader || little_endian_32(second) > length - second - kChunkHeader))
        return refuse("the GLB binary chunk is cut off");
    return std::string_view(reinterpret_cast<const char*>(bytes.data()) + kHeader + kChunkHeader, json_bytes);
}

}  // namespace macula
