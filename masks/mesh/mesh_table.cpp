#include "masks/mesh/mesh_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace macula {
namespace {

using glm::ivec2;

/// Marks a pixel that no triangle has covered yet: no offset is -128.
constexpr std::int8_t kUnset = -128;

/// Twice the area, positive in SampleMesh::Triangle's orientation. Sides of up to 16384 pixels fit.
int area2(ivec2 a, ivec2 b, ivec2 c) {
    return (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
}

/// 256 part / whole, rounded to the nearest. Corners with weight within kMeshReach_px, of which one edge has two at
/// least, and sides of at most 16384 pixels keep `whole` below 2^23, and the products below 2^32.
int weight_256(int part, int whole) {
    return static_cast<int>((512U * static_cast<unsigned>(part) + static_cast<unsigned>(whole)) /
                            (2U * static_cast<unsigned>(whole)));
}

bool within_reach(ivec2 offset) {
    return std::abs(offset.x) <= kMeshReach_px && std::abs(offset.y) <= kMeshReach_px;
}

std::string at(ivec2 pixel) {
    return std::to_string(pixel.x) + ", " + std::to_string(pixel.y);
}

/// One of a triangle's corners, seen from a pixel.
struct Part {
    int weight = 0;  ///< times the triangle's doubled area
    ivec2 corner = ivec2(0);
    std::uint32_t site = 0;

    [[nodiscard]] bool before(const Part& other) const {
        if (weight != other.weight) return weight > other.weight;
        if (corner.y != other.corner.y) return corner.y < other.corner.y;
        return corner.x < other.corner.x;
    }
};

/// Fills a table triangle by triangle.
class Rasterizer {
public:
    explicit Rasterizer(const SampleMesh& mesh)
        : mesh_(mesh),
          pixels_(static_cast<std::size_t>(mesh.width_px) * static_cast<std::size_t>(mesh.height_px), {kUnset}),
          share_(mesh.site.size(), 256U) {
        for (const SamplePosition& p : mesh.site) pixels_[index({p.x_px, p.y_px})] = {};
    }

    void draw(const SampleMesh::Triangle& triangle);

    /// Whether a pixel was found that reaches too far: there is no use in going on.
    [[nodiscard]] bool failed() const { return out_of_reach_.has_value(); }
    /// What is wrong with the table after the last triangle; empty if nothing is.
    [[nodiscard]] std::string fault() const;

    [[nodiscard]] std::vector<MeshPixel> take_pixels() { return std::move(pixels_); }
    [[nodiscard]] std::vector<float> spacing_px() const {
        std::vector<float> spacing(share_.size());
        for (std::size_t i = 0; i < share_.size(); ++i) spacing[i] = std::sqrt(static_cast<float>(share_[i]) / 256.0F);
        return spacing;
    }

private:
    [[nodiscard]] std::size_t index(ivec2 pixel) const {
        return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(mesh_.width_px) +
               static_cast<std::size_t>(pixel.x);
    }
    void set(ivec2 pixel, std::array<Part, 3> part, int whole);

    const SampleMesh& mesh_;
    std::vector<MeshPixel> pixels_;
    std::vector<std::uint32_t> share_;                     ///< per site, sum of its weights in 1/256
    std::optional<std::pair<ivec2, ivec2>> out_of_reach_;  ///< first pixel found, and the corner
};

void Rasterizer::draw(const SampleMesh::Triangle& triangle) {
    std::array<Part, 3> part;
    for (std::size_t i = 0; i < 3; ++i) {
        const SamplePosition& p = mesh_.site[triangle[i]];
        part[i] = {0, {p.x_px, p.y_px}, triangle[i]};
    }
    const ivec2 a = part[0].corner;
    const ivec2 b = part[1].corner;
    const ivec2 c = part[2].corner;
    const int whole = area2(a, b, c);
    // Pick's theorem: twice the area is 2 (pixels inside) + (pixels on the edges) - 2. At 1, the corners are all.
    if (whole <= 1) return;
    const ivec2 first = glm::min(glm::min(a, b), c);
    const ivec2 last = glm::max(glm::max(a, b), c);
    // Weights are linear: their steps from a pixel to the next.
    const std::array<int, 3> step_x = {c.y - b.y, a.y - c.y, b.y - a.y};
    const std::array<int, 3> step_y = {b.x - c.x, c.x - a.x, a.x - b.x};
    std::array<int, 3> row = {area2(first, b, c), area2(first, c, a), area2(first, a, b)};
    for (int y = first.y; y <= last.y; ++y) {
        std::array<int, 3> weight = row;
        for (int x = first.x; x <= last.x; ++x) {
            if ((weight[0] | weight[1] | weight[2]) >= 0 && pixels_[index({x, y})].ax == kUnset) {
                for (std::size_t i = 0; i < 3; ++i) part[i].weight = weight[i];
                set({x, y}, part, whole);
            }
            for (std::size_t i = 0; i < 3; ++i) weight[i] += step_x[i];
        }
        for (std::size_t i = 0; i < 3; ++i) row[i] += step_y[i];
    }
}

void Rasterizer::set(ivec2 pixel, std::array<Part, 3> part, int whole) {
    if (part[1].before(part[0])) std::swap(part[0], part[1]);
    if (part[2].before(part[1])) std::swap(part[1], part[2]);
    if (part[1].before(part[0])) std::swap(part[0], part[1]);
    if (part[2].weight == 0) part[2] = part[0];
    for (const Part& p : part) {
        if (within_reach(p.corner - pixel)) continue;
        if (!out_of_reach_) out_of_reach_ = {pixel, p.corner};
        return;
    }
    int weight_b = weight_256(part[1].weight, whole);
    const int weight_c = part[2].site == part[0].site ? 0 : weight_256(part[2].weight, whole);
    // Rounding both up must not make b the largest.
    if (weight_b > 256 - weight_b - weight_c) --weight_b;
    const ivec2 to_a = part[0].corner - pixel;
    const ivec2 to_b = part[1].corner - pixel;
    const ivec2 to_c = part[2].corner - pixel;
    const auto byte = [](int value) { return static_cast<std::int8_t>(value); };
    pixels_[index(pixel)] = {byte(to_a.x),
                             byte(to_a.y),
                             byte(to_b.x),
                             byte(to_b.y),
                             byte(to_c.x),
                             byte(to_c.y),
                             static_cast<std::uint8_t>(weight_b),
                             static_cast<std::uint8_t>(weight_c)};
    share_[part[0].site] += static_cast<std::uint32_t>(256 - weight_b - weight_c);
    share_[part[1].site] += static_cast<std::uint32_t>(weight_b);
    share_[part[2].site] += static_cast<std::uint32_t>(weight_c);
}

std::string Rasterizer::fault() const {
    if (out_of_reach_) {
        return std::string("pixel (") + at(out_of_reach_->first) + ") lies in a triangle whose corner (" +
               at(out_of_reach_->second) + ") is more than " + std::to_string(kMeshReach_px) +
               " pixels away: the mask needs more samples there";
    }
    const auto uncovered =
        std::find_if(pixels_.begin(), pixels_.end(), [](const MeshPixel& p) { return p.ax == kUnset; });
    if (uncovered == pixels_.end()) return {};
    const auto i = static_cast<int>(uncovered - pixels_.begin());
    return std::string("no triangle covers pixel (") + at({i % mesh_.width_px, i / mesh_.width_px}) + ")";
}

}  // namespace

Expected<MeshTable> MeshTable::make(SampleMesh mesh) {
    Rasterizer rasterizer(mesh);
    for (const SampleMesh::Triangle& triangle : mesh.triangle) {
        rasterizer.draw(triangle);
        if (rasterizer.failed()) break;
    }
    if (const std::string fault = rasterizer.fault(); !fault.empty())
        return fail(ErrorCode::input_file, std::string("sampling mesh: ") + fault);
    MeshTable table;
    table.pixels_ = rasterizer.take_pixels();
    table.spacing_px_ = rasterizer.spacing_px();
    table.blocks_ = MeshBlocks({mesh.width_px, mesh.height_px}, mesh.site, table.spacing_px_, table.pixels_);
    table.mesh_ = std::move(mesh);
    return table;
}

std::size_t MeshTable::memory_bytes() const {
    return pixels_.size() * sizeof(MeshPixel) + spacing_px_.size() * sizeof(float) + blocks_.memory_bytes() +
           mesh_.site.size() * sizeof(SamplePosition) + mesh_.triangle.size() * sizeof(SampleMesh::Triangle) +
           mesh_.recipe.size();
}

}  // namespace macula
