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

/// Called now and then while a scene is made or read: what is being done, and the share of the whole that is done.
using LoadProgress = std::function<void(const std::string& stage, double share)>;

/// What a program may change about a scene.
struct LoadOptions {
    std::string environment;    ///< lat-long picture (HDR, EXR) to light the scene with; empty: the scene's own
    std::string camera;         ///< name of the scene's camera to start from; empty: the scene's start pose
    bool level_camera = false;  ///< without the camera's pitch and roll, as a head begins
    LoadProgress progress;      ///< may be empty
};

/// Loads a scene by name ("bunny-box", "air-shed") or by path (.gltf, .glb).
/// Errors: `input_file`, naming the file and the element that is wrong; `option` for an unknown name or camera.
Expected<LoadedScene> load_scene(const std::string& name_or_path, const LoadOptions& options = {});

}  // namespace macula
