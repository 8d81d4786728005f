#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/display.h"
#include "masks/grid_layout.h"
#include "masks/rivals/bit_rows.h"
#include "masks/sample_plan.h"

namespace macula {

/// Places first_px + step_px * k of the window, k all pairs of integers.
struct Lattice {
    glm::dvec2 first_px = glm::dvec2(0.5);
    glm::dvec2 step_px = glm::dvec2(1.0);  ///< at least 1
};

/// Where a grid shows: inside the edges, which may lie beyond the window; over `fade_px` inside them it comes in
/// smoothly.
struct ShownBox {
    glm::dvec2 begin_px = glm::dvec2(-std::numeric_limits<double>::infinity());
    glm::dvec2 end_px = glm::dvec2(std::numeric_limits<double>::infinity());
    double fade_px = 0.0;
};

/// A lattice that moves within its cells from frame to frame, so that the client's accumulation over time sees all of
/// the picture: pixel centres at a step of 1, whatever the phase.
Lattice lattice_of(const glm::dvec2& step_px, const glm::ivec2& phase_px);

/// Lays out what a window needs of a lattice to interpolate it in a box. Sets everything but the offset.
void place_grid(const Lattice& lattice, const ShownBox& box, const glm::ivec2& window_px, RectangularGrid& grid);

/// Makes plans of rectangular grids: traces a sample if a visible pixel interpolates it, and nothing else. Samples
/// under a finer grid, and those beyond the window that its edge does not need, are not traced.
class RectangularPlanner {
public:
    RectangularPlanner(const Display& display, Eye eye);

    /// Fills everything else of a plan whose grids are placed.
    void plan(SamplePlan& plan);

    /// Samples inside the window that would be traced if the lens hid nothing.
    [[nodiscard]] std::uint32_t count_in_window(std::span<const RectangularGrid> grids);

private:
    void find_traced(std::span<const RectangularGrid> grids, std::size_t grid, const BitRows& pixels);
    [[nodiscard]] std::uint32_t count_traced_in_window(const RectangularGrid& grid) const;
    void write_positions(SamplePlan& plan, const RectangularGrid& grid);

    glm::ivec2 window_px_;
    BitRows all_;
    BitRows visible_;
    std::shared_ptr<const std::vector<std::uint8_t>> hidden_;  ///< null: nothing
    // Scratch.
    BitRows column_shown_;  ///< row g: pixel columns in which grid g shows
    BitRows column_whole_;  ///< and in which it covers what is under it
    BitRows readers_;       ///< row k: pixel columns in which a pixel reads sample row k
    BitRows traced_;
    std::vector<int> column_256_;  ///< of samples, in 1/256 px
};

}  // namespace macula
