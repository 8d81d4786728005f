#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "masks/mesh/mesh_blocks.h"
#include "masks/mesh/mesh_pixel.h"
#include "masks/mesh/sample_mesh.h"
#include "protocol/base/error.h"

namespace macula {

/// A mesh with what is computed from it once, when it is read: which three sites each pixel interpolates, and how far
/// apart the sites are. Immutable, shared by sessions and eyes.
class MeshTable {
public:
    /// Rasterises the triangles of a mesh without defect (mesh_defect(), which read_mesh() checks), on the calling
    /// thread. A pixel's entry does not depend on the order of triangles, nor on how a quadrilateral was cut that it
    /// lies on the diagonal of. Errors: `input_file`, naming a pixel that interpolates a corner farther away than
    /// kMeshReach_px, or that no triangle covers.
    static Expected<MeshTable> make(SampleMesh mesh);

    [[nodiscard]] const SampleMesh& mesh() const { return mesh_; }
    /// Row-major, mesh().width_px to a row.
    [[nodiscard]] std::span<const MeshPixel> pixels() const { return pixels_; }
    /// Per site: mean distance of the sites there, in pixels: root of the sum of the weights that pixels give it. 1
    /// where all pixels around are sites, however they were triangulated; never less.
    [[nodiscard]] std::span<const float> spacing_px() const { return spacing_px_; }
    /// The sites once more, in the order of samplers.
    [[nodiscard]] const MeshBlocks& blocks() const { return blocks_; }
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    MeshTable() = default;
    SampleMesh mesh_;
    std::vector<MeshPixel> pixels_;
    std::vector<float> spacing_px_;
    MeshBlocks blocks_;
};

}  // namespace macula
