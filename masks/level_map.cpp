#include "masks/level_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace macula {
namespace {

/// The table reaches 180 degrees before stretching. A step of 1/4 degree puts the kink of the ring map on an entry.
constexpr double kEntriesPerDegree = 4.0;
constexpr int kEntries = 180 * 4;

/// Stands for any distance of samples that is much wider than the image, also where nothing is seen at all.
constexpr double kMostSpacing_deg = 1e3;

/// Arc cosine to 1e-6 rad and vectorisable (Abramowitz and Stegun 4.4.46).
inline float arc_cosine(float x) {
    const float m = std::min(std::abs(x), 1.0F);
    float p = -0.0012624911F;
    p = p * m + 0.0066700901F;
    p = p * m - 0.0170881256F;
    p = p * m + 0.0308918810F;
    p = p * m - 0.0501743046F;
    p = p * m + 0.0889789874F;
    p = p * m - 0.2145988016F;
    p = p * m + 1.5707963050F;
    const float angle = p * std::sqrt(1.0F - m);
    return x < 0.0F ? std::numbers::pi_v<float> - angle : angle;
}

}  // namespace

// The need at a tile is p = (2 fc / ppd)^x with ppd = c q^(3/4), q = 1 / cos^2 of the angle from the axis. Its root is
// the inverse of the spacing u = m c q^(3/4), where m = 1 / (2 fc) is the distance of the samples in degrees, so that
// p > b is u < b^(-1/x): levels follow from comparing u with constants, and nothing is raised to a power. m c is
// interpolated between the entries of a table by eccentricity. Between its kinks m is a straight line in most laws, for
// which that is exact.
LevelMap::LevelMap(const Display& display, Eye eye, const AcuityLaw& law, double hysteresis)
    : full_acuity_deg_(law.full_acuity_deg), spacing_at_(kEntries), spacing_rise_(kEntries) {
    const Tangents& edge = display.eyes[eye].tangents;
    tangent_at_zero_px_ = {edge.left, edge.top};
    tangent_per_px_ = {(edge.right - edge.left) / static_cast<float>(display.eye_width_px),
                       (edge.bottom - edge.top) / static_cast<float>(display.eye_height_px)};
    const double px_per_deg = pixels_per_degree(display, eye, 0.0, 0.0);
    const auto spacing_at = [&](int entry) {
        const double cutoff_cpd = cutoff_frequency_cpd(law.model, entry / kEntriesPerDegree);
        return px_per_deg * std::min(0.5 / cutoff_cpd, kMostSpacing_deg);
    };
    double next = spacing_at(0);
    for (int i = 0; i < kEntries; ++i) {
        const double here = next;
        next = spacing_at(i + 1);
        // Where sight ends between two entries, it does so at the second.
        const bool ends = next >= px_per_deg * kMostSpacing_deg;
        spacing_at_[i] = static_cast<float>(here);
        spacing_rise_[i] = ends ? 0.0F : static_cast<float>(next - here);
    }
    set_stretch(law.stretch);
    for (int level = 1; level < kFullLevel; ++level) {
        const double boundary = std::sqrt(1.0 * kLevelCounts[level] * kLevelCounts[level + 1]) / kTileArea_px;
        rise_[level - 1] = static_cast<float>(std::pow(boundary, -1.0 / law.exponent));
        keep_[level - 1] = static_cast<float>(std::pow(hysteresis * boundary, -1.0 / law.exponent));
    }
}

void LevelMap::set_stretch(double stretch) {
    const double steps_per_deg = kEntriesPerDegree / stretch;
    steps_per_rad_ = static_cast<float>(steps_per_deg * 180.0 / std::numbers::pi);
    full_steps_ = static_cast<float>(steps_per_deg * full_acuity_deg_);
}

void LevelMap::update(const TileGrid& grid, const glm::vec3& gaze_eye, std::uint8_t* levels, int stride) {
    const auto columns = static_cast<std::size_t>(grid.tiles.x);
    steps_.resize(columns);
    spacing_.resize(columns);
    risen_.resize(columns);
    kept_.resize(columns);
    for (int row = 0; row < grid.tiles.y; ++row)
        update_row(grid, row, gaze_eye, levels + static_cast<std::ptrdiff_t>(row) * stride);
}

void LevelMap::update_row(const TileGrid& grid, int row, const glm::vec3& gaze_eye, std::uint8_t* levels) {
    const int columns = grid.tiles.x;
    const glm::vec2 first_centre_px = glm::vec2(grid.origin_px) + 0.5F * kTileEdge_px;
    const float tan_y =
        tangent_at_zero_px_.y + tangent_per_px_.y * (first_centre_px.y + static_cast<float>(row * kTileEdge_px));
    const float first_tan_x = tangent_at_zero_px_.x + tangent_per_px_.x * first_centre_px.x;
    const float step = tangent_per_px_.x * kTileEdge_px;
    const float along_row = gaze_eye.y * tan_y - gaze_eye.z;

    // Plain loops over arrays, each of which the compiler vectorises.
    float* steps = steps_.data();
    float* spacing = spacing_.data();
    std::int32_t* risen = risen_.data();
    std::int32_t* kept = kept_.data();
    for (int i = 0; i < columns; ++i) {
        const float tan_x = first_tan_x + step * static_cast<float>(i);
        const float q = 1.0F + tan_x * tan_x + tan_y * tan_y;
        const float root = std::sqrt(q);
        const float eccentricity_rad = arc_cosine((gaze_eye.x * tan_x + along_row) / root);
        steps[i] = std::max(steps_per_rad_ * eccentricity_rad - full_steps_, 0.0F);
        spacing[i] = root * std::sqrt(root);
        risen[i] = 1;
        kept[i] = 1;
    }
    const float* at = spacing_at_.data();
    const float* rise_after = spacing_rise_.data();
    for (int i = 0; i < columns; ++i) {
        // Beyond the table its last line goes on.
        const auto entry = static_cast<std::int32_t>(std::min(steps[i], static_cast<float>(kEntries - 1)));
        spacing[i] *= at[entry] + rise_after[entry] * (steps[i] - static_cast<float>(entry));
    }
    for (std::size_t l = 0; l < rise_.size(); ++l) {
        const float rise = rise_[l];
        const float keep = keep_[l];
        for (int i = 0; i < columns; ++i) {
            risen[i] += spacing[i] < rise ? 1 : 0;
            kept[i] += spacing[i] <= keep ? 1 : 0;
        }
    }
    for (int i = 0; i < columns; ++i)
        levels[i] = static_cast<std::uint8_t>(std::max(risen[i], std::min<std::int32_t>(levels[i], kept[i])));
}

}  // namespace macula
