#include "masks/mesh/mesh_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace macula {
namespace {

glm::dvec2 place(const SamplePosition& site) {
    return {site.x_px, site.y_px};
}

/// The value that the share 0..1 of all lies below, of at least one; sorts in part.
double quantile(std::vector<float>& values, double share) {
    const std::ptrdiff_t rank = std::lround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

/// Per site: squared distance to the nearest site that a triangle joins it to; infinite without a triangle. The nearest
/// of all is among them, for the circle over the line between the two is empty.
std::vector<float> nearest_squared_px2(const SampleMesh& mesh) {
    std::vector<float> nearest(mesh.site.size(), std::numeric_limits<float>::infinity());
    for (const SampleMesh::Triangle& t : mesh.triangle) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            const float x = static_cast<float>(mesh.site[a].x_px - mesh.site[b].x_px);
            const float y = static_cast<float>(mesh.site[a].y_px - mesh.site[b].y_px);
            const float squared = x * x + y * y;
            nearest[a] = std::min(nearest[a], squared);
            nearest[b] = std::min(nearest[b], squared);
        }
    }
    return nearest;
}

/// Ring of pixels around the gaze; `edges.size()` if none.
class RingFinder {
public:
    RingFinder(const SampleMesh& mesh, std::span<const double> edges_px) : gaze_(mesh.gaze_px), edges_(edges_px) {}

    [[nodiscard]] std::size_t ring_of(int x_px, int y_px) const {
        const double distance = glm::length(glm::dvec2(x_px - gaze_.x, y_px - gaze_.y));
        const auto above = std::upper_bound(edges_.begin(), edges_.end(), distance);
        const bool outside = above == edges_.begin() || above == edges_.end();
        return outside ? edges_.size() : static_cast<std::size_t>(above - edges_.begin()) - 1;
    }

private:
    glm::ivec2 gaze_;
    std::span<const double> edges_;
};

void fill(SpacingRing& ring, std::vector<float>& nearest) {
    if (nearest.empty()) return;
    const auto count = static_cast<double>(nearest.size());
    // Sums of differences to one of the distances: exact where all are the same, as in a lattice.
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (const float distance : nearest) {
        const double difference = distance - nearest.front();
        sum += difference;
        sum_of_squares += difference * difference;
    }
    const double mean = sum / count;
    ring.sites = nearest.size();
    ring.nearest_mean_px = nearest.front() + mean;
    ring.nearest_deviation_px = std::sqrt(std::max(0.0, sum_of_squares / count - mean * mean));
    ring.regularity = ring.nearest_mean_px / ring.nearest_deviation_px;
    ring.nearest_min_px = quantile(nearest, 0.0);
    ring.nearest_p5_px = quantile(nearest, 0.05);
    ring.nearest_median_px = quantile(nearest, 0.5);
    ring.nearest_p95_px = quantile(nearest, 0.95);
    ring.nearest_max_px = quantile(nearest, 1.0);
}

}  // namespace

TriangleQuality triangle_quality(const SampleMesh& mesh) {
    TriangleQuality quality;
    quality.triangles = mesh.triangle.size();
    if (mesh.triangle.empty()) return quality;
    std::vector<float> angle_rad;
    std::vector<float> aspect;
    angle_rad.reserve(mesh.triangle.size());
    aspect.reserve(mesh.triangle.size());
    for (const SampleMesh::Triangle& t : mesh.triangle) {
        const glm::dvec2 ab = place(mesh.site[t[1]]) - place(mesh.site[t[0]]);
        const glm::dvec2 ac = place(mesh.site[t[2]]) - place(mesh.site[t[0]]);
        const double doubled_area = ab.y * ac.x - ab.x * ac.y;
        std::array<double, 3> side = {glm::length(ab), glm::length(ac), glm::length(ac - ab)};
        std::sort(side.begin(), side.end());
        // The smallest angle lies between the longer sides; the law of cosines gives its tangent.
        const double cosine = (side[1] * side[1] + side[2] * side[2] - side[0] * side[0]) / 2.0;
        angle_rad.push_back(static_cast<float>(std::atan2(doubled_area, cosine)));
        // R = abc / (4 A), r = 2 A / (a + b + c).
        aspect.push_back(static_cast<float>(side[0] * side[1] * side[2] * (side[0] + side[1] + side[2]) /
                                            (4.0 * doubled_area * doubled_area)));
        quality.doubled_area_px2 += static_cast<std::int64_t>(doubled_area);
        quality.longest_edge_px = std::max(quality.longest_edge_px, side[2]);
    }
    quality.smallest_angle_min_rad = quantile(angle_rad, 0.0);
    quality.smallest_angle_p1_rad = quantile(angle_rad, 0.01);
    quality.smallest_angle_median_rad = quantile(angle_rad, 0.5);
    quality.aspect_p50 = quantile(aspect, 0.5);
    quality.aspect_p99 = quantile(aspect, 0.99);
    return quality;
}

std::vector<SpacingRing> spacing_rings(const SampleMesh& mesh, std::span<const double> edges_px) {
    std::vector<SpacingRing> rings(edges_px.empty() ? 0 : edges_px.size() - 1);
    for (std::size_t i = 0; i < rings.size(); ++i) {
        rings[i].inner_px = edges_px[i];
        rings[i].outer_px = edges_px[i + 1];
    }
    const RingFinder finder(mesh, edges_px);
    const std::vector<float> squared = nearest_squared_px2(mesh);
    std::vector<std::vector<float>> nearest(rings.size());
    for (std::size_t i = 0; i < mesh.site.size(); ++i) {
        const std::size_t ring = finder.ring_of(mesh.site[i].x_px, mesh.site[i].y_px);
        if (ring < rings.size() && std::isfinite(squared[i])) nearest[ring].push_back(std::sqrt(squared[i]));
    }
    for (std::size_t i = 0; i < rings.size(); ++i) fill(rings[i], nearest[i]);
    for (int y = 0; y < mesh.height_px; ++y) {
        for (int x = 0; x < mesh.width_px; ++x) {
            const std::size_t ring = finder.ring_of(x, y);
            if (ring < rings.size()) ++rings[ring].pixels;
        }
    }
    return rings;
}

}  // namespace macula
