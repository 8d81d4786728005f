#include "masks/make/density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "masks/make/mask.h"
#include "masks/make/placement.h"

namespace macula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kNodes = 4096;  // of a density by eccentricity: .044 degrees apart, half a pixel of a Vive

/// A density tabulated by eccentricity and linear in between: powers and logarithms are slow to take per pixel.
class DensityCurve {
public:
    DensityCurve(const MaskField& field, const AcuityLaw& law, double widest_deg)
        : node_per_deg_(kNodes / std::max(widest_deg, 1e-6)), node_(kNodes + 2) {
        for (int i = 0; i < kNodes + 2; ++i)
            node_[i] = static_cast<float>(wished_density(field, law, i / node_per_deg_));
    }

    [[nodiscard]] float at(double eccentricity_deg) const {
        const double place = eccentricity_deg * node_per_deg_;
        const int below = std::min(static_cast<int>(place), kNodes);
        return node_[below] + static_cast<float>(place - below) * (node_[below + 1] - node_[below]);
    }

private:
    double node_per_deg_;
    std::vector<float> node_;
};

/// Eccentricity of the farthest of four corners.
double widest_deg(const MaskField& field, glm::ivec2 size_px, glm::ivec2 gaze_px) {
    return field.eccentricity_deg(glm::max(glm::dvec2(gaze_px), glm::dvec2(size_px - 1 - gaze_px)));
}

}  // namespace

MaskField::MaskField(const Display& display, MaskGeometry geometry)
    : geometry_(geometry), axis_px_per_deg_(pixels_per_degree(display, kLeftEye, 0.0, 0.0)) {
    const Tangents& edge = display.eyes[kLeftEye].tangents;
    px_per_tangent_ = {display.eye_width_px / (double{edge.right} - edge.left),
                       display.eye_height_px / (double{edge.top} - edge.bottom)};
}

double MaskField::eccentricity_deg(glm::dvec2 offset_px) const {
    const double tangent = glm::length(offset_px / px_per_tangent_);
    return geometry_ == MaskGeometry::planar ? std::atan(tangent) / kDegree : std::min(tangent / kDegree, 180.0);
}

double MaskField::px_per_deg(double eccentricity_deg) const {
    if (geometry_ == MaskGeometry::flat) return axis_px_per_deg_;
    return axis_px_per_deg_ * std::pow(std::max(std::cos(eccentricity_deg * kDegree), 1e-6), -1.5);
}

WindowHistogram::WindowHistogram(const Display& display, const MaskField& field)
    : total_(1.0 * display.eye_width_px * display.eye_height_px), pixels_(kNodes + 2) {
    const glm::ivec2 size_px(display.eye_width_px, display.eye_height_px);
    const glm::ivec2 gaze_px = axis_px(display, kLeftEye);
    bin_deg_ = std::max(widest_deg(field, size_px, gaze_px), 1e-6) / kNodes;
    for (int y = 0; y < size_px.y; ++y) {
        for (int x = 0; x < size_px.x; ++x) {
            const double place = field.eccentricity_deg(glm::dvec2(x, y) - glm::dvec2(gaze_px)) / bin_deg_;
            const int below = std::min(static_cast<int>(place), kNodes);
            pixels_[below] += 1.0 - (place - below);
            pixels_[below + 1] += place - below;
        }
    }
}

double wished_density(const MaskField& field, const AcuityLaw& law, double eccentricity_deg) {
    return std::max(kLeastDensity, needed_share(law, eccentricity_deg, field.px_per_deg(eccentricity_deg)));
}

AcuityLaw mask_law(const Recipe& recipe) {
    const MaskField field(recipe.display, recipe.geometry);
    const WindowHistogram window(recipe.display, field);
    return solve_law(recipe.preset, [&](const AcuityLaw& law) {
        return window.mean([&](double eccentricity_deg) {
            return placed_density(recipe.placement, wished_density(field, law, eccentricity_deg));
        });
    });
}

DensityMap make_density_map(const MaskField& field, const AcuityLaw& law, glm::ivec2 size_px, glm::ivec2 gaze_px) {
    DensityMap map{size_px.x, size_px.y, std::vector<float>(static_cast<std::size_t>(size_px.x) * size_px.y)};
    const DensityCurve curve(field, law, widest_deg(field, size_px, gaze_px));
    float* out = map.density.data();
    for (int y = 0; y < size_px.y; ++y) {
        for (int x = 0; x < size_px.x; ++x)
            *out++ = curve.at(field.eccentricity_deg(glm::dvec2(x, y) - glm::dvec2(gaze_px)));
    }
    return map;
}

}  // namespace macula
