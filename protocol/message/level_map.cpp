#include "protocol/message/level_map.h"

#include <zstd.h>

namespace macula {

std::vector<std::uint8_t> pack_levels(std::span<const std::uint8_t> level) {
    constexpr int kFastest = 1;
    std::vector<std::uint8_t> packed(ZSTD_compressBound(level.size()));
    // Cannot fail: the bound is zstd's own for any input.
    packed.resize(ZSTD_compress(packed.data(), packed.size(), level.data(), level.size(), kFastest));
    return packed;
}

Expected<std::vector<std::uint8_t>> unpack_levels(std::span<const std::uint8_t> packed, std::size_t count) {
    std::vector<std::uint8_t> level(count);
    const std::size_t size = ZSTD_decompress(level.data(), level.size(), packed.data(), packed.size());
    if (ZSTD_isError(size) != 0U) {
        return fail(ErrorCode::protocol, std::string("not a zstd frame of the right size: ") + ZSTD_getErrorName(size));
    }
    if (size != count) {
        return fail(ErrorCode::protocol, "holds " + std::to_string(size) + " levels, not " + std::to_string(count));
    }
    return level;
}

}  // namespace macula
