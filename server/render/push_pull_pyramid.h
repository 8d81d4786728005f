#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/render/reconstructor.h"
#include "server/render/sample_image.h"

namespace macula {

/// The pyramid of server/kernels/push_pull.h on the shared thread pool, in loops over planes that a compiler turns into
/// vector instructions.
class PushPullPyramid {
public:
    /// Fills the window of `plan`; `image` was cleared before it was filled with that plan.
    void reconstruct(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target);

private:
    /// One picture; the formats are those of push_pull.h.
    struct Level {
        int width = 0;
        int height = 0;
        std::array<std::vector<std::uint16_t>, 3> channel;
        std::vector<std::uint16_t> weight;
        std::vector<float> inverse_depth;

        void resize(int new_width, int new_height);
        [[nodiscard]] std::size_t row(int y) const {
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        }
    };
    class PullRows;
    class PushRows;

    static void push(const Level& coarse, Level& fine);
    static void show(const SamplePlan& plan, const SampleImage& image, const Level& coarse,
                     const ReconstructTarget& target);

    std::vector<Level> levels_;  ///< without the finest, which is the sample image
};

}  // namespace macula
