#include "scenes/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace macula {
namespace {

constexpr float kEyeHeight = 1.6F;     // m
constexpr float kSmallestRoom = 2.0F;  // m
constexpr std::size_t kDirections = 26;
constexpr std::size_t kEnclosed = 20;

/// The directions from the middle of a cube to its corners, edges and faces.
std::array<glm::vec3, kDirections> probe_directions() {
    std::array<glm::vec3, kDirections> directions = {};
    std::size_t count = 0;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if (x != 0 || y != 0 || z != 0) directions[count++] = glm::normalize(glm::vec3(x, y, z));
    return directions;
}

/// Distance along `direction` to the triangle (Moeller and Trumbore 1997); infinity where it is missed.
float hit_distance(const glm::vec3& origin, const glm::vec3& direction, const std::array<glm::vec3, 3>& t) {
    constexpr float kMiss = std::numeric_limits<float>::infinity();
    const glm::vec3 e1 = t[1] - t[0];
    const glm::vec3 e2 = t[2] - t[0];
    const glm::vec3 p = glm::cross(direction, e2);
    const float determinant = glm::dot(e1, p);
    if (determinant == 0.0F) return kMiss;
    const glm::vec3 s = origin - t[0];
    const float u = glm::dot(s, p) / determinant;
    if (!(u >= 0.0F && u <= 1.0F)) return kMiss;
    const glm::vec3 q = glm::cross(s, e1);
    const float v = glm::dot(direction, q) / determinant;
    if (!(v >= 0.0F && u + v <= 1.0F)) return kMiss;
    const float distance = glm::dot(e2, q) / determinant;
    return distance > 0.0F ? distance : kMiss;
}

/// Whether a ray meets a box (slab test; a ray within a side's plane counts as inside).
bool meets(const glm::vec3& origin, const glm::vec3& direction, const Bounds& box) {
    float near = 0.0F;
    float far = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0.0F) {
            if (origin[i] < box.low[i] || origin[i] > box.high[i]) return false;
            continue;
        }
        const float a = (box.low[i] - origin[i]) / direction[i];
        const float b = (box.high[i] - origin[i]) / direction[i];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near <= far;
}

/// Box around the placed corners of a box.
Bounds placed_box(const Bounds& box, const glm::mat4& world_from_mesh) {
    Bounds placed;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                          (corner & 4) != 0 ? box.high.z : box.low.z);
        placed.add(glm::vec3(world_from_mesh * glm::vec4(p, 1.0F)));
    }
    return placed;
}

std::vector<Bounds> mesh_boxes(const Scene& scene) {
    std::vector<Bounds> boxes(scene.meshes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (const glm::vec3& p : scene.meshes[i].position_m) boxes[i].add(p);
    return boxes;
}

/// Looks from one point along 26 directions for what is met first.
class EnclosureProbe {
public:
    EnclosureProbe(const Scene& scene, const glm::vec3& eye) : scene_(scene), eye_(eye) {}

    /// Whether most probes meet the front of a surface first. A few hundred milliseconds for a million triangles, once;
    /// of more than kMostTriangles near the probes it says no.
    bool is_enclosed() {
        const std::vector<Bounds> boxes = mesh_boxes(scene_);
        std::size_t triangles = 0;
        for (const Instance& instance : scene_.instances) {
            const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
            const Bounds box = placed_box(boxes[static_cast<std::size_t>(instance.mesh)], instance.world_from_mesh);
            if (std::none_of(directions_.begin(), directions_.end(),
                             [&](const glm::vec3& direction) { return meets(eye_, direction, box); }))
                continue;
            triangles += mesh.triangle.size();
            if (triangles > kMostTriangles) return false;
            probe(instance, mesh);
        }
        const auto front = std::count_if(nearest_.begin(), nearest_.end(), [](const Nearest& n) { return n.front; });
        return static_cast<std::size_t>(front) >= kEnclosed;
    }

private:
    static constexpr std::size_t kMostTriangles = std::size_t{1} << 26U;

    struct Nearest {
        float distance = std::numeric_limits<float>::infinity();
        bool front = false;
    };

    void probe(const Instance& instance, const Mesh& mesh) {
        const bool mirrored = glm::determinant(glm::mat3(instance.world_from_mesh)) < 0.0F;
        for (const glm::uvec3& triangle : mesh.triangle) {
            std::array<glm::vec3, 3> corners;
            for (int c = 0; c < 3; ++c)
                corners[static_cast<std::size_t>(c)] =
                    glm::vec3(instance.world_from_mesh * glm::vec4(mesh.position_m[triangle[c]], 1.0F));
            const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            for (std::size_t i = 0; i < kDirections; ++i) {
                const float distance = hit_distance(eye_, directions_[i], corners);
                if (distance < nearest_[i].distance)
                    nearest_[i] = {distance, (glm::dot(normal, directions_[i]) < 0.0F) != mirrored};
            }
        }
    }

    const Scene& scene_;
    glm::vec3 eye_;
    std::array<glm::vec3, kDirections> directions_ = probe_directions();
    std::array<Nearest, kDirections> nearest_ = {};
};

float near_depth(float distance) {
    return std::clamp(0.05F * distance, 0.001F, 0.1F);
}

}  // namespace

Bounds world_bounds(const Scene& scene) {
    constexpr std::size_t kMostVertices = std::size_t{1} << 26U;
    std::size_t vertices = 0;
    for (const Instance& instance : scene.instances)
        vertices += scene.meshes[static_cast<std::size_t>(instance.mesh)].position_m.size();
    Bounds bounds;
    if (vertices <= kMostVertices) {
        for (const Instance& instance : scene.instances)
            for (const glm::vec3& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].position_m)
                bounds.add(glm::vec3(instance.world_from_mesh * glm::vec4(p, 1.0F)));
        return bounds;
    }
    const std::vector<Bounds> boxes = mesh_boxes(scene);
    for (const Instance& instance : scene.instances) {
        const Bounds placed = placed_box(boxes[static_cast<std::size_t>(instance.mesh)], instance.world_from_mesh);
        bounds.add(placed.low);
        bounds.add(placed.high);
    }
    return bounds;
}

Pose level_head(const Pose& world_from_head) {
    glm::vec3 ahead = world_from_head.direction({0.0F, 0.0F, -1.0F});
    // Within half a degree of the vertical the chin or the top of the head tells more.
    if (std::abs(ahead.y) > 0.99996F)
        ahead = (ahead.y < 0.0F ? 1.0F : -1.0F) * world_from_head.direction({0.0F, 1.0F, 0.0F});
    const float yaw = std::atan2(-ahead.x, -ahead.z);
    return {glm::angleAxis(yaw, glm::vec3(0.0F, 1.0F, 0.0F)), world_from_head.position_m};
}

void frame_start(Scene& scene, const Bounds& bounds) {
    const glm::vec3 middle = bounds.middle();
    const glm::vec3 size = bounds.size();
    scene.world_from_start = Pose{};
    if (!scene.cameras.empty()) {
        scene.world_from_start = level_head(scene.cameras.front().world_from_head);
        scene.near_m = near_depth(std::max(glm::distance(scene.world_from_start.position_m, middle), bounds.radius()));
        return;
    }
    const glm::vec3 standing(middle.x, bounds.low.y + kEyeHeight, middle.z);
    if (std::min({size.x, size.y, size.z}) >= kSmallestRoom && EnclosureProbe(scene, standing).is_enclosed()) {
        scene.world_from_start.position_m = standing;
        scene.near_m = 0.1F;
        return;
    }
    // A sphere of radius r fits into a cone of 80 degrees at the distance r / sin(40 degrees).
    const float distance = std::max(bounds.radius(), 1e-3F) / 0.643F;
    scene.world_from_start.position_m = middle + glm::vec3(0.0F, 0.0F, distance);
    scene.near_m = near_depth(distance);
}

}  // namespace macula
