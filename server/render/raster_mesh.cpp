#include "server/render/raster_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <glm/common.hpp>

namespace macula {

namespace {

constexpr int kBlockEdge_px = 64;

glm::ivec2 place(const RasterVertex& vertex) {
    return {vertex.x_px, vertex.y_px};
}

/// Continues the border of a mesh outwards.
class Skirt {
public:
    Skirt(std::vector<RasterVertex>& vertices, std::vector<std::uint32_t>& indices)
        : vertices_(vertices), indices_(indices) {}

    /// A copy of a border vertex, moved.
    std::uint32_t copy(std::uint32_t vertex, glm::ivec2 outward) {
        RasterVertex moved = vertices_[vertex];
        moved.x_px = static_cast<std::int16_t>(moved.x_px + outward.x);
        moved.y_px = static_cast<std::int16_t>(moved.y_px + outward.y);
        vertices_.push_back(moved);
        return static_cast<std::uint32_t>(vertices_.size() - 1);
    }

    /// Two triangles between corners in the order of its outline, in either direction.
    void quadrilateral(const std::array<std::uint32_t, 4>& corner) {
        triangle({corner[0], corner[1], corner[2]});
        triangle({corner[0], corner[2], corner[3]});
    }

private:
    void triangle(std::array<std::uint32_t, 3> corner) {
        const glm::ivec2 to_b = place(vertices_[corner[1]]) - place(vertices_[corner[0]]);
        const glm::ivec2 to_c = place(vertices_[corner[2]]) - place(vertices_[corner[0]]);
        if (to_b.x * to_c.y - to_b.y * to_c.x > 0) std::swap(corner[1], corner[2]);
        indices_.insert(indices_.end(), corner.begin(), corner.end());
    }

    std::vector<RasterVertex>& vertices_;
    std::vector<std::uint32_t>& indices_;
};

}  // namespace

RasterMesh::RasterMesh(const SampleMesh& mesh) {
    vertices_.reserve(mesh.site.size());
    for (const SamplePosition& p : mesh.site) vertices_.push_back({p.x_px, p.y_px, p.x_px, p.y_px});
    indices_.reserve(3 * mesh.triangle.size());
    for (const SampleMesh::Triangle& triangle : mesh.triangle)
        indices_.insert(indices_.end(), triangle.begin(), triangle.end());
    add_skirt(mesh);
    sort_by_blocks({mesh.width_px, mesh.height_px});
}

void RasterMesh::add_skirt(const SampleMesh& mesh) {
    const glm::ivec2 last = glm::ivec2(mesh.width_px, mesh.height_px) - 1;
    Skirt skirt(vertices_, indices_);
    const auto sites = static_cast<std::uint32_t>(mesh.site.size());
    for (const int along : {0, 1}) {
        const int across = 1 - along;
        for (const int side : {0, last[across]}) {
            std::vector<std::uint32_t> border;
            for (std::uint32_t i = 0; i < sites; ++i)
                if (place(vertices_[i])[across] == side) border.push_back(i);
            std::sort(border.begin(), border.end(), [&](std::uint32_t a, std::uint32_t b) {
                return place(vertices_[a])[along] < place(vertices_[b])[along];
            });
            glm::ivec2 outward(0);
            outward[across] = side == 0 ? -1 : 1;
            std::uint32_t previous = skirt.copy(border.front(), outward);
            for (std::size_t i = 1; i < border.size(); ++i) {
                const std::uint32_t next = skirt.copy(border[i], outward);
                skirt.quadrilateral({border[i - 1], border[i], next, previous});
                previous = next;
            }
            // The rows at the top and at the bottom have the squares outside the mask's corners too.
            if (along == 1) continue;
            for (const std::uint32_t corner : {border.front(), border.back()}) {
                const glm::ivec2 sideways(corner == border.front() ? -1 : 1, 0);
                skirt.quadrilateral({corner, skirt.copy(corner, outward), skirt.copy(corner, outward + sideways),
                                     skirt.copy(corner, sideways)});
            }
        }
    }
}

void RasterMesh::sort_by_blocks(glm::ivec2 size_px) {
    block_count_ = (size_px + kBlockEdge_px - 1) / kBlockEdge_px;
    blocks_.assign(static_cast<std::size_t>(block_count_.x) * static_cast<std::size_t>(block_count_.y) + 1, {});
    std::vector<std::uint32_t> block_of(indices_.size() / 3);
    for (std::size_t i = 0; i < block_of.size(); ++i) {
        const std::array<glm::ivec2, 3> corner = {place(vertices_[indices_[3 * i]]),
                                                  place(vertices_[indices_[3 * i + 1]]),
                                                  place(vertices_[indices_[3 * i + 2]])};
        const glm::ivec2 first = glm::max(glm::min(glm::min(corner[0], corner[1]), corner[2]), glm::ivec2(0));
        const glm::ivec2 last = glm::max(glm::max(corner[0], corner[1]), corner[2]);
        const glm::ivec2 at = first / kBlockEdge_px;
        block_of[i] = static_cast<std::uint32_t>(at.y * block_count_.x + at.x);
        Block& block = blocks_[block_of[i]];
        block.last_px = glm::max(block.last_px, last);
        blocks_[block_of[i] + 1].first_index += 3;
    }
    for (std::size_t i = 1; i < blocks_.size(); ++i) blocks_[i].first_index += blocks_[i - 1].first_index;
    std::vector<std::uint32_t> next(blocks_.size());
    for (std::size_t i = 0; i < blocks_.size(); ++i) next[i] = blocks_[i].first_index;
    std::vector<std::uint32_t> sorted(indices_.size());
    for (std::size_t i = 0; i < block_of.size(); ++i) {
        std::copy_n(indices_.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, sorted.begin() + next[block_of[i]]);
        next[block_of[i]] += 3;
    }
    indices_ = std::move(sorted);
}

void RasterMesh::find_ranges(glm::ivec2 first_px, glm::ivec2 size_px, std::vector<IndexRange>& ranges) const {
    ranges.clear();
    const glm::ivec2 end = glm::min((first_px + size_px - 1) / kBlockEdge_px + 1, block_count_);
    for (int y = 0; y < end.y; ++y) {
        const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(block_count_.x);
        const auto near = [&](int x) {
            const glm::ivec2 last = blocks_[row + static_cast<std::size_t>(x)].last_px;
            return last.x >= first_px.x && last.y >= first_px.y;
        };
        int first = 0;
        int last = end.x;
        while (first < last && !near(first)) ++first;
        while (last > first && !near(last - 1)) --last;
        if (first == last) continue;
        const std::uint32_t begin = blocks_[row + static_cast<std::size_t>(first)].first_index;
        ranges.push_back({begin, blocks_[row + static_cast<std::size_t>(last)].first_index - begin});
    }
}

}  // namespace macula
