#include "masks/mesh/triangulate.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

#include <boost/polygon/voronoi_builder.hpp>

#include "masks/mesh/delaunay_flip.h"

namespace macula {
namespace {

using Triangle = SampleMesh::Triangle;

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
        Bisector* bisector = begin(index(a), index(b), LinkedTriangles::kNone);
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
        to_.twin.resize(to_.twin.size() + 3, LinkedTriangles::kNone);
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
        std::uint32_t side = LinkedTriangles::kNone;  ///< of the triangle at the end that no longer grows
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
        if (bisector->side == LinkedTriangles::kNone) {
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
    return {key.begin(), key.end()};  // of which 32 bits stay, the index
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
    // Boost decides exactly which sites turn to the right, so these triangles are a triangulation. But it orders
    // circles by rounded places, which decides a diagonal where four sites are almost cocircular.
    make_delaunay(mesh, sorted);
    for (Triangle& t : mesh.triangle)
        for (std::uint32_t& corner : t) corner = order[corner];
    return std::move(mesh.triangle);
}

}  // namespace macula
