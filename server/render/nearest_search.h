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
/// Most pixels find theirs nearby. Those try the pixels around them in the order of distance, 64 pixels of a row at
/// once, each a bit of a word, until all have found enough: a try costs some instructions a word, and only what is
/// found costs some a pixel. For the others nearest_by_columns.h is run.
class NearestSearch {
public:
    /// `wanted`: 1 to kernels::kMostNeighbours samples a pixel.
    explicit NearestSearch(int wanted);

    /// Fills the window of `plan`; `image` was cleared before it was filled with that plan.
    void reconstruct(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target);

private:
    struct Block;
    struct Blends;
    /// Where the samples at an offset from the 64 pixels of a block are: from that bit of that word on, counted from
    /// the block's word.
    struct Window {
        std::ptrdiff_t word = 0;
        unsigned shift = 0;
    };

    void mark_samples(const SampleImage& image);
    void search(const std::uint64_t* block_words, Block& block) const;
    void write_block(const SampleImage& image, std::size_t own, int width, const Block& block, Blends& blends,
                     Rgba8* color, float* depth) const;
    void finish_rows(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target);

    int wanted_;
    std::vector<SamplePosition> offsets_;  ///< nearest_offsets()
    std::vector<Window> windows_;          ///< the same in present_
    std::vector<std::uint64_t> present_;   ///< a bit for each pixel of the image that has a sample, with a margin
    int row_words_ = 0;
    std::vector<std::uint8_t> unfinished_;  ///< per row: some pixels have not found enough
    NearestColumns columns_;
};

}  // namespace macula
