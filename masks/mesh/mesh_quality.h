#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "masks/mesh/sample_mesh.h"

namespace macula {

/// Shape of a mesh's triangles. Interpolation errors grow with the longest edge and with thin triangles. All 0 without
/// triangles.
struct TriangleQuality {
    std::size_t triangles = 0;
    std::int64_t doubled_area_px2 = 0;  ///< sum of all; 2 (width_px - 1) (height_px - 1) if they cover the mask
    double longest_edge_px = 0.0;
    /// Smallest angle of a triangle: pi / 3 at most. Two halves of a square have pi / 4.
    double smallest_angle_min_rad = 0.0;
    double smallest_angle_p1_rad = 0.0;
    double smallest_angle_median_rad = 0.0;
    /// Radius of the circle through the corners over twice that of the circle inside: 1 at least, where all sides are
    /// equal; 1.207 for half a square.
    double aspect_p50 = 0.0;
    double aspect_p99 = 0.0;
};

TriangleQuality triangle_quality(const SampleMesh& mesh);

/// How far the sites of a ring around the gaze lie from their nearest neighbours, in or out of the ring. All distances
/// are 0 where the ring has no site.
struct SpacingRing {
    double inner_px = 0.0;  ///< distance from the gaze, included
    double outer_px = 0.0;  ///< not included
    std::size_t sites = 0;
    std::size_t pixels = 0;  ///< of the mask in the ring; sites / pixels is the ring's density
    double nearest_min_px = 0.0;
    double nearest_p5_px = 0.0;
    double nearest_median_px = 0.0;
    double nearest_p95_px = 0.0;
    double nearest_max_px = 0.0;
    double nearest_mean_px = 0.0;
    double nearest_deviation_px = 0.0;  ///< standard deviation
    /// Regularity index of Wässle & Riemann (Proc. R. Soc. B 200, 1978): mean over standard deviation. 1.91 where sites
    /// are independent of each other, infinite for a lattice. Both hold for one density, hence for narrow rings.
    double regularity = 0.0;
};

/// Nearest neighbours by ring: ring i is from edges_px[i] to edges_px[i + 1], distances from the centre of the gaze
/// pixel, ascending. On a mask of either geometry a circle around the gaze has one eccentricity (MaskGeometry).
/// A site's nearest neighbour is a corner of one of its triangles if these are Delaunay, so the mesh has to be; sites
/// of no triangle are left out.
std::vector<SpacingRing> spacing_rings(const SampleMesh& mesh, std::span<const double> edges_px);

}  // namespace macula
