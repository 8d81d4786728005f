#pragma once

#include <array>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scenes/scene.h"

namespace macula {

/// What breaks a promise that scenes/scene.h makes to tracers; empty if nothing does.
inline std::string scene_defect(const Scene& scene) {
    const auto in_range = [](int index, std::size_t size) {
        return index >= 0 && static_cast<std::size_t>(index) < size;
    };
    const auto finite = [](const auto& v) {
        for (int i = 0; i < v.length(); ++i)
            if (!std::isfinite(v[i])) return false;
        return true;
    };
    const auto is_unit = [](const glm::vec3& v) { return std::abs(glm::length(v) - 1.0F) < 1e-3F; };

    if (scene.materials.empty()) return "no materials";
    for (const TextureImage& image : scene.images)
        if (image.width_px < 1 || image.height_px < 1 || image.channels < 1 || image.channels > 4 ||
            image.texels.size() != image.texel_count() * image.texel_bytes())
            return "image of the wrong size: " + image.name;
    const auto uses = [](const Material& m) {
        return std::array{m.base_color_texture, m.metallic_roughness_texture, m.normal_texture, m.emissive_texture};
    };
    for (const Material& material : scene.materials)
        for (const TextureUse& use : uses(material))
            if (use.present() && (!in_range(use.image, scene.images.size()) || use.uv_set < 0 || use.uv_set > 1 ||
                                  !finite(use.uv_scale_rotation) || !finite(use.uv_offset)))
                return "broken texture use in material " + material.name;
    for (const Mesh& mesh : scene.meshes) {
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
        if (material.normal_texture.present() && mesh.tangent.empty()) return "no tangents in " + mesh.name;
        for (const TextureUse& use : uses(material)) {
            const auto& uv = use.uv_set == 0 ? mesh.uv0 : mesh.uv1;
            if (use.present() && uv.empty()) return "no texture coordinates in " + mesh.name;
            for (const glm::vec2& p : uv)
                if (!finite(p)) return "texture coordinate not finite in " + mesh.name;
        }
    }
    for (const Instance& instance : scene.instances) {
        if (!in_range(instance.mesh, scene.meshes.size())) return "mesh out of range in " + instance.name;
        for (int c = 0; c < 4; ++c)
            if (!finite(instance.world_from_mesh[c])) return "transform not finite in " + instance.name;
        if (glm::determinant(glm::dmat3(instance.world_from_mesh)) == 0.0) return "singular " + instance.name;
    }
    for (const Light& light : scene.lights) {
        if (!finite(light.intensity) || !finite(light.position_m) || light.range_m < 0.0F) return "broken light";
        if (!is_unit(light.direction) || light.spot_cos_inner <= light.spot_cos_outer) return "broken light cone";
    }
    if (!finite(scene.world_from_start.position_m) || !(scene.near_m > 0.0F)) return "no start pose";
    if (!(scene.exposure > 0.0F) || !std::isfinite(scene.exposure)) return "no exposure";
    return {};
}

}  // namespace macula
