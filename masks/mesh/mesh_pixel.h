#pragma once

#include <cstdint>

namespace macula {

/// A pixel interpolates sites at most this far away in x and in y.
inline constexpr int kMeshReach_px = 127;

/// How one pixel of a mask interpolates: the corners of its triangle at `pixel + (ax, ay)` and so on, with weights in
/// 1/256. The weight of a, the largest, is 256 - weight_b - weight_c; that of c is the least, and corners of equal
/// exact weight follow each other row by row. A corner whose exact weight is 0, because the pixel lies on an edge or
/// is a site, repeats a; one whose weight is merely rounded to 0 stays. A site is its own pixel: offsets 0, weights 0.
struct MeshPixel {
    std::int8_t ax = 0;
    std::int8_t ay = 0;
    std::int8_t bx = 0;
    std::int8_t by = 0;
    std::int8_t cx = 0;
    std::int8_t cy = 0;
    std::uint8_t weight_b = 0;
    std::uint8_t weight_c = 0;
};
static_assert(sizeof(MeshPixel) == 8);

}  // namespace macula
