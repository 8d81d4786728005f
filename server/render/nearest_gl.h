#pragma once

#include <cstdint>

#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "server/render/gl_sample_image.h"

namespace macula {

/// server/kernels/nearest_samples.h as compute programs. The context outlives it and is current during calls.
class GlNearestSearch {
public:
    /// `wanted`: 1 to kernels::kMostNeighbours samples a pixel. Errors: `graphics`.
    static Expected<GlNearestSearch> make(GlContext& context, int wanted);

    /// Writes the picture of a plan's window. `image` was cleared before it was filled with that plan, and is bound to
    /// 0 and 1; picture and hidden pixels are bound as in picture_buffers.glsl. Waits for the search. Errors:
    /// `graphics`.
    Expected<void> dispatch(const SamplePlan& plan, const GlSampleImage& image);

private:
    /// What the programs are told; std430 layout.
    struct View {
        glm::ivec2 size_px;
        glm::ivec2 window_px;
        std::int32_t guard_px;
        std::int32_t wanted;
    };

    struct Programs {
        ComputeProgram search;
        ComputeProgram find_columns;
        ComputeProgram search_far;
    };

    GlNearestSearch(GlContext& context, int wanted, Programs programs);

    int wanted_;
    Programs programs_;
    StorageBuffer<std::uint32_t> unfinished_;  ///< one: not 0 where some pixel's samples are far
    StorageBuffer<std::uint32_t> columns_;
    StorageBuffer<SamplePosition> offsets_;
    StorageBuffer<View> view_;
};

}  // namespace macula
