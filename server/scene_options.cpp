#include "server/scene_options.h"

#include <CLI/CLI.hpp>

namespace macula {

void add_scene_options(CLI::App& app, SceneOptions& options) {
    app.add_option("--scene", options.scene, "bunny-box, air-shed, or a .gltf or .glb file")->capture_default_str();
    app.add_option("--environment", options.environment,
                   "Lat-long picture (.hdr, .exr) that lights the scene from all around");
    app.add_option("--camera", options.camera, "Name of the scene's camera to start from");
    app.add_flag("--explain-scene", options.explain, "Print what the scene needs and why, and end")
        ->configurable(false);
    app.add_option("--bounces", options.tracer.bounces, "Reflections in a row")
        ->check(CLI::Range(0, 8))
        ->capture_default_str();
    app.add_option("--bounce-bound", options.tracer.bounce_bound,
                   "Share of a reflection's light below which it is taken from the environment; 0: all are traced")
        ->check(CLI::Range(0.0F, 1.0F))
        ->capture_default_str();
    app.add_option("--light-samples", options.tracer.light_samples, "Shadow rays to each light with an extent")
        ->check(CLI::IsMember({1, 4, 16, 64}))
        ->capture_default_str();
}

Expected<LoadedScene> load_scene(const SceneOptions& options, const LoadProgress& progress) {
    LoadOptions load;
    load.environment = options.environment;
    load.camera = options.camera;
    load.level_camera = options.level_camera;
    load.progress = progress;
    return load_scene(options.scene, load);
}

}  // namespace macula
