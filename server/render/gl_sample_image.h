#pragma once

#include <cstdint>
#include <vector>

#include "masks/sample_plan.h"
#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "server/render/tracer.h"

namespace macula {

/// SampleImage in GL memory, filled by a compute program. The context outlives it and is current during calls; what GL
/// reports is found when a result is read.
class GlSampleImage {
public:
    /// Errors: `graphics`.
    static Expected<GlSampleImage> make(GlContext& context);

    /// Uploads the samples and puts them at their pixels, as SampleImage::fill does. Uses bindings 0 to 5.
    void fill(const SamplePlan& plan, const Samples& samples, bool clear);

    /// RGBA8 and inverse depth, row-major; programs dispatched after fill() see its result.
    void bind(unsigned color_index, unsigned inverse_depth_index) const;
    [[nodiscard]] int guard_px() const { return view_.guard_px; }
    [[nodiscard]] int width_px() const { return view_.width_px; }    ///< guard bands included
    [[nodiscard]] int height_px() const { return view_.height_px; }  ///< guard bands included

private:
    /// What the programs are told; std430 layout.
    struct View {
        std::int32_t width_px = 0;
        std::int32_t height_px = 0;
        std::int32_t guard_px = 0;
        std::int32_t addresses = 0;
    };

    GlSampleImage(GlContext& context, ComputeProgram clear, ComputeProgram scatter);

    ComputeProgram clear_;
    ComputeProgram scatter_;
    View view_;
    StorageBuffer<SamplePosition> positions_;
    StorageBuffer<Rgba8> sample_colors_;
    StorageBuffer<float> sample_inverse_depths_;
    StorageBuffer<View> view_buffer_;
    StorageBuffer<Rgba8> colors_;
    StorageBuffer<float> inverse_depths_;
};

}  // namespace macula
