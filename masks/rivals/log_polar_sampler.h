#pragma once

#include <memory>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/display.h"
#include "masks/grid_layout.h"
#include "masks/rivals/bit_rows.h"
#include "masks/sample_plan.h"
#include "protocol/base/error.h"

namespace macula {

/// Kernel log-polar sampling (Meng, Du, Zwicker and Varshney, Kernel Foveated Rendering, 2018): a buffer whose columns
/// are circles around the gaze and whose rows are rays from it, of the window's shape and 1/sigma of its size.
///
/// A point at distance r of the gaze and angle a lies at column w (ln r / L)^alpha and row h a / (2 pi), where L is ln
/// of the distance of the farthest corner. alpha is 4, the value that the authors' study chose; theirs is sigma 1.8,
/// while here sigma is solved for the share. In which of the two directions the kernel function x^alpha applies is
/// written in both ways by those who have followed the paper; this is how the authors' own program has it
/// (github.com/xmeng525/KernelFoveatedRendering_Unity, Pass1 and Pass2), and the other way half of all columns would
/// lie within two pixels of the gaze. Here the first column is the circle of one pixel and the last one goes through
/// the farthest corner.
///
/// There is no full resolution: however many samples there are, they do not lie at the centres of pixels, and near the
/// gaze columns are farther apart than pixels (1, 3.7, 4.7 px with 840 columns) while rows are far closer.
///
/// Left out is the paper's blur of the buffer's outer part, 3x3, which is a filter on top of the method; the client
/// filters over time whatever the method. The request's phase turns and widens the circles within their distance.
///
/// Traced are samples that lie in visible pixels, and beyond those the corners of cells that touch one.
class LogPolarSampler final : public Sampler {
public:
    /// `share` of the buffer's pixels, hidden ones included, while the gaze is on the axis.
    /// Errors: `option` for shares that are not between 0 and 1.
    static Expected<std::unique_ptr<LogPolarSampler>> make(const Display& display, Eye eye, double share);

    void plan(const PlanRequest& request, SamplePlan& plan) override;

    /// Columns and rows of the buffer.
    [[nodiscard]] glm::ivec2 size() const { return size_; }

private:
    LogPolarSampler(const Display& display, Eye eye, double share);

    /// One column.
    struct Circle {
        float radius_px = 0.0F;
        float spacing_px = 0.0F;
    };
    void find_circles(const LogPolarGrid& grid);
    void find_rays(const LogPolarGrid& grid);
    [[nodiscard]] double share_at_axis(const glm::ivec2& size);
    void write_samples(SamplePlan& plan);
    [[nodiscard]] std::uint32_t count_added_in_window(const SamplePlan& plan) const;
    void add_cells_of(const LogPolarGrid& grid, const glm::ivec2& pixel);

    Display display_;
    Eye eye_;
    glm::ivec2 size_ = glm::ivec2(0);
    BitRows visible_;
    std::shared_ptr<const std::vector<std::uint8_t>> hidden_;  ///< null: nothing
    std::vector<glm::ivec2> border_;  ///< visible pixels next to one that is hidden or beyond the window
    // Scratch.
    std::vector<Circle> circles_;
    std::vector<glm::vec2> rays_;  ///< unit vectors
    BitRows traced_;               ///< of the buffer
    BitRows in_visible_pixel_;     ///< of those
};

}  // namespace macula
