#include "scenes/framing.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Whether most probes from `eye` meet the front of a surface first. One pass over all triangles: a few hundred
/// milliseconds for a million, once.
bool is_enclosed(const Scene& scene, const glm::vec3& eye) {
    struct Nearest {
        float distance = std::numeric_limits<float>::infinity();
        bool front = false;
    };
    const std::array<glm::vec3, kDirections> directions = probe_directions();
    std::array<Nearest, kDirections> nearest;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const bool mirrored = glm::determinant(glm::mat3(instance.world_from_mesh)) < 0.0F;
        for (const glm::uvec3& triangle : mesh.triangle) {
            std::array<glm::vec3, 3> corners;
            for (int c = 0; c < 3; ++c)
                corners[static_cast<std::size_t>(c)] =
                    glm::vec3(instance.world_from_mesh * glm::vec4(mesh.position_m[triangle[c]], 1.0F));
            const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            for (std::size_t i = 0; i < kDirections; ++i) {
                const float distance = hit_distance(eye, directions[i], corners);
                if (distance < nearest[i].distance)
                    nearest[i] = {distance, (glm::dot(normal, directions[i]) < 0.0F) != mirrored};
            }
        }
    }
    const auto front = std::count_if(nearest.begin(), nearest.end(), [](const Nearest& n) { return n.front; });
    return static_cast<std::size_t>(front) >= kEnclosed;
}

}  // namespace

Bounds world_bounds(const Scene& scene) {
    Bounds bounds;
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].position_m)
            bounds.add(glm::vec3(instance.world_from_mesh * glm::vec4(p, 1.0F)));
    return bounds;
}

void frame_start(Scene& scene, const Bounds& bounds) {
    const glm::vec3 middle = bounds.middle();
    const glm::vec3 size = bounds.size();
    const glm::vec3 standing(middle.x, bounds.low.y + kEyeHeight, middle.z);
    scene.world_from_start = Pose{};
    if (std::min({size.x, size.y, size.z}) >= kSmallestRoom && is_enclosed(scene, standing)) {
        scene.world_from_start.position_m = standing;
        scene.near_m = 0.1F;
        return;
    }
    // A sphere of radius r fits into a cone of 80 degrees at the distance r / sin(40 degrees).
    const float distance = std::max(bounds.radius(), 1e-3F) / 0.643F;
    scene.world_from_start.position_m = middle + glm::vec3(0.0F, 0.0F, distance);
    scene.near_m = std::clamp(0.05F * distance, 0.001F, 0.1F);
}

}  // namespace macula
