#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "masks/sample_plan.h"
#include "protocol/gl/buffer.h"
#include "server/render/reconstructor.h"

namespace macula {

/// One eye's picture in GL memory, as a compute program writes it: RGBA8 and inverse depth, row-major without gaps,
/// index y * width + x. The context outlives it and is current during calls.
class GlPicture {
public:
    explicit GlPicture(GlContext& context) : colors_(context), inverse_depths_(context) {}

    /// Undefined content.
    void resize(int width_px, int height_px);
    void bind(unsigned color_index, unsigned inverse_depth_index) const;
    /// Waits for the programs dispatched before. Errors: `graphics`.
    [[nodiscard]] Expected<void> copy_to(const ReconstructTarget& target) const;

private:
    int width_px_ = 0;
    StorageBuffer<Rgba8> colors_;
    StorageBuffer<float> inverse_depths_;
};

/// SamplePlan::hidden in GL memory: a byte per pixel of the window, four to a word, the first in the lowest byte. Zeros
/// where a plan hides nothing. The context outlives it and is current during calls.
class GlHiddenPixels {
public:
    explicit GlHiddenPixels(GlContext& context) : words_(context) {}

    /// Uploads only what is another array than that of the plan before.
    void update(const SamplePlan& plan);
    void bind(unsigned index) const { words_.bind(index); }

private:
    StorageBuffer<std::uint32_t> words_;
    std::shared_ptr<const std::vector<std::uint8_t>> uploaded_;  ///< kept, so that no other array gets its address
};

}  // namespace macula
