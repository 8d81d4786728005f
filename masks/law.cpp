#include "masks/law.h"

#include <algorithm>
#include <cmath>

#include "masks/level_map.h"

namespace macula {

double cutoff_frequency_cpd(const AcuityLaw& law, double eccentricity_deg) {
    return cutoff_frequency_cpd(law.model, std::max(0.0, eccentricity_deg - law.full_acuity_deg) / law.stretch);
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

double tile_share(const Display& display, Eye eye, const AcuityLaw& law) {
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

std::optional<AcuityLaw> tile_law(const Display& display, Eye eye, const SamplingPreset& preset) {
    if (preset.full) return std::nullopt;
    return solve_law(preset, [&](const AcuityLaw& law) { return tile_share(display, eye, law); });
}

}  // namespace macula
