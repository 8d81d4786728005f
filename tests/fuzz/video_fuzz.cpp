#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"

namespace {

void require(bool promise) {
    if (!promise) std::abort();
}

/// Calls `decode` with each unit: 2 bytes of length, the low byte first, and then the unit. A length beyond the end
/// means what is left.
template <class Decode>
void for_each_unit(std::span<const std::uint8_t> bytes, Decode decode) {
    while (bytes.size() >= 2) {
        const std::size_t wished = bytes[0] | static_cast<std::size_t>(bytes[1]) << 8;
        bytes = bytes.subspan(2);
        const auto unit = bytes.first(wished < bytes.size() ? wished : bytes.size());
        bytes = bytes.subspan(unit.size());
        decode(unit);
    }
}

template <class Picture, class Result>
void check(const Result& result, const Picture& picture) {
    if (!result) {
        require(result.error().code == macula::ErrorCode::protocol);
        return;
    }
    require(picture.width_px >= 1 && picture.width_px <= 8192 && picture.height_px >= 1 && picture.height_px <= 4096);
    require(picture.texels.size() == static_cast<std::size_t>(picture.width_px) * picture.height_px);
}

}  // namespace

/// Any bytes: each access unit gives a picture within the limits or a protocol error. The first byte picks the stream,
/// even for colour and odd for depth.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const std::uint8_t> units(data + 1, size - 1);
    if (data[0] % 2 == 0) {
        const auto decoder = macula::make_video_decoder("h264");
        macula::ColorImage picture;
        for_each_unit(units, [&](auto unit) { check((*decoder)->decode(unit, picture), picture); });
    } else {
        const auto decoder = macula::make_depth_decoder();
        macula::InverseDepthImage quarter;
        for_each_unit(units, [&](auto unit) { check((*decoder)->decode(unit, 0.1F, quarter), quarter); });
    }
    return 0;
}
