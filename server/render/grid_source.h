#pragma once

// The grid kernel compiled as C++: what it reads, and the kernel.

#include <array>
#include <cstdint>

#include "masks/sample_plan.h"
#include "protocol/gl/kernel_language.h"
#include "server/render/tracer.h"

namespace macula::kernels {

/// One eye's grids and samples.
struct GridSource {
    std::array<const std::uint32_t*, kMostGrids> columns = {};
    std::array<const std::uint32_t*, kMostGrids> rows = {};
    const Rgba8* colors = nullptr;
    const float* inverse_depths = nullptr;
};

inline uint grid_column(const GridSource& source, int grid, int x) {
    return source.columns[static_cast<std::size_t>(grid)][x];
}
inline uint grid_row(const GridSource& source, int grid, int y) {
    return source.rows[static_cast<std::size_t>(grid)][y];
}
inline uint sample_color(const GridSource& source, int address) {
    return source.colors[address];
}
inline float sample_inverse_depth(const GridSource& source, int address) {
    return source.inverse_depths[address];
}

}  // namespace macula::kernels

#include "server/kernels/grid.h"

namespace macula {

inline kernels::GridView grid_view(const SamplePlan& plan) {
    kernels::GridView view{};
    view.size_px = {plan.width_px, plan.height_px};
    const GridLayout& layout = plan.grids;
    view.grids = static_cast<int>(layout.rectangular.size());
    for (int i = 0; i < view.grids; ++i) {
        view.offset[i] = static_cast<int>(layout.rectangular[static_cast<std::size_t>(i)].offset);
        view.columns[i] = layout.rectangular[static_cast<std::size_t>(i)].count.x;
    }
    if (view.grids == 0) {
        view.columns_log = 0.69314718F / layout.log_polar.log_radius;
        view.polar_count = layout.log_polar.count;
        view.polar_phase = layout.log_polar.phase;
        view.centre_px = layout.log_polar.centre_px;
    }
    return view;
}

}  // namespace macula
