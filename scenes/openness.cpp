#include "scenes/openness.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <thread>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace macula {
namespace {

/// Surface area per cell, as the transmittance of a ray that crosses the cell.
class AreaGrid {
public:
    explicit AreaGrid(const OpennessOptions& options) : low_(options.low), per_m_(1.0F / options.cell_m) {
        size_ = glm::ivec3(glm::ceil((options.high - options.low) * per_m_));
        area_.assign(
            static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z),
            0.0F);
    }

    /// Spreads a triangle's area over points less than a cell apart: rows of points along its longest edge.
    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        for (int turn = 0; turn < 2; ++turn) {
            const float ab = glm::length(b - a);
            if (ab >= glm::length(c - b) && ab >= glm::length(a - c)) break;
            const glm::vec3 first = a;
            a = b;
            b = c;
            c = first;
        }
        const float length = glm::length(b - a);
        const float area = 0.5F * glm::length(glm::cross(b - a, c - a));
        const auto points = [this](float m) { return std::max(1, static_cast<int>(std::ceil(m * per_m_ * 1.4F))); };
        const int rows = points(2.0F * area / std::max(length, 1e-9F));
        for (int row = 0; row < rows; ++row) {
            const float v = (static_cast<float>(row) + 0.5F) / static_cast<float>(rows);
            const int count = points(length * (1.0F - v));
            const float share = 2.0F * area * (1.0F - v) / static_cast<float>(rows * count);
            for (int i = 0; i < count; ++i) {
                const float u = (static_cast<float>(i) + 0.5F) / static_cast<float>(count) * (1.0F - v);
                const std::ptrdiff_t to = cell(a + (b - a) * u + (c - a) * v);
                if (to >= 0) area_[static_cast<std::size_t>(to)] += share;
            }
        }
    }

    /// Turns areas into transmittances: a wall as large as the cell's side, whichever way it turns, covers most of it.
    void finish() {
        for (float& a : area_) a = std::exp(-1.6F * a * per_m_ * per_m_);
    }

    /// Transmittance at a point; 1 outside.
    [[nodiscard]] float transmittance(const glm::vec3& p) const {
        const std::ptrdiff_t i = cell(p);
        return i < 0 ? 1.0F : area_[static_cast<std::size_t>(i)];
    }

    [[nodiscard]] bool holds(const glm::vec3& p) const { return cell(p) >= 0; }

private:
    /// Index of the cell that holds a point; -1 outside.
    [[nodiscard]] std::ptrdiff_t cell(const glm::vec3& p) const {
        const glm::vec3 q = (p - low_) * per_m_;
        const glm::vec3 size(size_);
        if (!(q.x >= 0.0F && q.y >= 0.0F && q.z >= 0.0F && q.x < size.x && q.y < size.y && q.z < size.z)) return -1;
        const glm::ivec3 i(q);
        return (static_cast<std::ptrdiff_t>(i.z) * size_.y + i.y) * size_.x + i.x;
    }

    glm::vec3 low_;
    float per_m_;
    glm::ivec3 size_{};
    std::vector<float> area_;
};

bool counts(const Material& m) {
    return m.alpha_mode == AlphaMode::opaque && m.transmission == 0.0F && !m.unlit && m.emissive == glm::vec3(0.0F);
}

/// Cosine-weighted directions about +Z (Malley's method on a Fibonacci spiral).
std::vector<glm::vec3> make_directions(int count) {
    std::vector<glm::vec3> directions;
    constexpr float kGolden = 2.39996323F;  // rad
    for (int i = 0; i < count; ++i) {
        const float r = std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(count));
        const float a = kGolden * static_cast<float>(i);
        directions.emplace_back(r * std::cos(a), r * std::sin(a), std::sqrt(std::max(0.0F, 1.0F - r * r)));
    }
    return directions;
}

float openness(const AreaGrid& grid, const std::vector<glm::vec3>& directions, const glm::vec3& p, const glm::vec3& n,
               const OpennessOptions& options) {
    // Any basis about the normal (Duff et al. 2017).
    const float s = n.z < 0.0F ? -1.0F : 1.0F;
    const float a = -1.0F / (s + n.z);
    const glm::vec3 x(1.0F + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
    const glm::vec3 y(n.x * n.y * a, s + n.y * n.y * a, -n.y);
    // The surface's own cells are stepped over.
    const float first = 1.3F * options.cell_m;
    float sum = 0.0F;
    for (const glm::vec3& d : directions) {
        const glm::vec3 way = d.x * x + d.y * y + d.z * n;
        float through = 1.0F;
        float seen = 0.0F;  // what is further away hides less
        float step = options.cell_m;
        for (float t = 0.7F * step; t < options.reach_m && through > 0.05F; t += step, step *= 1.3F) {
            const float before = through;
            through *= grid.transmittance(p + n * first + way * t);
            seen += (before - through) * (1.0F - t / options.reach_m);
        }
        sum += 1.0F - seen;
    }
    return sum / static_cast<float>(directions.size());
}

/// Vertex colours of one mesh by what its instances see.
void darken(Mesh& mesh, const std::vector<const Instance*>& instances, const AreaGrid& grid,
            const std::vector<glm::vec3>& directions, const OpennessOptions& options) {
    std::vector<float> sum(mesh.position_m.size(), 0.0F);
    for (const Instance* instance : instances) {
        const glm::mat3 normals = glm::transpose(glm::inverse(glm::mat3(instance->world_from_mesh)));
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const glm::vec3 p(instance->world_from_mesh * glm::vec4(mesh.position_m[i], 1.0F));
            sum[i] +=
                grid.holds(p) ? openness(grid, directions, p, glm::normalize(normals * mesh.normal[i]), options) : 1.0F;
        }
    }
    mesh.color.resize(mesh.position_m.size(), glm::vec4(1.0F));
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const float open = std::clamp(sum[i] / static_cast<float>(instances.size()), 0.0F, 1.0F);
        mesh.color[i] *= glm::vec4(glm::vec3(glm::mix(options.darkest, 1.0F, open)), 1.0F);
    }
}

}  // namespace

void darken_corners(Scene& scene, const OpennessOptions& options) {
    constexpr std::size_t kInstancesPerMesh = 2;
    AreaGrid grid(options);
    std::vector<std::vector<const Instance*>> placed(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
        const auto index = static_cast<std::size_t>(instance.mesh);
        const Mesh& mesh = scene.meshes[index];
        if (!counts(scene.materials[static_cast<std::size_t>(mesh.material)])) continue;
        if (placed[index].size() < kInstancesPerMesh) placed[index].push_back(&instance);
        const auto world = [&](unsigned i) {
            return glm::vec3(instance.world_from_mesh * glm::vec4(mesh.position_m[i], 1.0F));
        };
        for (const glm::uvec3& t : mesh.triangle) grid.add(world(t.x), world(t.y), world(t.z));
    }
    grid.finish();
    const std::vector<glm::vec3> directions = make_directions(options.directions);
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t m = next++; m < scene.meshes.size(); m = next++)
            if (!placed[m].empty()) darken(scene.meshes[m], placed[m], grid, directions, options);
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) others.emplace_back(work);
    work();
}

}  // namespace macula
