#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/render/nearest_columns.h"
#include "server/render/reconstructor.h"
#include "server/render/sample_image.h"

namespace macula {

/// Makes each pixel of its nearest samples, with the result of server/kernels/nearest_samples.h, on the shared thread
/// pool.
///
/// Most pixels find theirs within some pixels. Those try the pixels around them in the order of distance, many
/// pixels at once, until each has found enough. Only for the others the kernel is run.
class NearestSearch {
public:
    /// `wanted`: 1 to kernels::kMostNeighbours samples a pixel.
    explicit NearestSearch(int wanted);

    /// Fills the window of `plan`; `image` was cleared before it was filled with that plan.
    void reconstruct(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target);

private:
    struct Block;

    void mark_samples(const SampleImage& image);
    template <int wanted>
    void search(const std::uint8_t* present, Block& block) const;
    void write_block(const SampleImage& image, glm::ivec2 place, int width, const Block& block,
                     const ReconstructTarget& target, std::uint8_t& unfinished) const;
    void finish_rows(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target);

    int wanted_;
    std::vector<SamplePosition> offsets_;  ///< nearest_offsets()
    std::vector<std::ptrdiff_t> steps_;    ///< the same in present_
    std::vector<std::uint8_t> present_;    ///< 1 where there is a sample, with a margin around the image
    std::size_t present_stride_ = 0;
    std::vector<std::uint8_t> unfinished_;  ///< per row: some pixels have not found enough
    NearestColumns columns_;
};

}  // namespace macula
