#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/levels.h"
#include "masks/make/recipe.h"

namespace macula {

/// Least share of the pixels that a mask samples anywhere: that of the sparsest tile level, 1.6 %.
inline constexpr double kLeastDensity = 1.0 * kLevelCounts[1] / kTileArea_px;

/// Where a mask's pixels lie as seen from the gaze, by the recipe's geometry (recipe.h).
class MaskField {
public:
    MaskField(const Display& display, MaskGeometry geometry);

    /// Degrees, 0..180, between the gaze and a pixel whose centre lies `offset_px` (x right, y down) from that of the
    /// gaze's pixel.
    [[nodiscard]] double eccentricity_deg(glm::dvec2 offset_px) const;
    /// Root of the pixels per square degree there.
    [[nodiscard]] double px_per_deg(double eccentricity_deg) const;

private:
    MaskGeometry geometry_;
    glm::dvec2 px_per_tangent_;
    double axis_px_per_deg_;
};

/// How many pixels of the window lie at each eccentricity while the gaze is on the axis. With it, shares of many laws
/// are found quickly.
class WindowHistogram {
public:
    WindowHistogram(const Display& display, const MaskField& field);

    /// Mean over the window's pixels, hidden ones included, of a function of eccentricity in degrees that is linear
    /// within a bin (.044 degrees or less).
    template <class Function>
    [[nodiscard]] double mean(Function&& of_eccentricity_deg) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < pixels_.size(); ++i)
            if (pixels_[i] > 0.0) sum += pixels_[i] * of_eccentricity_deg(static_cast<double>(i) * bin_deg_);
        return sum / total_;
    }

private:
    double bin_deg_;
    double total_;
    std::vector<double> pixels_;  ///< by multiples of the bin's width; a pixel counts for its two neighbours
};

/// Share of the pixels that a mask's recipe asks for at an eccentricity: what the law needs, and kLeastDensity at
/// least.
double wished_density(const MaskField& field, const AcuityLaw& law, double eccentricity_deg);

/// The recipe's law with what its preset leaves free solved, so that the placement samples the preset's share of the
/// window while the gaze is on the axis. Not for `full`. Shares out of reach give the nearest.
AcuityLaw mask_law(const Recipe& recipe);

/// Wished density of each pixel of a mask.
struct DensityMap {
    int width_px = 0;
    int height_px = 0;
    std::vector<float> density;  ///< row-major, kLeastDensity..1

    [[nodiscard]] float at(int x, int y) const { return density[static_cast<std::size_t>(y) * width_px + x]; }
};

/// wished_density of a mask of `size_px` pixels whose gaze lies at `gaze_px`.
DensityMap make_density_map(const MaskField& field, const AcuityLaw& law, glm::ivec2 size_px, glm::ivec2 gaze_px);

}  // namespace macula
