#include "server/render/shading_scene.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace macula {
namespace {

kernels::Light kernel_light(const Light& light) {
    kernels::Light result{};
    const bool local = light.kind != LightKind::directional;
    result.position = local ? glm::vec4(light.position_m, 1.0F) : glm::vec4(-light.direction, 0.0F);
    result.direction = light.direction;
    result.intensity = light.intensity;
    result.inverse_range = local && light.range_m > 0.0F ? 1.0F / light.range_m : 0.0F;
    result.spot_scale = 0.0F;
    result.spot_offset = 1.0F;
    if (light.kind == LightKind::spot) {
        result.spot_scale = 1.0F / std::max(0.001F, light.spot_cos_inner - light.spot_cos_outer);
        result.spot_offset = -light.spot_cos_outer * result.spot_scale;
    }
    return result;
}

template <class T>
std::size_t bytes_of(const std::vector<std::vector<T>>& arrays) {
    std::size_t bytes = 0;
    for (const auto& array : arrays) bytes += array.capacity() * sizeof(T) + sizeof(array);
    return bytes;
}

}  // namespace

bool mirrors(const Instance& instance) {
    return glm::determinant(glm::mat3(instance.world_from_mesh)) < 0.0F;
}

ShadingScene::ShadingScene(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {
    const std::size_t count = scene_->instances.size();
    instances_.reserve(count);
    normals_.reserve(count);
    tangents_.reserve(count);
    for (const Instance& instance : scene_->instances) add_instance(instance);
    for (const Light& light : scene_->lights) {
        if (light.intensity != glm::vec3(0.0F)) lights_.push_back({kernel_light(light), light.casts_shadow});
    }
}

void ShadingScene::add_instance(const Instance& instance) {
    const Mesh& mesh = scene_->meshes[static_cast<std::size_t>(instance.mesh)];
    const Material& material = scene_->materials[static_cast<std::size_t>(mesh.material)];
    const glm::mat3 world_from_mesh(instance.world_from_mesh);
    const glm::mat3 normal_matrix = glm::transpose(glm::inverse(world_from_mesh));
    ShadingInstance result;
    result.material = &material;
    result.triangle = mesh.triangle.data();
    if (mirrors(instance)) {
        auto& triangles = mirrored_triangles_.emplace_back(mesh.triangle);
        for (glm::uvec3& t : triangles) std::swap(t.y, t.z);
        result.triangle = triangles.data();
    }

    auto& normals = normals_.emplace_back(mesh.normal);
    for (glm::vec3& n : normals) n = glm::normalize(normal_matrix * n);
    result.normal = normals.data();

    const auto add_texture = [&](const TextureUse& use, Feature feature, ShadingTexture& destination,
                                 TextureContent content = TextureContent::values, float alpha_cutoff = 0.0F) {
        const auto& uv = use.uv_set == 0 ? mesh.uv0 : mesh.uv1;
        if (!use.present() || uv.empty()) return;
        destination = texture(use, mesh, content, alpha_cutoff);
        result.features |= feature;
    };
    const bool covers = material.alpha_mode != AlphaMode::opaque;
    const bool cuts = material.alpha_mode == AlphaMode::mask && material.base_color.w > 0.0F;
    add_texture(material.base_color_texture, kBaseColorTexture, result.base_color,
                covers ? TextureContent::covered_color : TextureContent::values,
                cuts ? material.alpha_cutoff / material.base_color.w : 0.0F);
    if (!mesh.color.empty()) {
        result.color = mesh.color.data();
        result.features |= kVertexColor;
    }
    if (material.unlit) {
        result.features |= kUnlit;
    } else {
        add_texture(material.metallic_roughness_texture, kMetallicRoughnessTexture, result.metallic_roughness);
        add_texture(material.emissive_texture, kEmissiveTexture, result.emissive);
        if (!mesh.tangent.empty())
            add_texture(material.normal_texture, kNormalTexture, result.normal_map, TextureContent::normals);
    }
    if ((result.features & kNormalTexture) != 0) {
        // The bitangent keeps its side of the mirrored normal and tangent: cross products flip.
        const float handedness = mirrors(instance) ? -1.0F : 1.0F;
        auto& tangents = tangents_.emplace_back(mesh.tangent);
        for (glm::vec4& t : tangents) t = glm::vec4(glm::normalize(world_from_mesh * glm::vec3(t)), t.w * handedness);
        result.tangent = tangents.data();
    }
    instances_.push_back(result);
}

ShadingTexture ShadingScene::texture(const TextureUse& use, const Mesh& mesh, TextureContent content,
                                     float alpha_cutoff) {
    const TextureImage& image = scene_->images[static_cast<std::size_t>(use.image)];
    return {textures_.view(use, image, content, alpha_cutoff), use.uv_set == 0 ? mesh.uv0.data() : mesh.uv1.data()};
}

std::size_t ShadingScene::memory_bytes() const {
    return instances_.capacity() * sizeof(ShadingInstance) + bytes_of(normals_) + bytes_of(tangents_) +
           bytes_of(mirrored_triangles_) + textures_.memory_bytes();
}

}  // namespace macula
