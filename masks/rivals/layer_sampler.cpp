#include "masks/rivals/layer_sampler.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "masks/rivals/gaze_point.h"

namespace macula {
namespace {

constexpr double kFlattest = 1e-5;
constexpr double kSteepest = 10.0;
constexpr int kHalvings = 40;

}  // namespace

LayerSampler::LayerSampler(const Display& display, Eye eye, double share, const LinearMar& law)
    : display_(display),
      eye_(eye),
      window_px_(display.eye_width_px, display.eye_height_px),
      planner_(display, eye),
      full_(share >= 1.0),
      law_(law) {
    if (full_) return;
    // The count goes by whole rows and columns, and is not quite monotonic: of all slopes tried the nearest is kept.
    std::vector<RectangularGrid> grids;
    double low = std::log(kFlattest);
    double high = std::log(kSteepest);
    std::optional<double> nearest;
    LinearMar best = law_;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        law_.slope = std::exp(middle);
        layers_ = choose_layers(display_, eye_, law_);
        const double excess = share_at_axis(grids) - share;
        (excess > 0.0 ? low : high) = middle;
        if (nearest && std::abs(excess) >= *nearest) continue;
        nearest = std::abs(excess);
        best = law_;
    }
    law_ = best;
    layers_ = choose_layers(display_, eye_, law_);
}

double LayerSampler::share_at_axis(std::vector<RectangularGrid>& grids) {
    place_layers({}, grids);
    return static_cast<double>(planner_.count_in_window(grids)) / (static_cast<double>(window_px_.x) * window_px_.y);
}

void LayerSampler::place_layers(const PlanRequest& request, std::vector<RectangularGrid>& grids) const {
    if (full_) {
        grids.resize(1);
        place_grid({}, {}, window_px_, grids.front());
        return;
    }
    grids.resize(layers_.step_px.size());
    for (std::size_t i = 0; i < grids.size(); ++i) {
        ShownBox shown;
        if (i < layers_.radius_rad.size()) {
            const auto box = box_around_gaze(display_, eye_, request.gaze_eye, layers_.radius_rad[i]);
            shown.begin_px = box ? box->begin_px : glm::dvec2(0.0);
            shown.end_px = box ? box->end_px : glm::dvec2(0.0);
            shown.fade_px = kFadeSamples * layers_.step_px[i + 1];
        }
        place_grid(lattice_of(glm::dvec2(layers_.step_px[i]), request.phase_px), shown, window_px_, grids[i]);
    }
}

void LayerSampler::plan(const PlanRequest& request, SamplePlan& plan) {
    place_layers(request, plan.grids.rectangular);
    planner_.plan(plan);
}

}  // namespace macula
