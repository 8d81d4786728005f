#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "masks/levels.h"
#include "protocol/base/image.h"

namespace macula {

/// Samples or pixels of one tile.
struct Patch {
    alignas(64) std::array<Rgba8, kTileArea_px> color;
    alignas(64) std::array<float, kTileArea_px> inverse_depth;
};

using PaletteIndices = std::array<std::uint8_t, kTileArea_px>;

#if defined(__AVX512F__)

/// Sixteen entries of a table of 16 kVectors words, which fits registers: one instruction chooses from 32 words, and a
/// bit of the index between two halves.
template <int kVectors>
__m512i choose(const std::uint32_t* table, __m512i index) {
    if constexpr (kVectors == 2) {
        return _mm512_permutex2var_epi32(_mm512_load_si512(table), index, _mm512_load_si512(table + 16));
    } else {
        const __mmask16 upper = _mm512_test_epi32_mask(index, _mm512_set1_epi32(8 * kVectors));
        return _mm512_mask_blend_epi32(upper, choose<kVectors / 2>(table, index),
                                       choose<kVectors / 2>(table + 8 * kVectors, index));
    }
}

template <int kVectors>
void look_up_vectors(const Patch& palette, const PaletteIndices& index, Patch& pixels) {
    for (std::size_t i = 0; i < kTileArea_px; i += 16) {
        const __m512i sixteen =
            _mm512_maskz_cvtepu8_epi32(0xFFFF, _mm_loadu_si128(reinterpret_cast<const __m128i*>(&index[i])));
        _mm512_store_si512(&pixels.color[i], choose<kVectors>(palette.color.data(), sixteen));
        _mm512_store_si512(
            &pixels.inverse_depth[i],
            choose<kVectors>(reinterpret_cast<const std::uint32_t*>(palette.inverse_depth.data()), sixteen));
    }
}

inline void look_up(const Patch& palette, std::size_t size, const PaletteIndices& index, Patch& pixels) {
    if (size <= 32) return look_up_vectors<2>(palette, index, pixels);
    if (size <= 64) return look_up_vectors<4>(palette, index, pixels);
    if (size <= 128) return look_up_vectors<8>(palette, index, pixels);
    return look_up_vectors<16>(palette, index, pixels);
}

#else

inline void look_up(const Patch& palette, std::size_t /*size*/, const PaletteIndices& index, Patch& pixels) {
    for (std::size_t i = 0; i < kTileArea_px; ++i) {
        pixels.color[i] = palette.color[index[i]];
        pixels.inverse_depth[i] = palette.inverse_depth[index[i]];
    }
}

#endif

}  // namespace macula
