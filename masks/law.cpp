#include "masks/law.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "masks/level_map.h"

namespace macula {
namespace {

/// Share of the buffer's pixels that the levels of a gaze on the axis sample, hidden pixels included.
double planned_share(const Display& display, Eye eye, const AcuityLaw& law) {
    const glm::ivec2 size_px(display.eye_width_px, display.eye_height_px);
    const TileGrid grid(size_px, glm::ivec2(0));
    std::vector<std::uint8_t> levels(static_cast<std::size_t>(grid.tiles.x) * grid.tiles.y);
    LevelMap(display, eye, law).update(grid, {0.0F, 0.0F, -1.0F}, levels.data(), grid.tiles.x);
    double samples = 0.0;
    for (int y = 0; y < grid.tiles.y; ++y) {
        for (int x = 0; x < grid.tiles.x; ++x) {
            // Tiles at the right and bottom edge may lie in the window with a part only.
            const glm::ivec2 inside = glm::min(glm::ivec2(kTileEdge_px), size_px - kTileEdge_px * glm::ivec2(x, y));
            samples += 1.0 * kLevelCounts[levels[y * grid.tiles.x + x]] * inside.x * inside.y / kTileArea_px;
        }
    }
    return samples / (1.0 * size_px.x * size_px.y);
}

}  // namespace

double cutoff_frequency_cpd(const AcuityLaw& law, double eccentricity_deg) {
    const double beyond_deg = std::max(0.0, eccentricity_deg - law.full_acuity_deg);
    return law.e2_deg * std::log(1.0 / law.contrast) / (law.alpha_deg * (beyond_deg + law.e2_deg));
}

double needed_share(const AcuityLaw& law, double eccentricity_deg, double px_per_deg) {
    return std::min(1.0, std::pow(2.0 * cutoff_frequency_cpd(law, eccentricity_deg) / px_per_deg, law.exponent));
}

double pixels_per_degree(const Display& display, Eye eye, double tangent_x, double tangent_y) {
    const Tangents& edge = display.eyes[eye].tangents;
    const double px_per_tangent_x = display.eye_width_px / (double{edge.right} - edge.left);
    const double px_per_tangent_y = display.eye_height_px / (double{edge.top} - edge.bottom);
    const double inverse_cosine_squared = 1.0 + tangent_x * tangent_x + tangent_y * tangent_y;
    return std::numbers::pi / 180.0 * std::sqrt(px_per_tangent_x * px_per_tangent_y) *
           std::pow(inverse_cosine_squared, 0.75);
}

Expected<SamplingPreset> parse_sampling(const std::string& text) {
    if (text == "full") return SamplingPreset{true, 1.0};
    double percent = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || !(percent >= 1.0 && percent <= 99.0))
        return fail(ErrorCode::option, "sampling '" + text +
                                           "' is unknown: use full, or the percentage of pixels to trace, 1 to 99 "
                                           "(54, 41, 27 and 18 are the published ones)");
    return SamplingPreset{false, percent / 100.0};
}

AcuityLaw solve_law(const Display& display, Eye eye, double share, AcuityLaw shape) {
    double low = 1e-3;
    double high = 1e3;
    for (int i = 0; i < 48; ++i) {
        shape.e2_deg = std::sqrt(low * high);
        (planned_share(display, eye, shape) < share ? low : high) = shape.e2_deg;
    }
    return shape;
}

}  // namespace macula
