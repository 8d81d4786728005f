#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "server/render/gl_picture.h"
#include "server/render/gl_sample_image.h"

namespace macula {

/// PushPullPyramid as compute programs, one dispatch for each level and way. The context outlives it and is current
/// during calls.
class GlPushPull {
public:
    /// Errors: `graphics`.
    static Expected<GlPushPull> make(GlContext& context);

    /// Writes the picture of a plan's window. `image` was cleared before it was filled with that plan, and is bound to
    /// 0 and 1; picture and hidden pixels are bound as in picture_buffers.glsl. Errors: none before the picture is
    /// read.
    Expected<void> dispatch(const SamplePlan& plan, const GlSampleImage& image);

private:
    /// What a program is told; std430 layout.
    struct View {
        glm::ivec2 fine_size;
        glm::ivec2 coarse_size;
        std::int32_t fine_offset;
        std::int32_t coarse_offset;
        std::int32_t guard_px;
        std::int32_t unused;
        glm::ivec2 window_size;
    };

    GlPushPull(GlContext& context, ComputeProgram pull, ComputeProgram push, ComputeProgram show);
    void lay_out(const SamplePlan& plan, const GlSampleImage& image);

    GlContext* context_;
    ComputeProgram pull_;
    ComputeProgram push_;
    ComputeProgram show_;
    std::vector<View> views_;  ///< finest first
    std::vector<StorageBuffer<View>> view_buffers_;
    StorageBuffer<glm::uvec2> colors_;
    StorageBuffer<float> inverse_depths_;
};

}  // namespace macula
