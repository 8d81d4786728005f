#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "protocol/base/error.h"
#include "protocol/base/image.h"
#include "server/offline/shot.h"
#include "server/render/reconstructor.h"

namespace macula {

/// A finished shot as images of the view's size.
struct Layers {
    Image<glm::vec3> radiance;          ///< linear; where pixels were interpolated, that of the display's colour
    ColorImage color;                   ///< as a display shows it
    Image<float> depth_m;               ///< along -Z of the eye; infinite where nothing was hit
    Image<std::uint32_t> object;        ///< of traced pixels; 0: nothing hit, or not traced
    Image<std::uint8_t> traced;         ///< 1: the pixel has a sample
    Image<std::uint16_t> tile_samples;  ///< samples of the pixel's 16x16 tile, 0 to 256
};

/// Lays out a shot's samples. With a reconstructor, pixels without a sample are interpolated; without one they are
/// black and infinitely far. Errors: `graphics` if the reconstructor's context is lost.
Expected<Layers> make_layers(const Shot& shot, Reconstructor* reconstructor, float exposure);

}  // namespace macula
