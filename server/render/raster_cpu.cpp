#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "server/render/mesh_recent.h"
#include "server/render/mesh_reconstructors.h"
#include "server/render/parallel_ranges.h"
#include "server/render/raster_hidden.h"
#include "server/render/raster_mesh.h"
#include "server/render/reconstruction.h"
#include "server/render/sample_image.h"

namespace macula {

namespace {

using glm::ivec2;

/// Twice the area of a triangle, positive in SampleMesh::Triangle's orientation; of the last corner, the edge function
/// of the other two.
int area2(ivec2 a, ivec2 b, ivec2 c) {
    return (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
}

/// What a corner of a triangle brings.
struct Corner {
    ivec2 place;      ///< in the window
    glm::vec4 color;  ///< codes 0..255
    float inverse_depth = 0.0F;
};

/// Draws triangles by edge functions. A pixel belongs to a triangle if its centre lies inside, or on a left or upper
/// edge: as if the centre lay a trace farther right, and less of a trace farther down. So each pixel belongs to exactly
/// one triangle, and triangles can be drawn on several threads.
class TriangleRasterizer {
public:
    TriangleRasterizer(const RasterMesh& mesh, const SamplePlan& plan, const SampleImage& image,
                       const ReconstructTarget& target)
        : mesh_(mesh), plan_(plan), image_(image), target_(target) {}

    void draw(IndexRange range) const {
        const std::span<const std::uint32_t> indices = mesh_.indices().subspan(range.first, range.count);
        for (std::size_t i = 0; i < indices.size(); i += 3) draw({indices[i], indices[i + 1], indices[i + 2]});
    }

private:
    [[nodiscard]] Corner corner(std::uint32_t index) const {
        const RasterVertex& vertex = mesh_.vertices()[index];
        // Triangles that cover no pixel of the window may have corners outside the image.
        const ivec2 guard(image_.guard_px);
        const ivec2 site = glm::clamp(ivec2(vertex.site_x_px, vertex.site_y_px) - plan_.mesh_origin_px, -guard,
                                      ivec2(plan_.width_px, plan_.height_px) + guard - 1);
        const std::size_t pixel = image_.index(site);
        const Rgba8 color = image_.color[pixel];
        return {ivec2(vertex.x_px, vertex.y_px) - plan_.mesh_origin_px,
                glm::vec4(color & 255U, color >> 8 & 255U, color >> 16 & 255U, color >> 24),
                image_.inverse_depth_per_m[pixel]};
    }

    void draw(const SampleMesh::Triangle& triangle) const {
        std::array<ivec2, 3> place;
        for (std::size_t i = 0; i < 3; ++i) {
            const RasterVertex& vertex = mesh_.vertices()[triangle[i]];
            place[i] = ivec2(vertex.x_px, vertex.y_px) - plan_.mesh_origin_px;
        }
        const ivec2 first = glm::max(glm::min(glm::min(place[0], place[1]), place[2]), ivec2(0));
        const ivec2 last =
            glm::min(glm::max(glm::max(place[0], place[1]), place[2]), ivec2(plan_.width_px, plan_.height_px) - 1);
        if (first.x > last.x || first.y > last.y) return;
        fill({corner(triangle[0]), corner(triangle[1]), corner(triangle[2])}, first, last);
    }

    void fill(const std::array<Corner, 3>& corner, ivec2 first, ivec2 last) const {
        // Edge i lies opposite to corner i: its function, over the doubled area, is the corner's weight.
        std::array<int, 3> row{};
        std::array<ivec2, 3> step{};
        std::array<int, 3> least{};
        for (std::size_t i = 0; i < 3; ++i) {
            const ivec2 from = corner[(i + 1) % 3].place;
            const ivec2 to = corner[(i + 2) % 3].place;
            row[i] = area2(from, to, first);
            step[i] = {to.y - from.y, from.x - to.x};
            const bool left_or_upper = step[i].x > 0 || (step[i].x == 0 && step[i].y > 0);
            least[i] = left_or_upper ? 0 : 1;
        }
        const float per_area = 1.0F / static_cast<float>(area2(corner[0].place, corner[1].place, corner[2].place));
        for (int y = first.y; y <= last.y; ++y) {
            std::array<int, 3> edge = row;
            for (int x = first.x; x <= last.x; ++x) {
                if (edge[0] >= least[0] && edge[1] >= least[1] && edge[2] >= least[2])
                    write(x, y, corner, glm::vec3(edge[0], edge[1], edge[2]) * per_area);
                for (std::size_t i = 0; i < 3; ++i) edge[i] += step[i].x;
            }
            for (std::size_t i = 0; i < 3; ++i) row[i] += step[i].y;
        }
    }

    void write(int x, int y, const std::array<Corner, 3>& corner, glm::vec3 weight) const {
        const glm::vec4 color = weight.x * corner[0].color + weight.y * corner[1].color + weight.z * corner[2].color;
        const glm::uvec4 code(color + 0.5F);
        const float inverse_depth = weight.x * corner[0].inverse_depth + weight.y * corner[1].inverse_depth +
                                    weight.z * corner[2].inverse_depth;
        target_.color[static_cast<std::size_t>(y) * target_.color_stride_px + static_cast<std::size_t>(x)] =
            code.x | code.y << 8 | code.z << 16 | code.w << 24;
        target_
            .inverse_depth_per_m[static_cast<std::size_t>(y) * target_.depth_stride_px + static_cast<std::size_t>(x)] =
            std::max(inverse_depth, 0.0F);
    }

    const RasterMesh& mesh_;
    const SamplePlan& plan_;
    const SampleImage& image_;
    const ReconstructTarget& target_;
};

class CpuRasterReconstructor final : public Reconstructor {
public:
    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::raster, plan); !fits) return fits;
        image_.fill(plan, samples, false);
        const RasterMesh& mesh = meshes_.get(plan.mesh, [&] { return RasterMesh(plan.mesh->mesh()); });
        mesh.find_ranges(plan.mesh_origin_px, {plan.width_px, plan.height_px}, ranges_);
        const TriangleRasterizer rasterizer(mesh, plan, image_, target);
        parallel_ranges(0, static_cast<int>(ranges_.size()), 1, [&](int first, int last) {
            for (int i = first; i < last; ++i) rasterizer.draw(ranges_[static_cast<std::size_t>(i)]);
        });
        blacken_hidden(plan, target);
        return {};
    }
    [[nodiscard]] std::string name() const override { return "C++"; }

private:
    SampleImage image_;
    RecentMeshes<RasterMesh> meshes_;
    std::vector<IndexRange> ranges_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_cpu_raster_reconstructor() {
    return std::make_unique<CpuRasterReconstructor>();
}

}  // namespace macula
