#include "masks/mesh/triangulate.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

#include <boost/polygon/voronoi_builder.hpp>

namespace macula {
namespace {

using Triangle = SampleMesh::Triangle;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

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

/// Triangles and who is beside them. Side 3 t + i of triangle t leads from its corner i to corner i + 1.
struct LinkedTriangles {
    std::vector<Triangle> triangle;
    std::vector<std::uint32_t> twin;  ///< per side: the same side of the triangle beyond; kNone on the hull

    [[nodiscard]] std::uint32_t start(std::uint32_t side) const { return triangle[side / 3][side % 3]; }
    [[nodiscard]] std::uint32_t end(std::uint32_t side) const { return triangle[side / 3][(side + 1) % 3]; }
    [[nodiscard]] std::uint32_t apex(std::uint32_t side) const { return triangle[side / 3][(side + 2) % 3]; }
    void link(std::uint32_t side, std::uint32_t other) {
        twin[side] = other;
        if (other != kNone) twin[other] = side;
    }
};

/// What Boost's sweep line fills in place of a Voronoi diagram. A vertex of the diagram is the centre of a circle
/// through three sites, which are a triangle, and the bisectors that meet there know who is beside it. Against a
/// diagram that is taken apart afterwards this is a quarter of the memory and half of the time, and where four sites
/// or more are cocircular their triangles are there without another look.
class SweepOutput {
public:
    explicit SweepOutput(LinkedTriangles& triangles) : to_(triangles) {}

    // The names are Boost's.
    // NOLINTBEGIN(readability-identifier-naming)
    void _reserve(std::size_t sites) {
        to_.triangle.reserve(2 * sites);
        to_.twin.reserve(6 * sites);
    }

    template <class Site>
    void _process_single_site(const Site& /*site*/) {}

    /// The beach line meets site b: the bisector with a begins, and grows at both ends.
    template <class Site>
    std::pair<void*, void*> _insert_new_edge(const Site& a, const Site& b) {
        Bisector* bisector = begin(index(a), index(b), kNone);
        return {bisector, bisector};
    }

    /// The arc of the site b between a and c vanishes: the bisectors of a, b and of b, c end in a triangle, and that of
    /// a, c begins there. Boost has found that a, b, c turn to the right, exactly.
    template <class Site, class Circle>
    std::pair<void*, void*> _insert_new_edge(const Site& a, const Site& c, const Circle& /*circle*/, void* a_b,
                                             void* b_c) {
        auto* first = static_cast<Bisector*>(a_b);
        const std::uint32_t b = first->a == index(a) ? first->b : first->a;
        const auto side = static_cast<std::uint32_t>(to_.twin.size());
        to_.triangle.push_back({index(a), b, index(c)});
        to_.twin.resize(to_.twin.size() + 3, kNone);
        end(first, side);
        end(static_cast<Bisector*>(b_c), side + 1);
        Bisector* bisector = begin(index(a), index(c), side + 2);
        return {bisector, bisector};
    }

    void _build() {}
    // NOLINTEND(readability-identifier-naming)

private:
    /// Between the cells of two neighbouring sites, as long as it grows.
    struct Bisector {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        std::uint32_t side = kNone;  ///< of the triangle at the end that no longer grows
    };

    template <class Site>
    static std::uint32_t index(const Site& site) {
        return static_cast<std::uint32_t>(site.initial_index());
    }

    Bisector* begin(std::uint32_t a, std::uint32_t b, std::uint32_t side) {
        if (unused_.empty()) unused_.push_back(&bisectors_.emplace_back());
        Bisector* bisector = unused_.back();
        unused_.pop_back();
        *bisector = {a, b, side};
        return bisector;
    }

    void end(Bisector* bisector, std::uint32_t side) {
        if (bisector->side == kNone) {
            bisector->side = side;
        } else {
            to_.link(side, bisector->side);
            unused_.push_back(bisector);
        }
    }

    LinkedTriangles& to_;
    std::deque<Bisector> bisectors_;  ///< as many as ever grew at a time; they never move
    std::vector<Bisector*> unused_;
};

/// Turns the diagonal of the two triangles at a side.
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

/// Lawson's algorithm: turns diagonals until no triangle's circle has its neighbour's corner inside. Boost orders its
/// events by rounded places, so where four sites are almost cocircular it may have taken the wrong diagonal.
void make_delaunay(LinkedTriangles& mesh, const std::vector<SamplePosition>& site) {
    std::vector<std::uint32_t> doubtful;
    for (std::uint32_t first = 0; first < mesh.twin.size(); ++first) {
        if (mesh.twin[first] == kNone || mesh.twin[first] < first) continue;
        doubtful.push_back(first);
        while (!doubtful.empty()) {
            const std::uint32_t side = doubtful.back();
            doubtful.pop_back();
            const std::uint32_t other = mesh.twin[side];
            if (other == kNone || !inside_circle(site[mesh.start(side)], site[mesh.end(side)], site[mesh.apex(side)],
                                                 site[mesh.apex(other)]))
                continue;
            const std::uint32_t t = 3 * (side / 3);
            const std::uint32_t u = 3 * (other / 3);
            flip(mesh, side);
            doubtful.insert(doubtful.end(), {t, t + 2, u, u + 2});
        }
    }
}

/// Indices of the distinct sites, by x, then y; of equal ones the first.
std::vector<std::uint32_t> sort_sites(const std::vector<SamplePosition>& site) {
    std::vector<std::uint64_t> key(site.size());
    for (std::size_t i = 0; i < site.size(); ++i) {
        const auto x = static_cast<std::uint16_t>(site[i].x_px + 0x8000);
        const auto y = static_cast<std::uint16_t>(site[i].y_px + 0x8000);
        key[i] = static_cast<std::uint64_t>(x) << 48U | static_cast<std::uint64_t>(y) << 32U | i;
    }
    std::sort(key.begin(), key.end());
    key.erase(
        std::unique(key.begin(), key.end(), [](std::uint64_t a, std::uint64_t b) { return a >> 32U == b >> 32U; }),
        key.end());
    return {key.begin(), key.end()};
}

LinkedTriangles sweep(const std::vector<SamplePosition>& site) {
    LinkedTriangles triangles;
    SweepOutput output(triangles);
    boost::polygon::default_voronoi_builder builder;
    for (const SamplePosition& s : site) builder.insert_point(s.x_px, s.y_px);
    builder.construct(&output);
    return triangles;
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<SamplePosition>& site) {
    const std::vector<std::uint32_t> order = sort_sites(site);
    std::vector<SamplePosition> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t i : order) sorted.push_back(site[i]);

    LinkedTriangles mesh = sweep(sorted);
    make_delaunay(mesh, sorted);
    for (Triangle& t : mesh.triangle)
        for (std::uint32_t& corner : t) corner = order[corner];
    return std::move(mesh.triangle);
}

}  // namespace macula
