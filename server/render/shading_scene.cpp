#include "server/render/shading_scene.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "server/kernels/fresnel.h"

namespace macula {
namespace {

/// The part of a directional, point or spot light.
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
    result.radius = local ? light.radius_m : std::sin(light.angular_radius_rad);
    return result;
}

ShadingLight shading_light(const Light& light) {
    ShadingLight result;
    result.is_rectangle = light.kind == LightKind::rectangle;
    result.casts_shadow = light.casts_shadow;
    result.is_seen = light.instance >= 0;
    if (result.is_rectangle) {
        result.rectangle = {light.position_m, light.half_u_m, light.half_v_m, light.intensity};
        result.has_extent = true;
    } else {
        result.light = kernel_light(light);
        result.has_extent = result.light.radius > 0.0F;
    }
    return result;
}

/// Takes a light along with a node.
void move(Light& light, const glm::mat4& now_from_start) {
    const glm::mat3 turn(now_from_start);
    light.position_m = glm::vec3(now_from_start * glm::vec4(light.position_m, 1.0F));
    light.direction = glm::normalize(turn * light.direction);
    light.half_u_m = turn * light.half_u_m;
    light.half_v_m = turn * light.half_v_m;
}

/// ShadingInstance::plane_extent_m of a mesh.
float plane_extent(const Mesh& mesh, const glm::mat3& world_from_mesh, bool any_turn) {
    float largest = 0.0F;
    for (const glm::uvec3& t : mesh.triangle) {
        const glm::vec3 a = world_from_mesh * mesh.position_m[t.x];
        const glm::vec3 b = world_from_mesh * mesh.position_m[t.y];
        const glm::vec3 c = world_from_mesh * mesh.position_m[t.z];
        const glm::vec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
        const glm::vec3 across = glm::abs(glm::cross(b - a, c - a));
        const float length = glm::length(across);
        const float sum = any_turn ? glm::length(extent) : glm::dot(across, extent) / std::max(length, 1e-30F);
        largest = std::max(largest, sum);
    }
    return largest;
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
    SurfaceNeeds needs(*scene_);
    for (const Instance& instance : scene_->instances)
        add_instance(instance, needs.of(scene_->meshes[static_cast<std::size_t>(instance.mesh)]));
    std::vector<glm::mat4> world_from_node;
    pose_nodes(scene_->animation, 0.0, world_from_node);
    for (const glm::mat4& node : world_from_node) node_from_world_.push_back(glm::inverse(node));
    lights_ = lights_at(world_from_node);
    needs_ = scene_needs(*scene_, needs).needs;
    if ((needs_ & kNeedEnvironment) != 0) {
        const Environment& environment = scene_->environment;
        environment_ = std::make_unique<EnvironmentMap>(scene_->images[static_cast<std::size_t>(environment.image)],
                                                        environment.intensity, environment.rotation_rad);
    }
}

std::vector<ShadingLight> ShadingScene::lights_at(const std::vector<glm::mat4>& world_from_node) const {
    std::vector<ShadingLight> lights;
    for (const Light& light : scene_->lights) {
        if (light.intensity == glm::vec3(0.0F)) continue;
        Light placed = light;
        if (light.node >= 0) {
            const auto node = static_cast<std::size_t>(light.node);
            move(placed, world_from_node[node] * node_from_world_[node]);
        }
        lights.push_back(shading_light(placed));
    }
    return lights;
}

void ShadingScene::add_instance(const Instance& instance, std::uint32_t needs) {
    const Mesh& mesh = scene_->meshes[static_cast<std::size_t>(instance.mesh)];
    const Material& material = scene_->materials[static_cast<std::size_t>(mesh.material)];
    ShadingInstance result;
    result.needs = needs;
    result.moves = instance.node >= 0;
    const glm::mat3 world_from_mesh(result.moves ? glm::mat4(1.0F) : instance.world_from_mesh);
    const bool mirrored = !result.moves && mirrors(instance);
    const glm::mat3 normal_matrix = glm::transpose(glm::inverse(world_from_mesh));
    result.material = &material;
    result.position = mesh.position_m.data();
    result.world_from_mesh = world_from_mesh;
    result.plane_extent_m = plane_extent(mesh, world_from_mesh, result.moves);
    result.absorption_per_m = kernels::absorption_per_m(material.attenuation_color, material.attenuation_distance_m);
    result.triangle = mesh.triangle.data();
    if (mirrored) {
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
    constexpr std::uint32_t kExtended = kNeedTransmission | kNeedRefraction | kNeedSpecular | kLayerNeeds;
    if (!material.unlit && (needs & kExtended) != 0) {
        ShadingExtension extension;
        const std::uint32_t plain = result.features;
        add_texture(material.transmission_texture, kTransmissionTexture, extension.transmission);
        add_texture(material.specular_texture, kSpecularTexture, extension.specular);
        add_texture(material.specular_color_texture, kSpecularColorTexture, extension.specular_color);
        add_texture(material.clearcoat_texture, kClearcoatTexture, extension.clearcoat);
        add_texture(material.clearcoat_roughness_texture, kClearcoatRoughnessTexture, extension.clearcoat_roughness);
        if (!mesh.tangent.empty())
            add_texture(material.clearcoat_normal_texture, kClearcoatNormalTexture, extension.clearcoat_normal,
                        TextureContent::normals);
        add_texture(material.sheen_color_texture, kSheenColorTexture, extension.sheen_color);
        add_texture(material.sheen_roughness_texture, kSheenRoughnessTexture, extension.sheen_roughness);
        if (result.features != plain)
            result.extension = extensions_.emplace_back(std::make_unique<ShadingExtension>(extension)).get();
    }
    if ((result.features & (kNormalTexture | kClearcoatNormalTexture)) != 0) {
        // The bitangent keeps its side of the mirrored normal and tangent: cross products flip.
        const float handedness = mirrored ? -1.0F : 1.0F;
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
           bytes_of(mirrored_triangles_) + extensions_.size() * sizeof(ShadingExtension) + textures_.memory_bytes() +
           (environment_ ? environment_->memory_bytes() : 0);
}

}  // namespace macula
