#include "masks/rivals/rectangular_plan.h"

#include <algorithm>
#include <cmath>

#include "masks/rivals/traced_samples.h"

namespace macula {
namespace {

constexpr std::uint32_t kWhole = 256;

/// How far a grid shows at a distance inside its edge: Hermite's smooth step, in 1/256.
std::uint32_t shown_at(double inside_px, double fade_px) {
    if (inside_px <= 0.0) return 0;
    if (inside_px >= fade_px) return kWhole;
    const double t = inside_px / fade_px;
    return static_cast<std::uint32_t>(std::lround(kWhole * t * t * (3.0 - 2.0 * t)));
}

/// place_grid() for one axis; returns the number of samples.
int place_axis(double first_px, double step_px, double begin_px, double end_px, double fade_px, int size_px,
               std::vector<std::uint32_t>& places, float& first_needed_px) {
    places.assign(static_cast<std::size_t>(size_px), 0);
    constexpr int kNone = std::numeric_limits<int>::max();
    int least = kNone;
    int most = 0;
    for (int pass = 0; pass < 2; ++pass) {
        for (int pixel = 0; pixel < size_px; ++pixel) {
            const double centre_px = pixel + 0.5;
            const std::uint32_t shown = shown_at(std::min(centre_px - begin_px, end_px - centre_px), fade_px);
            if (shown == 0) continue;
            const auto at_256 = static_cast<int>(std::lround((centre_px - first_px) / step_px * 256.0));
            const int index = at_256 >> 8;
            const int weight = at_256 & 255;
            if (pass == 0) {
                least = std::min(least, index);
                most = std::max(most, weight > 0 ? index + 1 : index);
            } else {
                places[static_cast<std::size_t>(pixel)] =
                    GridPlace{static_cast<std::uint32_t>(index - least), shown, static_cast<std::uint32_t>(weight)}
                        .packed();
            }
        }
        if (pass == 0) {
            if (least == kNone) return 0;
            most = std::max(most, least);
        }
    }
    first_needed_px = static_cast<float>(first_px + least * step_px);
    return most - least + 1;
}

/// Place of sample `index` of an axis, in 1/256 px.
int place_256(float first_px, float step_px, int index) {
    return static_cast<int>(std::lround(256.0 * (double{first_px} + index * double{step_px})));
}

bool at_pixel_centres(const RectangularGrid& grid) {
    const auto centred = [](float px) { return px - std::floor(px) == 0.5F; };
    return grid.step_px == glm::vec2(1.0F) && centred(grid.first_px.x) && centred(grid.first_px.y);
}

}  // namespace

Lattice lattice_of(const glm::dvec2& step_px, const glm::ivec2& phase_px) {
    Lattice lattice{.first_px = 0.5 * step_px, .step_px = step_px};
    for (int axis = 0; axis < 2; ++axis)
        if (step_px[axis] > 1.0) lattice.first_px[axis] += step_px[axis] * (phase_px[axis] / 64.0);
    return lattice;
}

void place_grid(const Lattice& lattice, const ShownBox& box, const glm::ivec2& window_px, RectangularGrid& grid) {
    grid.step_px = lattice.step_px;
    for (int axis = 0; axis < 2; ++axis)
        grid.count[axis] =
            place_axis(lattice.first_px[axis], lattice.step_px[axis], box.begin_px[axis], box.end_px[axis], box.fade_px,
                       window_px[axis], axis == 0 ? grid.columns : grid.rows, grid.first_px[axis]);
    if (grid.count.x == 0 || grid.count.y == 0) grid.count = glm::ivec2(0);
}

RectangularPlanner::RectangularPlanner(const Display& display, Eye eye)
    : window_px_(display.eye_width_px, display.eye_height_px),
      all_(all_pixels(window_px_.x, window_px_.y)),
      visible_(visible_pixels(display, eye)) {
    if (visible_.count() < all_.count())
        hidden_ = std::make_shared<const std::vector<std::uint8_t>>(hidden_pixels(display, eye));
}

void RectangularPlanner::plan(SamplePlan& plan) {
    clear_plan(plan);
    plan.width_px = window_px_.x;
    plan.height_px = window_px_.y;
    plan.hidden = hidden_;
    plan.grids.log_polar = {};
    std::vector<RectangularGrid>& grids = plan.grids.rectangular;
    std::uint32_t total = 0;
    bool centred = true;
    for (RectangularGrid& grid : grids) {
        grid.offset = total;
        total += static_cast<std::uint32_t>(grid.count.x) * static_cast<std::uint32_t>(grid.count.y);
        centred = centred && (grid.count.x == 0 || at_pixel_centres(grid));
    }
    plan.position.resize(total);
    plan.place.resize(centred ? 0 : total);
    plan.spacing.resize(centred ? 0 : total);
    for (std::size_t i = 0; i < grids.size(); ++i) {
        if (grids[i].count.x == 0) continue;
        write_positions(plan, grids[i]);
        find_traced(grids, i, visible_);
        plan.traced_in_window += count_traced_in_window(grids[i]);
        append_samples(traced_, grids[i].offset, plan);
    }
}

std::uint32_t RectangularPlanner::count_in_window(std::span<const RectangularGrid> grids) {
    std::uint32_t total = 0;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        if (grids[i].count.x == 0) continue;
        find_traced(grids, i, all_);
        total += count_traced_in_window(grids[i]);
    }
    return total;
}

/// Sets `traced_`: the samples of a grid that are read by a pixel which shows it and is not covered by finer grids.
void RectangularPlanner::find_traced(std::span<const RectangularGrid> grids, std::size_t grid, const BitRows& pixels) {
    column_shown_.reset(window_px_.x, static_cast<int>(grid) + 1);
    column_whole_.reset(window_px_.x, static_cast<int>(grid) + 1);
    for (int g = 0; g <= static_cast<int>(grid); ++g) {
        const std::vector<std::uint32_t>& columns = grids[static_cast<std::size_t>(g)].columns;
        for (int x = 0; x < window_px_.x; ++x) {
            const std::uint32_t shown = GridPlace::unpacked(columns[static_cast<std::size_t>(x)]).shown;
            if (shown > 0) column_shown_.insert(x, g);
            if (shown == kWhole) column_whole_.insert(x, g);
        }
    }

    const RectangularGrid& of = grids[grid];
    readers_.reset(window_px_.x, of.count.y);
    for (int y = 0; y < window_px_.y; ++y) {
        const GridPlace place = GridPlace::unpacked(of.rows[static_cast<std::size_t>(y)]);
        if (place.shown == 0) continue;
        const auto index = static_cast<int>(place.index);
        const std::span<const std::uint64_t> in_row = pixels.row(y);
        for (std::size_t i = 0; i < in_row.size(); ++i) {
            std::uint64_t read = in_row[i] & column_shown_.row(static_cast<int>(grid))[i];
            for (std::size_t finer = 0; finer < grid; ++finer)
                if (GridPlace::unpacked(grids[finer].rows[static_cast<std::size_t>(y)]).shown == kWhole)
                    read &= ~column_whole_.row(static_cast<int>(finer))[i];
            readers_.row(index)[i] |= read;
            if (place.weight > 0) readers_.row(index + 1)[i] |= read;
        }
    }

    // At steps of a pixel or more, neighbouring pixels read samples without a gap.
    traced_.reset(of.count.x, of.count.y);
    for (int row = 0; row < of.count.y; ++row)
        for_each_run(readers_.row(row), [&](int first, int last) {
            const GridPlace begin = GridPlace::unpacked(of.columns[static_cast<std::size_t>(first)]);
            const GridPlace end = GridPlace::unpacked(of.columns[static_cast<std::size_t>(last - 1)]);
            traced_.insert_range(row, static_cast<int>(begin.index),
                                 static_cast<int>(end.index) + (end.weight > 0 ? 2 : 1));
        });
}

std::uint32_t RectangularPlanner::count_traced_in_window(const RectangularGrid& grid) const {
    glm::ivec2 first(0);
    glm::ivec2 last = grid.count;
    for (int axis = 0; axis < 2; ++axis) {
        const auto inside = [&](int index) {
            const int at = place_256(grid.first_px[axis], grid.step_px[axis], index);
            return at >= 0 && at < 256 * window_px_[axis];
        };
        while (first[axis] < last[axis] && !inside(first[axis])) ++first[axis];
        while (first[axis] < last[axis] && !inside(last[axis] - 1)) --last[axis];
    }
    std::uint32_t total = 0;
    for (int row = first.y; row < last.y; ++row) total += traced_.count_range(row, first.x, last.x);
    return total;
}

void RectangularPlanner::write_positions(SamplePlan& plan, const RectangularGrid& grid) {
    column_256_.resize(static_cast<std::size_t>(grid.count.x));
    for (int column = 0; column < grid.count.x; ++column)
        column_256_[static_cast<std::size_t>(column)] = place_256(grid.first_px.x, grid.step_px.x, column);
    for (int row = 0; row < grid.count.y; ++row) {
        const std::size_t first = grid.offset + static_cast<std::size_t>(row) * column_256_.size();
        const int row_256 = place_256(grid.first_px.y, grid.step_px.y, row);
        const auto y_px = static_cast<std::int16_t>(row_256 >> 8);
        const auto y_in_pixel = static_cast<std::uint8_t>(row_256 & 255);
        SamplePosition* position = &plan.position[first];
        for (std::size_t i = 0; i < column_256_.size(); ++i)
            position[i] = {static_cast<std::int16_t>(column_256_[i] >> 8), y_px};
        if (plan.place.empty()) continue;
        PlaceInPixel* place = &plan.place[first];
        for (std::size_t i = 0; i < column_256_.size(); ++i)
            place[i] = {static_cast<std::uint8_t>(column_256_[i] & 255), y_in_pixel};
    }
    if (!plan.spacing.empty())
        std::fill_n(plan.spacing.begin() + grid.offset, grid.count.x * grid.count.y,
                    std::sqrt(grid.step_px.x * grid.step_px.y));
}

}  // namespace macula
