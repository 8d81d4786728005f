#include "server/render/push_pull_gl.h"

#include <array>
#include <utility>

#include "kernel_text/blend.h"
#include "kernel_text/picture_buffers.h"
#include "kernel_text/push_pull.h"
#include "kernel_text/push_pull_buffers.h"
#include "kernel_text/push_pull_pull.h"
#include "kernel_text/push_pull_push.h"
#include "kernel_text/push_pull_show.h"
#include "kernel_text/small_division.h"

namespace macula {

namespace {

void dispatch_pixels(const ComputeProgram& program, glm::ivec2 size) {
    constexpr int kLocalSize = 8;  // push_pull_buffers.glsl
    const glm::ivec2 groups = (size + kLocalSize - 1) / kLocalSize;
    program.dispatch(static_cast<unsigned>(groups.x), static_cast<unsigned>(groups.y));
}

Expected<ComputeProgram> build(GlContext& context, const KernelText& main_text) {
    return ComputeProgram::build(context, std::array{picture_buffers_text, blend_text, small_division_text,
                                                     push_pull_text, push_pull_buffers_text, main_text});
}

}  // namespace

Expected<GlPushPull> GlPushPull::make(GlContext& context) {
    auto pull = build(context, push_pull_pull_text);
    if (!pull) return tl::unexpected(pull.error());
    auto push = build(context, push_pull_push_text);
    if (!push) return tl::unexpected(push.error());
    auto show = build(context, push_pull_show_text);
    if (!show) return tl::unexpected(show.error());
    return GlPushPull(context, std::move(*pull), std::move(*push), std::move(*show));
}

GlPushPull::GlPushPull(GlContext& context, ComputeProgram pull, ComputeProgram push, ComputeProgram show)
    : context_(&context),
      pull_(std::move(pull)),
      push_(std::move(push)),
      show_(std::move(show)),
      colors_(context),
      inverse_depths_(context) {}

void GlPushPull::lay_out(const SamplePlan& plan, const GlSampleImage& image) {
    const glm::ivec2 window(plan.width_px, plan.height_px);
    glm::ivec2 size(image.width_px(), image.height_px());
    if (!views_.empty() && views_.front().fine_size == size && views_.front().window_size == window) return;
    views_.clear();
    std::int32_t offset = -1;
    std::int32_t next = 0;
    do {
        const glm::ivec2 coarse = (size + 1) / 2;
        views_.push_back({size, coarse, offset, next, image.guard_px(), 0, window});
        offset = next;
        next += coarse.x * coarse.y;
        size = coarse;
    } while (size.x > 1 || size.y > 1);
    colors_.resize(static_cast<std::size_t>(next));
    inverse_depths_.resize(static_cast<std::size_t>(next));
    while (view_buffers_.size() < views_.size()) view_buffers_.emplace_back(*context_);
    for (std::size_t i = 0; i < views_.size(); ++i) view_buffers_[i].write(views_[i]);
}

Expected<void> GlPushPull::dispatch(const SamplePlan& plan, const GlSampleImage& image) {
    lay_out(plan, image);
    colors_.bind(2);
    inverse_depths_.bind(3);
    for (std::size_t i = 0; i < views_.size(); ++i) {
        view_buffers_[i].bind(4);
        dispatch_pixels(pull_, views_[i].coarse_size);
    }
    for (std::size_t i = views_.size() - 1; i > 0; --i) {
        view_buffers_[i].bind(4);
        dispatch_pixels(push_, views_[i].fine_size);
    }
    view_buffers_[0].bind(4);
    dispatch_pixels(show_, views_[0].window_size);
    return {};
}

}  // namespace macula
