#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/mesh/sample_mesh.h"
#include "protocol/base/error.h"

namespace macula {

/// A pixel interpolates sites at most this far away in x and in y.
inline constexpr int kMeshReach_px = 127;

/// How one pixel of a mask interpolates: the sites at `pixel + (ax, ay)` and so on, with weights in 1/256. The weight
/// of a, the largest, is 256 - weight_b - weight_c. A site is its own pixel: offsets 0, weights 0.
struct MeshPixel {
    std::int8_t ax = 0;
    std::int8_t ay = 0;
    std::int8_t bx = 0;
    std::int8_t by = 0;
    std::int8_t cx = 0;
    std::int8_t cy = 0;
    std::uint8_t weight_b = 0;
    std::uint8_t weight_c = 0;
};
static_assert(sizeof(MeshPixel) == 8);

/// A mesh with what is computed from it once, when it is read: which three sites each pixel interpolates, and how far
/// apart the sites are. Immutable, shared by sessions and eyes.
class MeshTable {
public:
    /// Rasterises the triangles on the shared thread pool of the caller's choice. Errors: `input_file`, naming a pixel
    /// whose triangle has a corner farther away than kMeshReach_px, or that no triangle covers.
    static Expected<MeshTable> make(SampleMesh mesh);

    [[nodiscard]] const SampleMesh& mesh() const { return mesh_; }
    /// Row-major, mesh().width_px to a row.
    [[nodiscard]] std::span<const MeshPixel> pixels() const { return pixels_; }
    /// Per site: root of the area that is its own, in pixels: a third of that of its triangles.
    [[nodiscard]] std::span<const float> spacing_px() const { return spacing_px_; }
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    MeshTable() = default;
    SampleMesh mesh_;
    std::vector<MeshPixel> pixels_;
    std::vector<float> spacing_px_;
};

}  // namespace macula
