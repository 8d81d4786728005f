#pragma once

#include <memory>
#include <string>

#include "protocol/base/error.h"
#include "scenes/load.h"
#include "server/render/tracer.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class App;
}

namespace macula {

/// What to show and how to light it: the options that all programs with a tracer have.
struct SceneOptions {
    std::string scene = "bunny-box";
    std::string environment;    ///< picture to light the scene with; empty: the scene's own light
    std::string camera;         ///< camera of the scene to start from; empty: its start pose
    bool level_camera = false;  ///< without its pitch and roll, as a head begins
    bool explain = false;       ///< say what the scene needs, and end
    TracerOptions tracer;
};

/// Adds the options to a program's table.
void add_scene_options(CLI::App& app, SceneOptions& options);

/// Loads what the options name; `progress` may be empty. Errors: those of load_scene().
Expected<LoadedScene> load_scene(const SceneOptions& options, const LoadProgress& progress);

}  // namespace macula
