#include "masks/rivals/log_polar_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

#include "masks/rivals/gaze_point.h"
#include "masks/rivals/traced_samples.h"

namespace macula {
namespace {

constexpr int kLeastSize = 2;
constexpr int kSolveSteps = 24;

/// No point of a pixel is farther from its centre.
constexpr double kHalfDiagonal_px = 0.7072;

/// The buffer around a place of the window.
LogPolarGrid grid_around(const glm::dvec2& centre_px, const glm::dvec2& window_px, const glm::ivec2& size,
                         const glm::ivec2& phase_px) {
    LogPolarGrid grid;
    grid.centre_px = centre_px;
    double farthest_px = 0.0;
    for (const glm::dvec2 corner :
         {glm::dvec2(0.0), glm::dvec2(window_px.x, 0.0), glm::dvec2(0.0, window_px.y), window_px})
        farthest_px = std::max(farthest_px, glm::distance(glm::dvec2(grid.centre_px), corner));
    grid.log_radius = static_cast<float>(std::log(farthest_px));
    grid.phase = glm::vec2(phase_px) / 64.0F;
    grid.count = size;
    return grid;
}

double radius_px(const LogPolarGrid& grid, double column) {
    const double part = std::max((column + grid.phase.x) / (grid.count.x - 1), 0.0);
    return std::exp(grid.log_radius * std::pow(part, 1.0 / kLogPolarExponent));
}

double column_of(const LogPolarGrid& grid, double radius_px) {
    const double part = std::log(std::max(radius_px, 1.0)) / grid.log_radius;
    return std::pow(part, kLogPolarExponent) * (grid.count.x - 1) - grid.phase.x;
}

glm::ivec2 size_of(const glm::dvec2& window_px, double scale) {
    return glm::max(glm::ivec2(std::lround(scale * window_px.x), std::lround(scale * window_px.y)), kLeastSize);
}

}  // namespace

Expected<std::unique_ptr<LogPolarSampler>> LogPolarSampler::make(const Display& display, Eye eye, double share) {
    if (!(share > 0.0 && share < 1.0))
        return fail(
            ErrorCode::option,
            "log-polar sampling has no full resolution, as its samples lie on circles around the gaze and not at "
            "pixels: use a percentage below 100, not " +
                std::to_string(100.0 * share));
    return std::unique_ptr<LogPolarSampler>(new LogPolarSampler(display, eye, share));
}

LogPolarSampler::LogPolarSampler(const Display& display, Eye eye, double share)
    : display_(display), eye_(eye), visible_(visible_pixels(display, eye)) {
    const glm::ivec2 window_px(visible_.width(), visible_.height());
    if (visible_.count() < static_cast<std::uint32_t>(window_px.x * window_px.y))
        hidden_ = std::make_shared<const std::vector<std::uint8_t>>(hidden_pixels(display, eye));
    for (int y = 0; y < window_px.y; ++y)
        for (int x = 0; x < window_px.x; ++x) {
            bool inner = true;
            for (int i = 0; i < 9; ++i) inner = inner && visible_.has(x - 1 + i % 3, y - 1 + i / 3);
            if (!inner && visible_.has(x, y)) border_.emplace_back(x, y);
        }

    // The count grows with the square of the scale, nearly; then rows are added or taken.
    double scale = std::sqrt(share);
    for (int i = 0; i < kSolveSteps; ++i) {
        size_ = size_of(window_px, scale);
        const double found = share_at_axis(size_);
        if (std::abs(found - share) < 1e-4) break;
        scale *= std::sqrt(share / std::max(found, 1e-6));
    }
    size_.y = std::max(kLeastSize, static_cast<int>(std::lround(size_.y * share / share_at_axis(size_))));
}

void LogPolarSampler::find_circles(const LogPolarGrid& grid) {
    circles_.resize(static_cast<std::size_t>(grid.count.x));
    for (int column = 0; column < grid.count.x; ++column) {
        const double radius = radius_px(grid, column);
        const double wide = 0.5 * (radius_px(grid, column + 1) - radius_px(grid, column - 1));
        const double high = 2.0 * std::numbers::pi * radius / grid.count.y;
        // Where samples are closer than pixels, what they show is still a pixel's.
        circles_[static_cast<std::size_t>(column)] = {static_cast<float>(radius),
                                                      static_cast<float>(std::max(1.0, std::sqrt(wide * high)))};
    }
}

void LogPolarSampler::find_rays(const LogPolarGrid& grid) {
    rays_.resize(static_cast<std::size_t>(grid.count.y));
    for (int row = 0; row < grid.count.y; ++row) {
        const double angle_rad = 2.0 * std::numbers::pi * (row + double{grid.phase.y}) / grid.count.y;
        rays_[static_cast<std::size_t>(row)] = {std::cos(angle_rad), std::sin(angle_rad)};
    }
}

double LogPolarSampler::share_at_axis(const glm::ivec2& size) {
    const glm::dvec2 window_px(visible_.width(), visible_.height());
    const LogPolarGrid grid =
        grid_around(gaze_point_px(display_, eye_, {0.0F, 0.0F, -1.0F}), window_px, size, glm::ivec2(0));
    find_circles(grid);
    find_rays(grid);
    std::int64_t inside = 0;
    for (const glm::vec2& ray : rays_)
        for (const Circle& circle : circles_) {
            const glm::vec2 at = grid.centre_px + circle.radius_px * ray;
            inside += static_cast<int>(at.x >= 0.0F) & static_cast<int>(at.y >= 0.0F) &
                      static_cast<int>(at.x < static_cast<float>(window_px.x)) &
                      static_cast<int>(at.y < static_cast<float>(window_px.y));
        }
    return static_cast<double>(inside) / (window_px.x * window_px.y);
}

void LogPolarSampler::plan(const PlanRequest& request, SamplePlan& plan) {
    clear_plan(plan);
    const glm::ivec2 window_px(visible_.width(), visible_.height());
    plan.width_px = window_px.x;
    plan.height_px = window_px.y;
    plan.hidden = hidden_;
    plan.grids.rectangular.clear();
    plan.grids.log_polar =
        grid_around(gaze_point_px(display_, eye_, request.gaze_eye), window_px, size_, request.phase_px);
    find_circles(plan.grids.log_polar);
    find_rays(plan.grids.log_polar);
    traced_.reset(size_.x, size_.y);
    write_samples(plan);
    in_visible_pixel_ = traced_;
    for (const glm::ivec2& pixel : border_) add_cells_of(plan.grids.log_polar, pixel);
    plan.traced_in_window = in_visible_pixel_.count() + count_added_in_window(plan);
    append_samples(traced_, 0, plan);
}

/// Positions of all samples; those in visible pixels are to be traced.
void LogPolarSampler::write_samples(SamplePlan& plan) {
    const std::size_t columns = circles_.size();
    plan.position.resize(columns * rays_.size());
    plan.place.resize(plan.position.size());
    plan.spacing.resize(plan.position.size());
    const glm::vec2 centre_256 = 256.0F * plan.grids.log_polar.centre_px + 0.5F;
    for (std::size_t row = 0; row < rays_.size(); ++row) {
        const glm::vec2 ray_256 = 256.0F * rays_[row];
        SamplePosition* position = &plan.position[row * columns];
        PlaceInPixel* place = &plan.place[row * columns];
        float* spacing = &plan.spacing[row * columns];
        for (std::size_t i = 0; i < columns; ++i) {
            const auto x = static_cast<int>(std::floor(centre_256.x + circles_[i].radius_px * ray_256.x));
            const auto y = static_cast<int>(std::floor(centre_256.y + circles_[i].radius_px * ray_256.y));
            position[i] = {static_cast<std::int16_t>(x >> 8), static_cast<std::int16_t>(y >> 8)};
            place[i] = {static_cast<std::uint8_t>(x & 255), static_cast<std::uint8_t>(y & 255)};
            spacing[i] = circles_[i].spacing_px;
        }
        const std::span<std::uint64_t> words = traced_.row(static_cast<int>(row));
        for (std::size_t i = 0; i < columns; ++i)
            words[i / 64] |= static_cast<std::uint64_t>(visible_.has(position[i].x_px, position[i].y_px)) << i % 64;
    }
}

/// Samples beyond the visible pixels that are inside the window.
std::uint32_t LogPolarSampler::count_added_in_window(const SamplePlan& plan) const {
    std::uint32_t total = 0;
    for (int row = 0; row < traced_.height(); ++row)
        for (std::size_t i = 0; i < traced_.row(row).size(); ++i) {
            std::uint64_t added = traced_.row(row)[i] & ~in_visible_pixel_.row(row)[i];
            for (; added != 0; added &= added - 1) {
                const auto column = 64 * i + static_cast<std::size_t>(std::countr_zero(added));
                const SamplePosition at = plan.position[static_cast<std::size_t>(row) * circles_.size() + column];
                total += at.x_px >= 0 && at.y_px >= 0 && at.x_px < plan.width_px && at.y_px < plan.height_px ? 1 : 0;
            }
        }
    return total;
}

/// Adds the corners of all cells that touch a pixel: a cell that reaches from a visible pixel to where nothing is
/// visible crosses a pixel of the border.
void LogPolarSampler::add_cells_of(const LogPolarGrid& grid, const glm::ivec2& pixel) {
    const glm::dvec2 away = glm::dvec2(pixel) + 0.5 - glm::dvec2(grid.centre_px);
    const double distance = glm::length(away);
    const auto column = [&](double radius) {
        return std::clamp(static_cast<int>(std::floor(column_of(grid, radius))), 0, grid.count.x - 1);
    };
    const int first = column(distance - kHalfDiagonal_px);
    const int last = std::min(column(distance + kHalfDiagonal_px) + 1, grid.count.x - 1);
    int first_row = 0;
    int last_row = grid.count.y - 1;
    if (distance > kHalfDiagonal_px) {
        const double rows_per_rad = grid.count.y / (2.0 * std::numbers::pi);
        const double middle = std::atan2(away.y, away.x) * rows_per_rad - grid.phase.y;
        const double half = std::asin(kHalfDiagonal_px / distance) * rows_per_rad;
        first_row = static_cast<int>(std::floor(middle - half));
        last_row = std::min(static_cast<int>(std::floor(middle + half)) + 1, first_row + grid.count.y - 1);
    }
    for (int row = first_row; row <= last_row; ++row)
        traced_.insert_range((row + 2 * grid.count.y) % grid.count.y, first, last + 1);
}

}  // namespace macula
