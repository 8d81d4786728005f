#pragma once

#include <cstdint>
#include <vector>

#include "server/render/sample_image.h"

namespace macula {

/// How far the next sample is in a pixel's column of a sample image, in rows; 65535: there is none.
struct NearestColumns {
    std::vector<std::uint16_t> above;  ///< upwards, row-major; 0: the pixel has one
    std::vector<std::uint16_t> below;  ///< downwards, 1 or more

    /// `image` was cleared before it was filled. On the shared thread pool.
    void find(const SampleImage& image);
};

}  // namespace macula
