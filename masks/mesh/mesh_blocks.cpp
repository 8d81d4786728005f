#include "masks/mesh/mesh_blocks.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "masks/sample_order.h"

namespace macula {
namespace {

constexpr int kBlockArea_px = kMeshBlockEdge_px * kMeshBlockEdge_px;

/// Pixels 16 y + x of a block in Morton order.
std::array<std::uint8_t, kBlockArea_px> morton_pixels() {
    std::array<std::uint8_t, kBlockArea_px> pixels{};
    for (std::uint32_t y = 0; y < kMeshBlockEdge_px; ++y) {
        for (std::uint32_t x = 0; x < kMeshBlockEdge_px; ++x)
            pixels[morton(x, y)] = static_cast<std::uint8_t>(kMeshBlockEdge_px * y + x);
    }
    return pixels;
}

int reach_of(const MeshPixel& p) {
    return std::max({std::abs(p.ax), std::abs(p.ay), std::abs(p.bx), std::abs(p.by), std::abs(p.cx), std::abs(p.cy)});
}

}  // namespace

MeshBlocks::MeshBlocks(glm::ivec2 size_px, std::span<const SamplePosition> site, std::span<const float> spacing_px,
                       std::span<const MeshPixel> pixels)
    : count_((size_px + kMeshBlockEdge_px - 1) / kMeshBlockEdge_px) {
    sort_sites(site, spacing_px);
    find_reach(size_px, pixels);
}

void MeshBlocks::sort_sites(std::span<const SamplePosition> site, std::span<const float> spacing_px) {
    const auto block_of = [this](const SamplePosition& p) {
        return index({p.x_px / kMeshBlockEdge_px, p.y_px / kMeshBlockEdge_px});
    };
    const std::size_t blocks = static_cast<std::size_t>(count_.x) * static_cast<std::size_t>(count_.y);
    first_.assign(blocks + 1, 0);
    for (const SamplePosition& p : site) ++first_[block_of(p) + 1];
    for (std::size_t i = 0; i < blocks; ++i) first_[i + 1] += first_[i];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    std::vector<std::uint32_t> by_block(site.size());
    for (std::size_t i = 0; i < site.size(); ++i) by_block[next[block_of(site[i])]++] = static_cast<std::uint32_t>(i);

    pixel_.resize(site.size());
    spacing_px_.resize(site.size());
    const auto order = morton_pixels();
    std::array<float, kBlockArea_px> spacing_at{};  // 0: no site
    for (std::size_t block = 0; block < blocks; ++block) {
        spacing_at.fill(0.0F);
        for (std::uint32_t i = first_[block]; i < first_[block + 1]; ++i) {
            const SamplePosition& p = site[by_block[i]];
            const int pixel = p.y_px % kMeshBlockEdge_px * kMeshBlockEdge_px + p.x_px % kMeshBlockEdge_px;
            spacing_at[static_cast<std::size_t>(pixel)] = spacing_px[by_block[i]];
        }
        std::uint32_t to = first_[block];
        for (const std::uint8_t pixel : order) {
            if (spacing_at[pixel] == 0.0F) continue;
            pixel_[to] = pixel;
            spacing_px_[to++] = spacing_at[pixel];
        }
    }
}

void MeshBlocks::find_reach(glm::ivec2 size_px, std::span<const MeshPixel> pixels) {
    reach_px_.assign(first_.size() - 1, 0);
    for (int y = 0; y < size_px.y; ++y) {
        const MeshPixel* row = pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px.x);
        std::uint8_t* reach = &reach_px_[index({0, y / kMeshBlockEdge_px})];
        for (int x = 0; x < size_px.x; ++x) {
            std::uint8_t& of_block = reach[x / kMeshBlockEdge_px];
            of_block = std::max(of_block, static_cast<std::uint8_t>(reach_of(row[x])));
        }
    }
}

std::size_t MeshBlocks::memory_bytes() const {
    return (first_.size() + spacing_px_.size()) * sizeof(float) + reach_px_.size() + pixel_.size();
}

}  // namespace macula
