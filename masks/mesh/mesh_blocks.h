#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/mesh/mesh_pixel.h"
#include "masks/sample_plan.h"

namespace macula {

inline constexpr int kMeshBlockEdge_px = 16;

/// The sites of a mesh by 16x16 blocks of its mask, so that a sampler takes most of a window's sites block by block
/// without a look at each. Blocks in rows; inside a block, sites in Morton order, which is coherent for ray packets.
class MeshBlocks {
public:
    MeshBlocks() = default;
    /// `spacing_px` per site, `pixels` row-major, `size_px` of the mask.
    MeshBlocks(glm::ivec2 size_px, std::span<const SamplePosition> site, std::span<const float> spacing_px,
               std::span<const MeshPixel> pixels);

    /// Columns and rows; the last ones may be cut by the mask's edge.
    [[nodiscard]] glm::ivec2 count() const { return count_; }

    /// Sites of one block.
    struct Block {
        std::span<const std::uint8_t> pixel;  ///< 16 y + x in the block
        std::span<const float> spacing_px;    ///< of the same sites (MeshTable::spacing_px)
    };

    [[nodiscard]] Block block(glm::ivec2 block) const {
        const std::size_t i = index(block);
        const std::size_t sites = first_[i + 1] - first_[i];
        return {{pixel_.data() + first_[i], sites}, {spacing_px_.data() + first_[i], sites}};
    }
    /// Number of a block's sites.
    [[nodiscard]] std::size_t sites(glm::ivec2 block) const { return first_[index(block) + 1] - first_[index(block)]; }
    /// How far in x or y the farthest site is that a pixel of the block interpolates.
    [[nodiscard]] int reach_px(glm::ivec2 block) const { return reach_px_[index(block)]; }
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    [[nodiscard]] std::size_t index(glm::ivec2 block) const {
        return static_cast<std::size_t>(block.y) * static_cast<std::size_t>(count_.x) +
               static_cast<std::size_t>(block.x);
    }
    void sort_sites(std::span<const SamplePosition> site, std::span<const float> spacing_px);
    void find_reach(glm::ivec2 size_px, std::span<const MeshPixel> pixels);

    glm::ivec2 count_ = glm::ivec2(0);
    std::vector<std::uint32_t> first_;  ///< per block, index of its first site; one more entry holds the total
    std::vector<std::uint8_t> reach_px_;
    std::vector<std::uint8_t> pixel_;
    std::vector<float> spacing_px_;
};

}  // namespace macula
