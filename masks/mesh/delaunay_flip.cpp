#include "masks/mesh/delaunay_flip.h"

namespace macula {
namespace {

/// Twice the signed area, negative in Triangle's orientation.
std::int64_t doubled_area(const SamplePosition& a, const SamplePosition& b, const SamplePosition& c) {
    return static_cast<std::int64_t>(b.x_px - a.x_px) * (c.y_px - a.y_px) -
           static_cast<std::int64_t>(b.y_px - a.y_px) * (c.x_px - a.x_px);
}

std::int64_t squared_distance(const SamplePosition& a, const SamplePosition& b) {
    const std::int64_t x = a.x_px - b.x_px;
    const std::int64_t y = a.y_px - b.y_px;
    return x * x + y * y;
}

/// Whether d lies inside the circle through a triangle in Triangle's orientation. Exact: in a square of side s =
/// 2 * 16383 a doubled area is at most s^2 and a squared distance 2 s^2, so the sum is within 6 s^4 < 2^63.
bool inside_circle(const SamplePosition& a, const SamplePosition& b, const SamplePosition& c, const SamplePosition& d) {
    return squared_distance(a, d) * doubled_area(d, b, c) + squared_distance(b, d) * doubled_area(d, c, a) +
               squared_distance(c, d) * doubled_area(d, a, b) <
           0;
}

}  // namespace

void flip(LinkedTriangles& mesh, std::uint32_t side) {
    const std::uint32_t other = mesh.twin[side];
    const std::uint32_t t = side / 3;
    const std::uint32_t u = other / 3;
    const std::uint32_t p = mesh.start(side);
    const std::uint32_t q = mesh.end(side);
    const std::uint32_t a = mesh.apex(side);
    const std::uint32_t b = mesh.apex(other);
    const std::uint32_t q_a = mesh.twin[3 * t + (side + 1) % 3];
    const std::uint32_t a_p = mesh.twin[3 * t + (side + 2) % 3];
    const std::uint32_t p_b = mesh.twin[3 * u + (other + 1) % 3];
    const std::uint32_t b_q = mesh.twin[3 * u + (other + 2) % 3];
    mesh.triangle[t] = {p, b, a};
    mesh.triangle[u] = {q, a, b};
    mesh.link(3 * t, p_b);
    mesh.link(3 * t + 1, 3 * u + 1);
    mesh.link(3 * t + 2, a_p);
    mesh.link(3 * u, q_a);
    mesh.link(3 * u + 2, b_q);
}

std::size_t make_delaunay(LinkedTriangles& mesh, const std::vector<SamplePosition>& site) {
    std::size_t turns = 0;
    std::vector<std::uint32_t> doubtful;
    for (std::uint32_t first = 0; first < mesh.twin.size(); ++first) {
        if (mesh.twin[first] == LinkedTriangles::kNone || mesh.twin[first] < first) continue;
        doubtful.push_back(first);
        while (!doubtful.empty()) {
            const std::uint32_t side = doubtful.back();
            doubtful.pop_back();
            const std::uint32_t other = mesh.twin[side];
            if (other == LinkedTriangles::kNone || !inside_circle(site[mesh.start(side)], site[mesh.end(side)],
                                                                  site[mesh.apex(side)], site[mesh.apex(other)]))
                continue;
            const std::uint32_t t = 3 * (side / 3);
            const std::uint32_t u = 3 * (other / 3);
            flip(mesh, side);
            ++turns;
            doubtful.insert(doubtful.end(), {t, t + 2, u, u + 2});
        }
    }
    return turns;
}

}  // namespace macula
