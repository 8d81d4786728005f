#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace macula {

/// Row-major picture without padding; row 0 on top. A value type.
template <class T>
struct Image {
    int width_px = 0;
    int height_px = 0;
    std::vector<T> texels;

    Image() = default;
    Image(int width, int height, T fill = T{})
        : width_px(width),
          height_px(height),
          texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

    [[nodiscard]] T* row(int y) {
        return texels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px);
    }
    [[nodiscard]] const T* row(int y) const {
        return texels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px);
    }
    [[nodiscard]] T& at(int x, int y) { return row(y)[x]; }
    [[nodiscard]] const T& at(int x, int y) const { return row(y)[x]; }
};

/// sRGB-coded colour, R in the lowest byte, then G, B and an opaque A: the bytes of RGBA8 in memory.
using Rgba8 = std::uint32_t;
using ColorImage = Image<Rgba8>;

/// 1 / depth, per metre, where depth is metres along -Z in eye space; 0 where nothing was hit. The inverse
/// is kept because it is affine in the image over any plane, so that interpolating it is exact there.
using InverseDepthImage = Image<float>;

}  // namespace macula
