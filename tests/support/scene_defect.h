#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scenes/material_textures.h"
#include "scenes/scene.h"

namespace macula {
namespace defect {

inline bool in_range(int index, std::size_t size) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
}

template <class Vector>
bool finite(const Vector& v) {
    for (int i = 0; i < v.length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

inline bool finite(const glm::mat4& m) {
    return finite(m[0]) && finite(m[1]) && finite(m[2]) && finite(m[3]);
}

inline bool is_unit(const glm::vec3& v) {
    return std::abs(glm::length(v) - 1.0F) < 1e-3F;
}

inline bool is_share(float x) {
    return x >= 0.0F && x <= 1.0F;
}

inline bool is_positive(const glm::vec3& v) {
    return finite(v) && v.x >= 0.0F && v.y >= 0.0F && v.z >= 0.0F;
}

inline std::string of_material(const Scene& scene, const Material& m) {
    for (const TextureUse* use : texture_uses(m))
        if (use->present() && (!in_range(use->image, scene.images.size()) || use->uv_set < 0 || use->uv_set > 1 ||
                               !finite(use->uv_scale_rotation) || !finite(use->uv_offset)))
            return "broken texture use in material " + m.name;
    for (const float share : {m.metallic, m.roughness, m.specular, m.clearcoat, m.clearcoat_roughness,
                              m.sheen_roughness, m.transmission, m.attenuation_color.r, m.attenuation_color.g,
                              m.attenuation_color.b, m.sheen_color.r, m.sheen_color.g, m.sheen_color.b})
        if (!is_share(share)) return "factor out of range in material " + m.name;
    if (!(m.ior >= 1.0F) || !std::isfinite(m.ior)) return "ior out of range in material " + m.name;
    if (!is_positive(m.emissive) || !is_positive(m.specular_color) ||
        !is_positive({m.thickness_m, m.attenuation_distance_m, 0.0F}))
        return "factor negative or not finite in material " + m.name;
    if (!std::isfinite(m.normal_scale) || !std::isfinite(m.clearcoat_normal_scale) || !std::isfinite(m.alpha_cutoff))
        return "scale or cutoff not finite in material " + m.name;
    return {};
}

inline std::string of_mesh(const Scene& scene, const Mesh& mesh) {
    const std::size_t n = mesh.position_m.size();
    if (!in_range(mesh.material, scene.materials.size())) return "material out of range in " + mesh.name;
    const auto fits = [n](const auto& attribute) { return attribute.empty() || attribute.size() == n; };
    if (mesh.normal.size() != n || !fits(mesh.tangent) || !fits(mesh.uv0) || !fits(mesh.uv1) || !fits(mesh.color))
        return "attribute of the wrong length in " + mesh.name;
    if (mesh.triangle.empty()) return "no triangles in " + mesh.name;
    for (const glm::uvec3& t : mesh.triangle)
        if (t.x >= n || t.y >= n || t.z >= n) return "index out of range in " + mesh.name;
    for (const glm::vec3& p : mesh.position_m)
        if (!finite(p)) return "position not finite in " + mesh.name;
    for (const glm::vec3& v : mesh.normal)
        if (!is_unit(v)) return "normal not unit in " + mesh.name;
    for (const glm::vec4& v : mesh.tangent)
        if (!is_unit(glm::vec3(v)) || std::abs(v.w) != 1.0F) return "tangent not unit in " + mesh.name;
    for (const glm::vec4& v : mesh.color)
        if (!finite(v)) return "colour not finite in " + mesh.name;
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    if ((material.normal_texture.present() || material.clearcoat_normal_texture.present()) && mesh.tangent.empty())
        return "no tangents in " + mesh.name;
    for (const TextureUse* use : texture_uses(material)) {
        const auto& uv = use->uv_set == 0 ? mesh.uv0 : mesh.uv1;
        if (use->present() && uv.empty()) return "no texture coordinates in " + mesh.name;
    }
    for (const auto* uv : {&mesh.uv0, &mesh.uv1})
        for (const glm::vec2& p : *uv)
            if (!finite(p)) return "texture coordinate not finite in " + mesh.name;
    return {};
}

inline std::string of_light(const Scene& scene, const Light& light) {
    if (!is_positive(light.intensity) || !finite(light.position_m) || !(light.range_m >= 0.0F)) return "broken light";
    if (!is_unit(light.direction) || light.spot_cos_inner <= light.spot_cos_outer) return "broken light cone";
    if (light.instance != -1 && !in_range(light.instance, scene.instances.size())) return "light of no instance";
    if (light.node != -1 && !in_range(light.node, scene.animation.nodes.size())) return "light of no node";
    if (light.kind == LightKind::rectangle) {
        const glm::dvec3 normal = glm::cross(glm::dvec3(light.half_u_m), glm::dvec3(light.half_v_m));
        if (!(glm::dot(glm::normalize(normal), glm::dvec3(light.direction)) > 0.999)) return "rectangle askew";
    }
    return {};
}

inline std::string of_animation(const Animation& animation) {
    const std::size_t nodes = animation.nodes.size();
    for (std::size_t i = 0; i < nodes; ++i)
        if (animation.nodes[i].parent < -1 || animation.nodes[i].parent >= static_cast<int>(i))
            return "parents have to lie before their children";
    for (const AnimationChannel& channel : animation.channels) {
        if (!in_range(channel.node, nodes)) return "channel of no node";
        const std::size_t keys = channel.time_s.size();
        const std::size_t values = channel.interpolation == Interpolation::cubic_spline ? 3 * keys : keys;
        if (keys == 0 || channel.value.size() != values) return "channel with a wrong number of values";
        for (std::size_t i = 1; i < keys; ++i)
            if (!(channel.time_s[i] > channel.time_s[i - 1])) return "times of a channel do not rise";
        if (!(channel.period_s >= 0.0F) || !(channel.period_s <= animation.duration_s)) return "broken period";
    }
    // Not evenly, and beyond both ends of the period.
    std::vector<glm::mat4> world_from_node;
    for (const double share : {-0.5, 0.0, 0.1, 0.25, 0.4, 0.5, 0.7, 0.999, 1.0, 17.3}) {
        pose_nodes(animation, share * static_cast<double>(animation.duration_s), world_from_node);
        for (const glm::mat4& m : world_from_node)
            if (!finite(m)) return "a pose is not finite";
    }
    return {};
}

/// Instances, at time 0 and in their meshes' order.
inline std::string of_instances(const Scene& scene) {
    std::vector<glm::mat4> world_from_node;
    pose_nodes(scene.animation, 0.0, world_from_node);
    for (const Instance& instance : scene.instances) {
        if (!in_range(instance.mesh, scene.meshes.size())) return "mesh out of range in " + instance.name;
        if (!finite(instance.world_from_mesh)) return "transform not finite in " + instance.name;
        if (glm::determinant(glm::dmat3(instance.world_from_mesh)) == 0.0) return "singular " + instance.name;
        if (instance.node == -1) continue;
        if (!in_range(instance.node, world_from_node.size())) return "node out of range in " + instance.name;
        if (world_from_node[static_cast<std::size_t>(instance.node)] != instance.world_from_mesh)
            return "is not where time 0 puts it: " + instance.name;
    }
    return {};
}

}  // namespace defect

/// What breaks a promise that scenes/scene.h makes to tracers; empty if nothing does.
inline std::string scene_defect(const Scene& scene) {
    if (scene.materials.empty()) return "no materials";
    for (const TextureImage& image : scene.images)
        if (image.width_px < 1 || image.height_px < 1 || image.channels < 1 || image.channels > 4 ||
            image.texels.size() != image.texel_count() * image.texel_bytes())
            return "image of the wrong size: " + image.name;
    for (const Material& material : scene.materials)
        if (std::string found = defect::of_material(scene, material); !found.empty()) return found;
    for (const Mesh& mesh : scene.meshes)
        if (std::string found = defect::of_mesh(scene, mesh); !found.empty()) return found;
    if (std::string found = defect::of_animation(scene.animation); !found.empty()) return found;
    if (std::string found = defect::of_instances(scene); !found.empty()) return found;
    for (const Light& light : scene.lights)
        if (std::string found = defect::of_light(scene, light); !found.empty()) return found;
    for (const SceneCamera& camera : scene.cameras)
        if (!defect::finite(camera.world_from_head.position_m) ||
            std::abs(glm::length(camera.world_from_head.orientation) - 1.0F) > 1e-4F)
            return "broken camera " + camera.name;
    if (!defect::finite(scene.world_from_start.position_m) || !(scene.near_m > 0.0F)) return "no start pose";
    if (!(scene.exposure > 0.0F) || !std::isfinite(scene.exposure)) return "no exposure";
    return {};
}

}  // namespace macula
