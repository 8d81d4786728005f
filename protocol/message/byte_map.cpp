#include "protocol/message/byte_map.h"

#include <zstd.h>

namespace macula {

std::vector<std::uint8_t> pack_map(std::span<const std::uint8_t> map) {
    constexpr int kFastest = 1;
    std::vector<std::uint8_t> packed(ZSTD_compressBound(map.size()));
    // Cannot fail: the bound is zstd's own for any input.
    packed.resize(ZSTD_compress(packed.data(), packed.size(), map.data(), map.size(), kFastest));
    return packed;
}

Expected<std::vector<std::uint8_t>> unpack_map(std::span<const std::uint8_t> packed, std::size_t count) {
    std::vector<std::uint8_t> map(count);
    const std::size_t size = ZSTD_decompress(map.data(), map.size(), packed.data(), packed.size());
    if (ZSTD_isError(size) != 0U) {
        return fail(ErrorCode::protocol, std::string("not a zstd frame of the right size: ") + ZSTD_getErrorName(size));
    }
    if (size != count) {
        return fail(ErrorCode::protocol, "holds " + std::to_string(size) + " bytes, not " + std::to_string(count));
    }
    return map;
}

}  // namespace macula
