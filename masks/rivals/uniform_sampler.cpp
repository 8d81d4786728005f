#include "masks/rivals/uniform_sampler.h"

#include <algorithm>
#include <cmath>

namespace macula {
namespace {

glm::ivec2 size_of(const glm::ivec2& window_px, double share) {
    if (share >= 1.0) return window_px;
    const int columns = std::clamp(static_cast<int>(std::lround(std::sqrt(share) * window_px.x)), 1, window_px.x);
    const double rows = share * window_px.x * window_px.y / columns;
    return {columns, std::clamp(static_cast<int>(std::lround(rows)), 1, window_px.y)};
}

}  // namespace

UniformSampler::UniformSampler(const Display& display, Eye eye, double share)
    : window_px_(display.eye_width_px, display.eye_height_px),
      size_(size_of(window_px_, share)),
      planner_(display, eye) {}

void UniformSampler::plan(const PlanRequest& request, SamplePlan& plan) {
    plan.grids.rectangular.resize(1);
    const Lattice lattice = lattice_of(glm::dvec2(window_px_) / glm::dvec2(size_), request.phase_px);
    place_grid(lattice, {}, window_px_, plan.grids.rectangular.front());
    planner_.plan(plan);
}

}  // namespace macula
