#include "scenes/load.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "scenes/air_shed.h"
#include "scenes/bunny_box.h"
#include "scenes/framing.h"
#include "scenes/gltf.h"
#include "scenes/image_file.h"

namespace macula {
namespace {

Expected<LoadedScene> load_as_it_is(const std::string& name_or_path, const LoadProgress& progress) {
    if (name_or_path == "bunny-box") return make_bunny_box();
    if (name_or_path == "air-shed") return make_air_shed(progress);
    std::string extension = std::filesystem::path(name_or_path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".gltf" || extension == ".glb") return load_gltf(name_or_path);
    return fail(ErrorCode::option, "unknown scene \"" + name_or_path +
                                       "\"; known are bunny-box, air-shed and paths that end in .gltf or .glb");
}

Expected<void> start_from(Scene& scene, const std::string& camera, bool level) {
    std::string known;
    for (const SceneCamera& candidate : scene.cameras) {
        if (candidate.name == camera) {
            scene.world_from_start = level ? level_head(candidate.world_from_head) : candidate.world_from_head;
            return {};
        }
        known += (known.empty() ? "\"" : ", \"") + candidate.name + "\"";
    }
    return fail(ErrorCode::option, "scene \"" + scene.name + "\" has no camera \"" + camera + "\"; it has " +
                                       (known.empty() ? "none" : known));
}

/// The picture takes the place of what the scene had for light from all around.
Expected<void> light_with(Scene& scene, const std::string& environment) {
    Expected<TextureImage> image = load_environment(environment);
    if (!image) return tl::unexpected(image.error());
    scene.environment = {};
    scene.environment.image = static_cast<int>(scene.images.size());
    scene.images.push_back(*std::move(image));
    scene.ambient_radiance = glm::vec3(0.0F);
    return {};
}

}  // namespace

Expected<LoadedScene> load_scene(const std::string& name_or_path, const LoadOptions& options) {
    Expected<LoadedScene> loaded = load_as_it_is(name_or_path, options.progress);
    if (!loaded || (options.camera.empty() && options.environment.empty())) return loaded;
    Scene scene = *loaded->scene;
    if (!options.camera.empty()) {
        if (auto started = start_from(scene, options.camera, options.level_camera); !started)
            return tl::unexpected(started.error());
    }
    if (!options.environment.empty()) {
        if (auto lit = light_with(scene, options.environment); !lit) return tl::unexpected(lit.error());
    }
    loaded->scene = std::make_shared<const Scene>(std::move(scene));
    return loaded;
}

}  // namespace macula
