#include "server/render/texel_read.h"

#include <array>

#include "server/kernels/color.h"

namespace macula {
namespace {

struct DecodeTables {
    std::array<float, 256> linear8{};
    std::array<float, 256> srgb8{};
    std::array<float, 4097> srgb16{};

    DecodeTables() {
        for (std::size_t i = 0; i < linear8.size(); ++i) {
            linear8[i] = static_cast<float>(i) / 255.0F;
            srgb8[i] = kernels::linear_from_srgb(linear8[i]);
        }
        for (std::size_t i = 0; i < srgb16.size(); ++i)
            srgb16[i] = kernels::linear_from_srgb(static_cast<float>(i * 16) / 65535.0F);
    }
};

}  // namespace

const float* decode_table(TexelType type, bool srgb) {
    static const DecodeTables tables;
    if (type == TexelType::u8) return srgb ? tables.srgb8.data() : tables.linear8.data();
    return type == TexelType::u16 && srgb ? tables.srgb16.data() : nullptr;
}

}  // namespace macula
