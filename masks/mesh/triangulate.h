#pragma once

#include <cstdint>
#include <vector>

#include "masks/mesh/sample_mesh.h"

namespace macula {

/// Delaunay triangulation of pixels, by the sweep line of Boost.Polygon's Voronoi diagrams (Fortune 1987) and exact
/// integer predicates. Takes about 2 us and 100 bytes a site.
///
/// The triangles cover the convex hull of the sites without overlap; no other site lies inside the circle through a
/// triangle's corners (of cocircular sites, as in a full grid, some triangulation is taken); none is degenerate.
/// Corners are indices into `site`, in SampleMesh::Triangle's orientation. Sites that occur several times count once:
/// only the first is a corner. Fewer than three sites, or all on a line: no triangles.
/// Coordinates: at most 16383 in magnitude.
std::vector<SampleMesh::Triangle> triangulate(const std::vector<SamplePosition>& site);

}  // namespace macula
