#include "scenes/gltf_camera.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace macula {
namespace {

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

/// Whether the unit vectors or zeros span a plane.
bool span_plane(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(glm::cross(a, b)) > 1e-6;
}

glm::dvec3 any_other(const glm::dvec3& v) {
    return std::abs(v.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
}

}  // namespace

glm::quat extract_rotation(const glm::mat4& m) {
    const glm::dvec3 x = unit_or_zero(glm::dvec3(m[0]));
    glm::dvec3 y = unit_or_zero(glm::dvec3(m[1]));
    glm::dvec3 z = unit_or_zero(glm::dvec3(m[2]));
    if (z == glm::dvec3(0.0)) z = span_plane(x, y) ? glm::normalize(glm::cross(x, y)) : glm::dvec3(0.0, 0.0, 1.0);
    if (!span_plane(y, z)) y = span_plane(z, x) ? glm::cross(z, x) : any_other(z);
    const glm::dvec3 right = glm::normalize(glm::cross(y, z));
    return glm::normalize(glm::quat(glm::quat_cast(glm::dmat3(right, glm::cross(z, right), z))));
}

Expected<SceneCamera> read_gltf_camera(const GltfContext& context, int camera, const glm::mat4& world_from_node,
                                       const std::string& name) {
    const auto& cameras = context.document.model.cameras;
    if (camera < 0 || static_cast<std::size_t>(camera) >= cameras.size())
        return context.error("camera " + std::to_string(camera), "does not exist");
    const std::string& own = cameras[static_cast<std::size_t>(camera)].name;
    SceneCamera read;
    read.name = own.empty() ? name : own;
    read.world_from_head.position_m = glm::vec3(world_from_node[3]);
    read.world_from_head.orientation = extract_rotation(world_from_node);
    return read;
}

}  // namespace macula
