#include "masks/rivals/layer_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "masks/rivals/gaze_point.h"

namespace macula {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kRadiiTried = 48;
constexpr int kRefinements = 40;

class SampleEstimate {
public:
    SampleEstimate(const Display& display, Eye eye, const LinearMar& law)
        : display_(display),
          eye_(eye),
          law_(law),
          window_px_(display.eye_width_px, display.eye_height_px),
          cycle_deg_(kDegrees * std::atan(2.0 * pixel_tangent(display, eye))) {
        const Tangents& edge = display.eyes[eye].tangents;
        farthest_rad_ = std::atan(std::max(std::max(std::abs(edge.left), std::abs(edge.right)),
                                           std::max(std::abs(edge.bottom), std::abs(edge.top))));
    }

    /// Eccentricity at which the law begins to ask for less than all pixels, and that which reaches every edge.
    [[nodiscard]] double least_radius_rad() const {
        return std::clamp((cycle_deg_ - law_.foveal_deg) / law_.slope / kDegrees, 0.0, farthest_rad_);
    }
    [[nodiscard]] double farthest_rad() const { return farthest_rad_; }

    [[nodiscard]] LayerChoice choice(double inner_rad, double middle_rad) const {
        LayerChoice layers;
        layers.radius_rad = {inner_rad, middle_rad};
        layers.step_px = {1.0, step_px(inner_rad), step_px(middle_rad)};
        const double inner = area_px(inner_rad, 0.0);
        const double middle = area_px(middle_rad, 0.0) - area_px(inner_rad, kFadeSamples * layers.step_px[1]);
        const double outer = window_px_.x * window_px_.y - area_px(middle_rad, kFadeSamples * layers.step_px[2]);
        layers.samples =
            inner + middle / (layers.step_px[1] * layers.step_px[1]) + outer / (layers.step_px[2] * layers.step_px[2]);
        return layers;
    }

private:
    [[nodiscard]] double step_px(double radius_rad) const {
        return std::max(1.0, (law_.foveal_deg + law_.slope * radius_rad * kDegrees) / cycle_deg_);
    }
    /// Part of the window inside a square around the axis that is smaller by a margin on each side.
    [[nodiscard]] double area_px(double radius_rad, double margin_px) const {
        const double reach = std::tan(radius_rad);
        const glm::dvec2 first = window_point_px(display_, eye_, {-reach, reach}) + margin_px;
        const glm::dvec2 last = window_point_px(display_, eye_, {reach, -reach}) - margin_px;
        const glm::dvec2 size =
            glm::max(glm::min(last, window_px_) - glm::max(first, glm::dvec2(0.0)), glm::dvec2(0.0));
        return size.x * size.y;
    }

    const Display& display_;
    Eye eye_;
    LinearMar law_;
    glm::dvec2 window_px_;
    double cycle_deg_;
    double farthest_rad_ = 0.0;
};

}  // namespace

LayerChoice choose_layers(const Display& display, Eye eye, const LinearMar& law) {
    const SampleEstimate estimate(display, eye, law);
    const double least = estimate.least_radius_rad();
    const double most = estimate.farthest_rad();
    double step = (most - least) / kRadiiTried;
    LayerChoice best = estimate.choice(most, most);
    const auto try_radii = [&](double inner, double middle) {
        inner = std::clamp(inner, least, most);
        const LayerChoice tried = estimate.choice(inner, std::clamp(middle, inner, most));
        if (tried.samples < best.samples) best = tried;
    };
    for (int i = 0; i <= kRadiiTried; ++i)
        for (int j = i; j <= kRadiiTried; ++j) try_radii(least + i * step, least + j * step);
    for (int i = 0; i < kRefinements; ++i) {
        const auto [inner, middle] = best.radius_rad;
        const double before = best.samples;
        for (const glm::dvec2 move : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)})
            try_radii(inner + step * move.x, middle + step * move.y);
        if (best.samples >= before) step *= 0.5;
    }
    return best;
}

}  // namespace macula
