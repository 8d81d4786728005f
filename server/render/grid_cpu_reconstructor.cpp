#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "server/render/grid_reconstructors.h"
#include "server/render/grid_source.h"
#include "server/render/lanes.h"
#include "server/render/parallel_ranges.h"
#include "server/render/reconstruction.h"

namespace macula {

namespace {

kernels::GridSource source_of(const SamplePlan& plan, const Samples& samples) {
    kernels::GridSource source;
    for (std::size_t i = 0; i < plan.grids.rectangular.size(); ++i) {
        source.columns[i] = plan.grids.rectangular[i].columns.data();
        source.rows[i] = plan.grids.rectangular[i].rows.data();
    }
    source.colors = samples.color.data();
    source.inverse_depths = samples.inverse_depth_per_m.data();
    return source;
}

constexpr int kWhole = 256;

/// Pixels of a row that are reconstructed at once, by the same functions as one by one but in loops that the compiler
/// turns into vector code: one grid, and nothing missing.
class Strip {
public:
    Strip(const kernels::GridSource& source, const kernels::GridView& view, int x, int y, const std::uint8_t* hidden)
        : source_(source), view_(view), x_(x), y_(y) {
        if (hidden != nullptr) std::copy_n(hidden + x, kLaneCount, hidden_.value);
    }

    [[nodiscard]] bool all_hidden() const {
        return std::none_of(hidden_.value, hidden_.value + kLaneCount, [](int is_hidden) { return is_hidden == 0; });
    }

    /// False: these pixels have to be reconstructed one by one.
    bool reconstruct(Rgba8* color, float* inverse_depth) noexcept {
        if (view_.grids == 0) {
            find_log_polar_cells();
        } else {
            const int grid = only_grid();
            if (grid < 0) return false;
            find_rectangular_cells(grid);
        }
        if (!gather()) return false;
        MACULA_LANE_LOOP
        for (int i = 0; i < kLaneCount; ++i) {
            const kernels::ivec4 weight(weight_[0][i], weight_[1][i], weight_[2][i], weight_[3][i]);
            const kernels::uvec4 colors(color_[0][i], color_[1][i], color_[2][i], color_[3][i]);
            const kernels::vec4 depths(depth_[0][i], depth_[1][i], depth_[2][i], depth_[3][i]);
            const Rgba8 blended = kernels::blend_four_colors(colors, weight);
            const float depth = kernels::blend_four_depths(depths, weight);
            color[i] = hidden_[i] != 0 ? kernels::kOpaqueBlack : blended;
            inverse_depth[i] = hidden_[i] != 0 ? 0.0F : depth;
        }
        return true;
    }

private:
    /// The grid that shows in all of the pixels, whole and alone; -1: there is none.
    [[nodiscard]] int only_grid() const {
        for (int grid = 0; grid < view_.grids; ++grid) {
            const int in_row = static_cast<int>(kernels::grid_row(source_, grid, y_) >> 8U & 511U);
            const std::uint32_t* columns = source_.columns[static_cast<std::size_t>(grid)] + x_;
            int least = kWhole;
            int most = 0;
            for (int i = 0; i < kLaneCount; ++i) {
                const int shown = static_cast<int>(columns[i] >> 8U & 511U);
                least = std::min(least, shown);
                most = std::max(most, shown);
            }
            if (std::min(least, in_row) == kWhole) return grid;
            if (std::min(most, in_row) > 0) return -1;
        }
        return -1;
    }
    void find_rectangular_cells(int grid) {
        const std::uint32_t row = kernels::grid_row(source_, grid, y_);
        const std::uint32_t* columns = source_.columns[static_cast<std::size_t>(grid)] + x_;
        const int offset = view_.offset[grid];
        const int in_row = view_.columns[grid];
        MACULA_LANE_LOOP
        for (int i = 0; i < kLaneCount; ++i) set_cell(i, kernels::rectangular_cell(offset, in_row, columns[i], row));
    }
    void find_log_polar_cells() {
        const float away_y = static_cast<float>(y_) + 0.5F - view_.centre_px.y;
        MACULA_LANE_LOOP
        for (int i = 0; i < kLaneCount; ++i) {
            const kernels::vec2 away(static_cast<float>(x_ + i) + 0.5F - view_.centre_px.x, away_y);
            set_cell(i, kernels::log_polar_cell(view_, kernels::log_polar_place(view_, away)));
        }
    }
    void set_cell(int i, const kernels::GridCell& cell) {
        address_[0][i] = cell.address.x;
        address_[1][i] = cell.address.y;
        address_[2][i] = cell.address.z;
        address_[3][i] = cell.address.w;
        weight_[0][i] = cell.weight.x;
        weight_[1][i] = cell.weight.y;
        weight_[2][i] = cell.weight.z;
        weight_[3][i] = cell.weight.w;
    }
    /// False: a visible pixel has a sample that was not traced.
    bool gather() {
        int missing = 0;
        for (int corner = 0; corner < 4; ++corner) {
            for (int i = 0; i < kLaneCount; ++i) {
                color_[corner][i] = source_.colors[address_[corner][i]];
                depth_[corner][i] = source_.inverse_depths[address_[corner][i]];
            }
            for (int i = 0; i < kLaneCount; ++i)
                missing |= static_cast<int>(depth_[corner][i] < 0.0F) & static_cast<int>(hidden_[i] == 0);
        }
        return missing == 0;
    }

    const kernels::GridSource& source_;
    const kernels::GridView& view_;
    int x_;
    int y_;
    Lanes<int> hidden_ = {};  // as wide as what it selects, so that one loop takes both
    Lanes<int> address_[4];
    Lanes<int> weight_[4];
    Lanes<Rgba8> color_[4];
    Lanes<float> depth_[4];
};

void reconstruct_row(const kernels::GridSource& source, const kernels::GridView& view, int y,
                     const std::uint8_t* hidden, Rgba8* color, float* inverse_depth) noexcept {
    for (int first = 0; first < view.size_px.x; first += kLaneCount) {
        const int last = std::min(first + kLaneCount, view.size_px.x);
        if (last - first == kLaneCount) {
            Strip strip(source, view, first, y, hidden);
            if (strip.all_hidden()) {
                std::fill_n(color + first, kLaneCount, kernels::kOpaqueBlack);
                std::fill_n(inverse_depth + first, kLaneCount, 0.0F);
                continue;
            }
            if (strip.reconstruct(color + first, inverse_depth + first)) continue;
        }
        for (int x = first; x < last; ++x) {
            if (hidden != nullptr && hidden[x] != 0) {
                color[x] = kernels::kOpaqueBlack;
                inverse_depth[x] = 0.0F;
            } else {
                kernels::grid_pixel(source, view, {x, y}, color[x], inverse_depth[x]);
            }
        }
    }
}

class CpuGridReconstructor final : public Reconstructor {
public:
    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::bilinear, plan); !fits) return fits;
        const kernels::GridSource source = source_of(plan, samples);
        const kernels::GridView view = grid_view(plan);
        parallel_ranges(0, plan.height_px, 16, [&](int first, int last) {
            for (int y = first; y < last; ++y) {
                const auto row = static_cast<std::size_t>(y);
                const std::uint8_t* hidden =
                    plan.hidden ? plan.hidden->data() + row * static_cast<std::size_t>(plan.width_px) : nullptr;
                reconstruct_row(source, view, y, hidden, target.color + row * target.color_stride_px,
                                target.inverse_depth_per_m + row * target.depth_stride_px);
            }
        });
        return {};
    }
    [[nodiscard]] std::string name() const override { return "C++"; }
};

}  // namespace

std::unique_ptr<Reconstructor> make_cpu_grid_reconstructor() {
    return std::make_unique<CpuGridReconstructor>();
}

}  // namespace macula
