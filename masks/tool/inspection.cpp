#include "masks/tool/inspection.h"

#include <algorithm>
#include <cmath>

#include "masks/make/density.h"

namespace macula {
namespace {

std::vector<double> usual_edges_deg(double farthest_deg) {
    std::vector<double> edges;
    for (const double edge : {0.0, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 80.0, 100.0,
                              120.0, 140.0, 160.0})
        if (edge < farthest_deg) edges.push_back(edge);
    edges.push_back(farthest_deg);
    return edges;
}

double farthest_deg(const MaskField& field, const Mask& mask) {
    const glm::ivec2 last_px(mask.width_px - 1, mask.height_px - 1);
    return field.eccentricity_deg(glm::dvec2(glm::max(mask.gaze_px, last_px - mask.gaze_px)));
}

/// Radius of the circle on which an eccentricity lies; where pixels are not square, of the one of the same area.
double radius_px(const MaskField& field, double eccentricity_deg) {
    const auto along = [&](glm::dvec2 axis) {
        double low = 0.0;
        double high = 65536.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (field.eccentricity_deg(middle * axis) < eccentricity_deg ? low : high) = middle;
        }
        return low;  // so that pixels on an edge belong to the ring that it begins
    };
    return std::sqrt(along({1.0, 0.0}) * along({0.0, 1.0}));
}

void count_pixels(const Mask& mask, const MaskField& field, const InspectionBasis& basis,
                  const std::vector<double>& edges_deg, std::vector<InspectedRing>& rings) {
    std::vector<double> wanted(rings.size());
    DensityMap map;
    if (!basis.full && basis.law)
        map = make_density_map(field, *basis.law, {mask.width_px, mask.height_px}, mask.gaze_px);
    for (int y = 0; y < mask.height_px; ++y) {
        for (int x = 0; x < mask.width_px; ++x) {
            const double eccentricity_deg = field.eccentricity_deg(glm::dvec2(glm::ivec2(x, y) - mask.gaze_px));
            const auto after = std::upper_bound(edges_deg.begin(), edges_deg.end(), eccentricity_deg);
            if (after == edges_deg.begin() || eccentricity_deg > edges_deg.back()) continue;
            // The farthest pixel lies on the last edge.
            const auto i =
                std::min<std::size_t>(static_cast<std::size_t>(after - edges_deg.begin()) - 1, rings.size() - 1);
            rings[i].pixels += 1;
            rings[i].samples += mask.sampled[static_cast<std::size_t>(y) * mask.width_px + x];
            if (!map.density.empty()) wanted[i] += map.at(x, y);
        }
    }
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const auto pixels = static_cast<double>(rings[i].pixels);
        if (rings[i].pixels == 0) continue;
        rings[i].drawn = static_cast<double>(rings[i].samples) / pixels;
        if (basis.full)
            rings[i].wanted = 1.0;
        else if (basis.law)
            rings[i].wanted = wanted[i] / pixels;
    }
}

}  // namespace

Inspection inspect(const Mask& mask, const SampleMesh& mesh, const InspectionBasis& basis,
                   std::vector<double> edges_deg) {
    const MaskField field(basis.display, basis.geometry);
    if (edges_deg.empty()) edges_deg = usual_edges_deg(farthest_deg(field, mask));

    Inspection result;
    result.width_px = mask.width_px;
    result.height_px = mask.height_px;
    result.gaze_px = mask.gaze_px;
    result.samples = static_cast<std::uint64_t>(std::ranges::count_if(mask.sampled, [](auto s) { return s != 0; }));
    result.share = static_cast<double>(result.samples) / (1.0 * mask.width_px * mask.height_px);
    const glm::ivec2 window_px(basis.display.eye_width_px, basis.display.eye_height_px);
    const glm::ivec2 axis = axis_px(basis.display, kLeftEye);
    const glm::ivec2 begin_px = mask.gaze_px - axis;
    const glm::ivec2 end_px = begin_px + window_px;
    if (begin_px.x >= 0 && begin_px.y >= 0 && end_px.x <= mask.width_px && end_px.y <= mask.height_px)
        result.share_in_window = sampled_share(mask, window_px, axis);
    if (!basis.full) result.law = basis.law;

    std::vector<double> edges_px(edges_deg.size());
    std::ranges::transform(edges_deg, edges_px.begin(), [&field](double edge) { return radius_px(field, edge); });
    // The farthest pixel lies on the last edge, which spacing_rings() leaves out.
    edges_px.back() *= 1.0 + 1e-9;
    const std::vector<SpacingRing> spacing = spacing_rings(mesh, edges_px);
    for (std::size_t i = 0; i + 1 < edges_deg.size(); ++i)
        result.rings.push_back({edges_deg[i], edges_deg[i + 1], 0, 0, 0.0, std::nullopt, spacing[i]});
    count_pixels(mask, field, basis, edges_deg, result.rings);
    result.triangles = triangle_quality(mesh);
    return result;
}

}  // namespace macula
