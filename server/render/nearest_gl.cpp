#include "server/render/nearest_gl.h"

#include <array>
#include <utility>

#include "kernel_text/blend.h"
#include "kernel_text/nearest_buffers.h"
#include "kernel_text/nearest_columns.h"
#include "kernel_text/nearest_main.h"
#include "kernel_text/nearest_samples.h"
#include "kernel_text/picture_buffers.h"
#include "kernel_text/small_division.h"
#include "server/render/nearest_offsets.h"

namespace macula {

namespace {

Expected<ComputeProgram> build(GlContext& context, const KernelText& main_text) {
    return ComputeProgram::build(context, std::array{picture_buffers_text, blend_text, small_division_text,
                                                     nearest_buffers_text, nearest_samples_text, main_text});
}

unsigned groups(int invocations, int local_size) {
    return static_cast<unsigned>((invocations + local_size - 1) / local_size);
}

}  // namespace

Expected<GlNearestSearch> GlNearestSearch::make(GlContext& context, int wanted) {
    auto find_columns = build(context, nearest_columns_text);
    if (!find_columns) return tl::unexpected(find_columns.error());
    auto search = build(context, nearest_main_text);
    if (!search) return tl::unexpected(search.error());
    return GlNearestSearch(context, wanted, std::move(*find_columns), std::move(*search));
}

GlNearestSearch::GlNearestSearch(GlContext& context, int wanted, ComputeProgram find_columns, ComputeProgram search)
    : wanted_(wanted),
      find_columns_(std::move(find_columns)),
      search_(std::move(search)),
      columns_(context),
      offsets_(context),
      view_(context) {
    offsets_.write(nearest_offsets());
}

void GlNearestSearch::dispatch(const SamplePlan& plan, const GlSampleImage& image) {
    view_.write(View{{image.width_px(), image.height_px()},
                     {plan.width_px, plan.height_px},
                     image.guard_px(),
                     static_cast<std::int32_t>(wanted_)});
    columns_.resize(static_cast<std::size_t>(image.width_px()) * static_cast<std::size_t>(image.height_px()));
    columns_.bind(2);
    view_.bind(3);
    offsets_.bind(4);
    find_columns_.dispatch(groups(image.width_px(), 64));
    search_.dispatch(groups(plan.width_px, 8), groups(plan.height_px, 8));
}

}  // namespace macula
