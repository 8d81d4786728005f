// A mask is drawn for one gaze and moved to others, which is not exact on a planar display. How much of the density
// that the law needs is left, measured on the samples that the sampler traces.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "masks/law.h"
#include "masks/make/density.h"
#include "masks/make/mesh_store.h"
#include "masks/mesh/mesh_sampler.h"

namespace macula {
namespace {

constexpr int kCell_px = 24;
/// Of fewer samples the count says little.
constexpr double kFewest = 60.0;

/// The vive's optics at a third of its pixels.
Display small_vive() {
    Display display = load_display("vive").value();
    display.eye_width_px /= 3;
    display.eye_height_px /= 3;
    return display;
}

/// Geisler and Perry's law for eyes a third as sharp: needs on the small display what the law needs on the vive.
SamplingPreset third_of_geisler_perry() {
    return parse_sampling("law:alpha=0.318").value();
}

class OffAxis {
public:
    explicit OffAxis(MaskGeometry geometry) {
        Recipe recipe;
        recipe.display = display_;
        recipe.preset = third_of_geisler_perry();
        recipe.geometry = geometry;
        law_ = mask_law(recipe);
        const Mask mask = make_mask(recipe).value();
        sampler_ = std::make_unique<MeshSampler>(
            display_, kLeftEye, std::make_shared<const MeshTable>(MeshTable::make(triangulate_mask(mask)).value()));
    }

    /// Traced samples over what the law needs, of the cell of the window where that is least, for a gaze so far to the
    /// right. Cells with hidden pixels do not count, nor those of few samples.
    [[nodiscard]] double least_density(double gaze_deg) const {
        const double tangent = std::tan(gaze_deg * std::numbers::pi / 180.0);
        const glm::dvec3 gaze = glm::normalize(glm::dvec3(tangent, 0.0, -1.0));
        SamplePlan plan;
        sampler_->plan({glm::vec3(gaze), glm::ivec2(0)}, plan);
        const int columns = plan.width_px / kCell_px;
        const int rows = plan.height_px / kCell_px;
        std::vector<int> traced(static_cast<std::size_t>(columns * rows));
        for (const SamplePosition& p : plan.position) {
            if (p.x_px < 0 || p.y_px < 0 || p.x_px >= columns * kCell_px || p.y_px >= rows * kCell_px) continue;
            ++traced[static_cast<std::size_t>(p.y_px / kCell_px * columns + p.x_px / kCell_px)];
        }
        double least = 1e9;
        for (int cell = 0; cell < columns * rows; ++cell) {
            const double needed =
                needed_samples(gaze, kCell_px * glm::ivec2(cell % columns, cell / columns), *plan.hidden);
            if (needed > kFewest) least = std::min(least, traced[static_cast<std::size_t>(cell)] / needed);
        }
        return least;
    }

private:
    /// Of the cell with that corner; 0 if a pixel is hidden.
    [[nodiscard]] double needed_samples(const glm::dvec3& gaze, glm::ivec2 corner,
                                        const std::vector<std::uint8_t>& hidden) const {
        constexpr int kStride_px = 4;  // needs change slowly
        const Tangents& edge = display_.eyes[kLeftEye].tangents;
        double needed = 0.0;
        for (int y = corner.y; y < corner.y + kCell_px; ++y) {
            for (int x = corner.x; x < corner.x + kCell_px; ++x) {
                if (hidden[static_cast<std::size_t>(y * display_.eye_width_px + x)] != 0) return 0.0;
                if (x % kStride_px != 2 || y % kStride_px != 2) continue;
                const double u = edge.left + x / (1.0 * display_.eye_width_px) * (double{edge.right} - edge.left);
                const double v = edge.top - y / (1.0 * display_.eye_height_px) * (double{edge.top} - edge.bottom);
                const double cosine = glm::dot(glm::normalize(glm::dvec3(u, v, -1.0)), gaze);
                const double away_deg = std::acos(std::min(cosine, 1.0)) * 180.0 / std::numbers::pi;
                needed +=
                    kStride_px * kStride_px * needed_share(law_, away_deg, pixels_per_degree(display_, kLeftEye, u, v));
            }
        }
        return needed;
    }

    Display display_ = small_vive();
    AcuityLaw law_;
    std::unique_ptr<MeshSampler> sampler_;
};

// The figures are those of the law and the projection alone; a cell's count of samples is off by a few per cent, and
// a cell is not as low as its lowest pixel.

TEST(MeshOffAxis, AFlatMaskKeepsMostOfTheDensity) {
    const OffAxis flat(MaskGeometry::flat);
    EXPECT_GT(flat.least_density(0.0), 0.95);
    EXPECT_NEAR(flat.least_density(20.0), 0.92, 0.06);
    EXPECT_NEAR(flat.least_density(30.0), 0.81, 0.06);
    EXPECT_NEAR(flat.least_density(40.0), 0.67, 0.06);
}

TEST(MeshOffAxis, APlanarMaskIsRightOnTheAxisAndHalvesTheDensityOffIt) {
    const OffAxis planar(MaskGeometry::planar);
    EXPECT_GT(planar.least_density(0.0), 0.9);
    EXPECT_NEAR(planar.least_density(30.0), 0.61, 0.06);
}

}  // namespace
}  // namespace macula
