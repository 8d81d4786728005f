#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/base/image.h"

namespace macula {

/// Planes of an 8-bit 4:2:0 picture: luma of W x H, chroma of W/2 x H/2, each chroma sample centred between the four
/// pixels that share it. Strides are in bytes.
template <class Byte>
struct Yuv420Planes {
    Byte* y = nullptr;
    Byte* u = nullptr;
    Byte* v = nullptr;
    std::ptrdiff_t y_stride = 0;
    std::ptrdiff_t u_stride = 0;
    std::ptrdiff_t v_stride = 0;
};

/// R'G'B' to Y'CbCr by BT.709, limited range (luma 16..235, chroma 16..240), in 16-bit fixed point; chroma is the
/// mean of its four pixels. Alpha is dropped. Width and height are even; `out` has room for them.
void yuv420_from_rgba(const ColorImage& picture, const Yuv420Planes<std::uint8_t>& out);

/// The way back, opaque; each chroma sample serves its four pixels. `picture` has its size already, which is even.
void rgba_from_yuv420(const Yuv420Planes<const std::uint8_t>& in, ColorImage& picture);

}  // namespace macula
