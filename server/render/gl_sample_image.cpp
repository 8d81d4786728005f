#include "server/render/gl_sample_image.h"

#include <array>
#include <cstddef>
#include <utility>

#include "kernel_text/sample_image_buffers.h"
#include "kernel_text/sample_image_clear.h"
#include "kernel_text/sample_image_scatter.h"
#include "server/render/sample_image.h"

namespace macula {

namespace {

unsigned groups(std::size_t invocations) {
    constexpr std::size_t kLocalSize = 256;  // sample_image_buffers.glsl
    return static_cast<unsigned>((invocations + kLocalSize - 1) / kLocalSize);
}

}  // namespace

Expected<GlSampleImage> GlSampleImage::make(GlContext& context) {
    auto clear = ComputeProgram::build(context, std::array{sample_image_buffers_text, sample_image_clear_text});
    if (!clear) return tl::unexpected(clear.error());
    auto scatter = ComputeProgram::build(context, std::array{sample_image_buffers_text, sample_image_scatter_text});
    if (!scatter) return tl::unexpected(scatter.error());
    return GlSampleImage(context, std::move(*clear), std::move(*scatter));
}

GlSampleImage::GlSampleImage(GlContext& context, ComputeProgram clear, ComputeProgram scatter)
    : clear_(std::move(clear)),
      scatter_(std::move(scatter)),
      positions_(context),
      sample_colors_(context),
      sample_inverse_depths_(context),
      view_buffer_(context),
      colors_(context),
      inverse_depths_(context) {}

void GlSampleImage::fill(const SamplePlan& plan, const Samples& samples, bool clear) {
    const std::size_t addresses = plan.address_count();
    const int guard_px = macula::guard_px(plan);
    view_ = {plan.width_px + 2 * guard_px, plan.height_px + 2 * guard_px, guard_px,
             static_cast<std::int32_t>(addresses)};
    const std::size_t pixels = static_cast<std::size_t>(view_.width_px) * static_cast<std::size_t>(view_.height_px);
    positions_.write(std::span(plan.position).first(addresses));
    sample_colors_.write(std::span(samples.color).first(addresses));
    sample_inverse_depths_.write(std::span(samples.inverse_depth_per_m).first(addresses));
    view_buffer_.write(view_);
    colors_.resize(pixels);
    inverse_depths_.resize(pixels);

    positions_.bind(0);
    sample_colors_.bind(1);
    sample_inverse_depths_.bind(2);
    view_buffer_.bind(3);
    colors_.bind(4);
    inverse_depths_.bind(5);
    if (clear) clear_.dispatch(groups(pixels));
    scatter_.dispatch(groups(addresses));
}

void GlSampleImage::bind(unsigned color_index, unsigned inverse_depth_index) const {
    colors_.bind(color_index);
    inverse_depths_.bind(inverse_depth_index);
}

}  // namespace macula
