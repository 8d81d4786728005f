#include "server/render/nearest_gl.h"

#include <array>
#include <utility>

#include "kernel_text/blend.h"
#include "kernel_text/nearest_buffers.h"
#include "kernel_text/nearest_by_columns.h"
#include "kernel_text/nearest_columns.h"
#include "kernel_text/nearest_columns_buffers.h"
#include "kernel_text/nearest_far_main.h"
#include "kernel_text/nearest_main.h"
#include "kernel_text/nearest_samples.h"
#include "kernel_text/picture_buffers.h"
#include "kernel_text/small_division.h"
#include "server/render/nearest_offsets.h"

namespace macula {

namespace {

unsigned groups(int invocations, int local_size) {
    return static_cast<unsigned>((invocations + local_size - 1) / local_size);
}

}  // namespace

Expected<GlNearestSearch> GlNearestSearch::make(GlContext& context, int wanted) {
    auto search =
        ComputeProgram::build(context, std::array{picture_buffers_text, blend_text, small_division_text,
                                                  nearest_buffers_text, nearest_samples_text, nearest_main_text});
    if (!search) return tl::unexpected(search.error());
    const auto build_far = [&](const KernelText& main_text) {
        return ComputeProgram::build(context, std::array{picture_buffers_text, blend_text, small_division_text,
                                                         nearest_buffers_text, nearest_columns_buffers_text,
                                                         nearest_samples_text, nearest_by_columns_text, main_text});
    };
    auto find_columns = build_far(nearest_columns_text);
    if (!find_columns) return tl::unexpected(find_columns.error());
    auto search_far = build_far(nearest_far_main_text);
    if (!search_far) return tl::unexpected(search_far.error());
    return GlNearestSearch(context, wanted, {std::move(*search), std::move(*find_columns), std::move(*search_far)});
}

GlNearestSearch::GlNearestSearch(GlContext& context, int wanted, Programs programs)
    : wanted_(wanted),
      programs_(std::move(programs)),
      unfinished_(context),
      columns_(context),
      offsets_(context),
      view_(context) {
    offsets_.write(nearest_offsets());
}

Expected<void> GlNearestSearch::dispatch(const SamplePlan& plan, const GlSampleImage& image) {
    view_.write(View{{image.width_px(), image.height_px()},
                     {plan.width_px, plan.height_px},
                     image.guard_px(),
                     static_cast<std::int32_t>(wanted_)});
    unfinished_.write(0U);
    unfinished_.bind(2);
    view_.bind(3);
    offsets_.bind(4);
    const unsigned columns = groups(plan.width_px, 8);
    const unsigned rows = groups(plan.height_px, 8);
    programs_.search.dispatch(columns, rows);
    bool finished = false;
    auto read = unfinished_.read([&](std::span<const std::uint32_t> found) { finished = found[0] == 0; });
    if (!read || finished) return read;

    columns_.resize(static_cast<std::size_t>(image.width_px()) * static_cast<std::size_t>(image.height_px()));
    columns_.bind(2);
    programs_.find_columns.dispatch(groups(image.width_px(), 64));
    programs_.search_far.dispatch(columns, rows);
    return {};
}

}  // namespace macula
