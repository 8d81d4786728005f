#pragma once

#include <glm/vec2.hpp>

#include "masks/display.h"
#include "masks/rivals/rectangular_plan.h"
#include "masks/sample_plan.h"

namespace macula {

/// Uniform subsampling: a smaller picture of the whole window, whatever the gaze.
///
/// The columns and rows of samples are spaced evenly and as nearly alike as whole numbers of them allow. They move with
/// the request's phase within their cells, as those of a renderer that jitters its projection.
class UniformSampler final : public Sampler {
public:
    /// `share` of the buffer's pixels, hidden ones included, above 0; 1: a sample at every pixel's centre.
    UniformSampler(const Display& display, Eye eye, double share);

    void plan(const PlanRequest& request, SamplePlan& plan) override;

    /// Columns and rows of samples inside the window.
    [[nodiscard]] glm::ivec2 size() const { return size_; }

private:
    glm::ivec2 window_px_;
    glm::ivec2 size_;
    RectangularPlanner planner_;
};

}  // namespace macula
