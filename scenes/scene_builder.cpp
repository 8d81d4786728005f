#include "scenes/scene_builder.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "scenes/mesh_attributes.h"
#include "scenes/mesh_edit.h"

namespace macula {
namespace {

/// "crane, yellow paint"; the name alone where it has one part only.
std::string part_name(const std::string& name, std::size_t parts, const std::string& material) {
    if (parts == 1) return name;
    std::string result = name;
    result += ", ";
    return result += material;
}

}  // namespace

glm::vec3 srgb(std::uint32_t hex) {
    return glm::vec3((hex >> 16U) & 255U, (hex >> 8U) & 255U, hex & 255U) / 255.0F;
}

glm::vec4 linear(std::uint32_t hex) {
    const glm::vec3 c = srgb(hex);
    const auto decode = [](float v) { return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F); };
    return {decode(c.r), decode(c.g), decode(c.b), 1.0F};
}

void Model::add(int material, const Mesh& part, const glm::mat4& model_from_part) {
    for (Mesh& mesh : meshes_)
        if (mesh.material == material) return append(mesh, part, model_from_part);
    meshes_.emplace_back();
    meshes_.back().material = material;
    append(meshes_.back(), part, model_from_part);
}

void Model::add(const Model& other, const glm::mat4& model_from_other) {
    for (const Mesh& mesh : other.meshes_) add(mesh.material, mesh, model_from_other);
}

int SceneBuilder::add_image(TextureImage image) {
    scene_.images.push_back(std::move(image));
    return static_cast<int>(scene_.images.size()) - 1;
}

int SceneBuilder::add_material(Material material) {
    scene_.materials.push_back(std::move(material));
    return static_cast<int>(scene_.materials.size()) - 1;
}

int SceneBuilder::plain(const std::string& name, std::uint32_t hex, float roughness, float metallic) {
    Material material;
    material.name = name;
    material.base_color = linear(hex);
    material.roughness = roughness;
    material.metallic = metallic;
    return add_material(std::move(material));
}

int SceneBuilder::add_mesh(Mesh mesh, int material) {
    mesh.material = material;
    drop_degenerate_triangles(mesh);  // what rounding has flattened where parts were moved into place
    const Material& m = scene_.materials[static_cast<std::size_t>(material)];
    if (m.normal_texture.present() && mesh.tangent.empty()) add_tangents(mesh, mesh.uv0);
    scene_.meshes.push_back(std::move(mesh));
    return static_cast<int>(scene_.meshes.size()) - 1;
}

void SceneBuilder::place_mesh(const std::string& name, int mesh, const glm::mat4& world_from_mesh) {
    Mesh& placed = scene_.meshes[static_cast<std::size_t>(mesh)];
    if (placed.name.empty()) placed.name = name;
    Instance instance;
    instance.name = name;
    instance.mesh = mesh;
    instance.world_from_mesh = world_from_mesh;
    scene_.instances.push_back(std::move(instance));
}

ModelMeshes SceneBuilder::add_model(const std::string& name, const Model& model) {
    ModelMeshes result;
    for (const Mesh& part : model.meshes()) {
        Mesh mesh = part;
        const std::string& material = scene_.materials[static_cast<std::size_t>(part.material)].name;
        mesh.name = part_name(name, model.meshes().size(), material);
        result.push_back(add_mesh(std::move(mesh), part.material));
    }
    return result;
}

void SceneBuilder::place_model(const std::string& name, const ModelMeshes& model, const glm::mat4& world_from_model) {
    for (const int mesh : model) {
        const int material = scene_.meshes[static_cast<std::size_t>(mesh)].material;
        const std::string& part = scene_.materials[static_cast<std::size_t>(material)].name;
        place_mesh(part_name(name, model.size(), part), mesh, world_from_model);
    }
}

void SceneBuilder::add_placed(const std::string& name, const Model& model, const glm::mat4& world_from_model) {
    place_model(name, add_model(name, model), world_from_model);
}

}  // namespace macula
