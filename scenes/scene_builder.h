#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scenes/scene.h"

namespace macula {

/// sRGB-coded colour from 0xRRGGBB.
glm::vec3 srgb(std::uint32_t hex);

/// Linear colour from 0xRRGGBB, alpha 1.
glm::vec4 linear(std::uint32_t hex);

/// An object before it is placed: one mesh per material, all in the object's space.
class Model {
public:
    /// Adds a part to the mesh of its material.
    void add(int material, const Mesh& part, const glm::mat4& model_from_part = glm::mat4(1.0F));

    /// Adds all parts of another model.
    void add(const Model& other, const glm::mat4& model_from_other = glm::mat4(1.0F));

    /// By material, in the order in which the materials first came.
    [[nodiscard]] const std::vector<Mesh>& meshes() const { return meshes_; }

private:
    std::vector<Mesh> meshes_;
};

/// Meshes of a model in a scene.
using ModelMeshes = std::vector<int>;

/// Collects what a scene made by code consists of.
class SceneBuilder {
public:
    int add_image(TextureImage image);
    int add_material(Material material);

    /// A material without textures, of an sRGB colour 0xRRGGBB.
    int plain(const std::string& name, std::uint32_t hex, float roughness = 0.8F, float metallic = 0.0F);

    /// Triangles without area are left out. A mesh without a name gets that of its first place.
    int add_mesh(Mesh mesh, int material);
    void place_mesh(const std::string& name, int mesh, const glm::mat4& world_from_mesh = glm::mat4(1.0F));

    /// Adds a model's meshes, to be placed any number of times. Tangents are made where a material has a normal map.
    ModelMeshes add_model(const std::string& name, const Model& model);
    /// Places all meshes of a model; each instance is named after the place and the mesh's material.
    void place_model(const std::string& name, const ModelMeshes& model, const glm::mat4& world_from_model);
    /// For a model that stands in one place only.
    void add_placed(const std::string& name, const Model& model, const glm::mat4& world_from_model = glm::mat4(1.0F));

    Scene& scene() { return scene_; }

private:
    Scene scene_;
};

}  // namespace macula
