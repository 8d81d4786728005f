#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "masks/mesh/sample_mesh.h"

namespace macula {

/// Triangles that know who is beside them. Side 3 t + i of triangle t leads from its corner i to its next one.
struct LinkedTriangles {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    std::vector<SampleMesh::Triangle> triangle;
    std::vector<std::uint32_t> twin;  ///< per side: the same side of the triangle beyond; kNone on the hull

    [[nodiscard]] std::uint32_t start(std::uint32_t side) const { return triangle[side / 3][side % 3]; }
    [[nodiscard]] std::uint32_t end(std::uint32_t side) const { return triangle[side / 3][(side + 1) % 3]; }
    [[nodiscard]] std::uint32_t apex(std::uint32_t side) const { return triangle[side / 3][(side + 2) % 3]; }
    void link(std::uint32_t side, std::uint32_t other) {
        twin[side] = other;
        if (other != kNone) twin[other] = side;
    }
};

/// Replaces the two triangles at a side, which is not on the hull, by those at the other diagonal of their
/// quadrilateral, which is convex. They keep their numbers.
void flip(LinkedTriangles& mesh, std::uint32_t side);

/// Makes a triangulation Delaunay: turns diagonals until no neighbour's corner lies inside the circle through a
/// triangle's (Lawson 1977). Exact for coordinates up to 16383 in magnitude. Returns the number of turns.
std::size_t make_delaunay(LinkedTriangles& mesh, const std::vector<SamplePosition>& site);

}  // namespace macula
