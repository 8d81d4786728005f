#include "scenes/gltf.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "scenes/emissive_quads.h"
#include "scenes/framing.h"
#include "scenes/gltf_animation.h"
#include "scenes/gltf_camera.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_light.h"
#include "scenes/gltf_material.h"
#include "scenes/gltf_mesh.h"
#include "scenes/gltf_node.h"

namespace macula {
namespace {

constexpr std::size_t kMostWarnings = 100;

void warn_of_what_is_ignored(GltfContext& context) {
    const tinygltf::Model& model = context.document.model;
    const std::set<std::string> used(model.extensionsUsed.begin(), model.extensionsUsed.end());
    for (const std::string& name : used)
        if (!is_supported_extension(name)) context.warn("extension " + name, "is optional, unknown and ignored");
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            if (!primitive.targets.empty()) return context.warn("morph targets", "are ignored");
}

/// Fills the scene from the nodes that are shown; meshes and materials that no node uses are not read.
class GltfSceneReader {
public:
    explicit GltfSceneReader(GltfContext& context)
        : context_(context), materials_(context, scene_), meshes_(context.document.model.meshes.size()) {}

    Expected<Scene> read() {
        Expected<std::vector<PlacedNode>> nodes = list_gltf_nodes(context_);
        if (!nodes) return tl::unexpected(nodes.error());
        Expected<Animation> animation = read_gltf_animation(context_, *nodes);
        if (!animation) return tl::unexpected(animation.error());
        if (const Expected<void> placed = place_gltf_nodes(context_, *nodes); !placed)
            return tl::unexpected(placed.error());
        pose_gltf_nodes(*animation, *nodes);
        for (const PlacedNode& node : *nodes)
            if (const Expected<void> added = add_node(node); !added) return tl::unexpected(added.error());
        if (scene_.instances.empty()) return context_.error("scene", "there are no triangles to show");
        scene_.animation = std::move(*animation);
        return std::move(scene_);
    }

private:
    Expected<void> add_node(const PlacedNode& placed) {
        const tinygltf::Node& node = context_.document.model.nodes[placed.node];
        const std::string element = element_name("node", placed.node, node.name);
        if (node.camera != -1) {
            Expected<SceneCamera> camera = read_gltf_camera(context_, node.camera, placed.world_from_node,
                                                            node.name.empty() ? element : node.name);
            if (!camera) return tl::unexpected(camera.error());
            add_camera(std::move(*camera));
        }
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (node.mesh == -1 && light == node.extensions.end()) return {};
        if (placed.singular) {
            context_.warn(element, "is flattened by a singular transform and left out");
            return {};
        }
        if (light != node.extensions.end()) {
            const tinygltf::Value& index = light->second.Get("light");
            if (!index.IsInt()) return context_.error(element, "KHR_lights_punctual does not name a light");
            Expected<Light> read = read_gltf_light(context_, index.GetNumberAsInt(), placed.world_from_node);
            if (!read) return tl::unexpected(read.error());
            read->node = placed.moved_by;
            scene_.lights.push_back(*read);
        }
        if (node.mesh == -1) return {};
        if (node.skin != -1)
            context_.warn(element,
                          "is skinned, which Macula does not read: its mesh keeps its shape and does not move "
                          "with its joints");
        return add_instances(node, element, placed);
    }

    /// Cameras are chosen by name: another one of a name gets a number.
    void add_camera(SceneCamera camera) {
        const std::string name = camera.name;
        while (!camera_names_.insert(camera.name).second)
            camera.name = name + " (" + std::to_string(++camera_numbers_.try_emplace(name, 1).first->second) + ")";
        scene_.cameras.push_back(std::move(camera));
    }

    Expected<void> add_instances(const tinygltf::Node& node, const std::string& element, const PlacedNode& placed) {
        if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= meshes_.size())
            return context_.error(element, "mesh " + std::to_string(node.mesh) + " does not exist");
        const auto index = static_cast<std::size_t>(node.mesh);
        if (!meshes_[index]) {
            Expected<std::vector<int>> read = read_mesh(index);
            if (!read) return tl::unexpected(read.error());
            meshes_[index] = std::move(*read);
        }
        for (const int mesh : *meshes_[index]) {
            if (scene_.instances.size() >= context_.limits.instances)
                return context_.error(
                    element, "there are more than " + std::to_string(context_.limits.instances) + " instances");
            scene_.instances.push_back(
                {node.name.empty() ? element : node.name, mesh, placed.world_from_node, placed.moved_by});
        }
        return {};
    }

    /// The scene meshes that a glTF mesh consists of.
    Expected<std::vector<int>> read_mesh(std::size_t index) {
        const tinygltf::Mesh& from = context_.document.model.meshes[index];
        std::vector<int> meshes;
        for (std::size_t i = 0; i < from.primitives.size(); ++i) {
            const tinygltf::Primitive& primitive = from.primitives[i];
            const Expected<int> material = materials_.material(primitive.material);
            if (!material) return tl::unexpected(material.error());
            const std::string element = element_name("mesh", index, from.name) + ", primitive " + std::to_string(i);
            Expected<std::optional<Mesh>> mesh = read_gltf_primitive(
                context_, primitive, element, scene_.materials[static_cast<std::size_t>(*material)], *material);
            if (!mesh) return tl::unexpected(mesh.error());
            if (!*mesh) continue;
            meshes.push_back(static_cast<int>(scene_.meshes.size()));
            scene_.meshes.push_back(std::move(**mesh));
        }
        return meshes;
    }

    GltfContext& context_;
    Scene scene_;
    GltfMaterialReader materials_;
    std::vector<std::optional<std::vector<int>>> meshes_;  ///< scene meshes by glTF mesh, once read
    std::set<std::string> camera_names_;
    std::map<std::string, int> camera_numbers_;  ///< the last that was given to a name
};

Expected<LoadedScene> load(std::span<const std::uint8_t> bytes, const std::string& name, const std::string& folder,
                           const GltfLimits& limits) {
    const Expected<GltfDocument> document = read_gltf_document(bytes, name, folder, limits);
    if (!document) return tl::unexpected(document.error());
    GltfContext context(*document, limits);
    warn_of_what_is_ignored(context);
    Expected<Scene> scene = GltfSceneReader(context).read();
    if (!scene) return tl::unexpected(scene.error());

    const Bounds bounds = world_bounds(*scene);
    if (!std::isfinite(glm::dot(bounds.size(), bounds.size())))
        return context.error("scene", "the transforms lead beyond what a float can hold");
    add_emissive_quads(*scene);
    expose_gltf_lights(*scene, bounds);
    frame_start(*scene, bounds);
    scene->name = name;
    if (context.warnings.size() > kMostWarnings) {
        const std::size_t more = context.warnings.size() - kMostWarnings;
        context.warnings.resize(kMostWarnings);
        context.warnings.push_back(name + ": and " + std::to_string(more) + " warnings more");
    }
    return LoadedScene{std::make_shared<const Scene>(std::move(*scene)), std::move(context.warnings)};
}

}  // namespace

Expected<LoadedScene> load_gltf(const std::string& path, const GltfLimits& limits) {
    const Expected<std::vector<std::uint8_t>> bytes = read_file(path, limits.file_bytes);
    if (!bytes) return tl::unexpected(bytes.error());
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return load(*bytes, path, folder.empty() ? "./" : folder.string(), limits);
}

Expected<LoadedScene> load_gltf_from_memory(std::span<const std::uint8_t> bytes, const std::string& name,
                                            const GltfLimits& limits) {
    return load(bytes, name, "", limits);
}

}  // namespace macula
