#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "client/present/taa_kernel.h"
#include "protocol/base/image.h"

namespace macula {

// The kernels over one row of an eye's picture. Compilers vectorise arithmetic well and scattered loads badly (on many
// processors the gather instruction is no faster than single loads), so a row is worked on in chunks: lanes of
// arithmetic, then plain loads, then lanes again.

/// A texel of the history: the two words of taa_kernel.h.
struct HistoryTexel {
    std::uint32_t red_green = 0;
    std::uint32_t blue_precision = 0;
};

/// One eye's share of pictures that may hold both: pointers to the eye's first element, strides in elements.
struct EyeDepth {
    const float* blocks = nullptr;
    int stride = 0;
};
struct EyeColor {
    const Rgba8* pixels = nullptr;
    int stride = 0;
};

/// One eye's blocks of slots (taa_kernel.h), laid out as its depth, and their warps.
struct EyeSlots {
    const std::uint8_t* blocks = nullptr;
    int stride = 0;
    const kernels::ViewWarp* warps = nullptr;  ///< by slot
};

/// What accumulate_row() reads and writes: rows of the new picture, whole planes of the one before.
struct AccumulateRow {
    int y = 0;
    int width = 0;
    int height = 0;
    kernels::ViewWarp warp;  ///< to the view before
    kernels::TaaWeights weights;
    float continues = 1.0F;  ///< 0: there is no history
    const Rgba8* color = nullptr;
    const float* depth = nullptr;  ///< of the row's blocks
    const float* precision = nullptr;
    EyeDepth depth_before;
    bool moves = false;  ///< whether the following are given
    EyeSlots now;
    EyeSlots before;  ///< its warps are those of `now`
    const HistoryTexel* history = nullptr;
    HistoryTexel* history_out = nullptr;
    Rgba8* color_out = nullptr;
};
void accumulate_row(const AccumulateRow& row);

/// What show_row() reads and writes.
struct ShowRow {
    int y = 0;
    int width = 0;
    int height = 0;
    kernels::ViewWarp warp;  ///< from what is shown to what is there
    EyeDepth depth;
    EyeColor color;
    bool moves = false;                    ///< whether the following are given
    EyeSlots now;                          ///< of the frame, with warps from what is shown
    EyeSlots shown;                        ///< of what is shown
    const float* shown_depth = nullptr;    ///< laid out as `shown.blocks`
    const std::uint8_t* hidden = nullptr;  ///< pixels of the row that the lens never shows
    Rgba8* out = nullptr;
};
void show_row(const ShowRow& row);

}  // namespace macula
