#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "protocol/base/error.h"
#include "scenes/scene.h"

namespace macula {

/// A scene and what a person should know about how it was read.
struct LoadedScene {
    std::shared_ptr<const Scene> scene;
    std::vector<std::string> warnings;  ///< one sentence each, naming the element
};

/// Loads a scene by name ("bunny-box") or by path (.gltf, .glb).
/// Errors: `input_file`, naming the file and the element that is wrong; `option` for an unknown name.
Expected<LoadedScene> load_scene(const std::string& name_or_path);

}  // namespace macula
