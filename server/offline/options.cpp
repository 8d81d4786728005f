#include "server/offline/options.h"

#include "protocol/base/command_line.h"

namespace macula {
namespace {

void add_view_options(CLI::App& app, RenderOptions& options) {
    app.add_option("--display", options.display, "vive, desktop, or a display file (masks/display.md)")
        ->capture_default_str();
    app.add_option("--eye", options.eye, "Eyes of the display to render: left, right or both")
        ->check(CLI::IsMember({"left", "right", "both"}))
        ->capture_default_str();
    app.add_option("--camera-fov", options.camera_fov_deg,
                   "Field of view in degrees, top to bottom, of a plain camera instead of the display; 0: the display")
        ->check(CLI::Range(0.0, 170.0))
        ->capture_default_str();
    app.add_option("--size", options.size, "WIDTHxHEIGHT of the plain camera's picture, 16 to 8192 each")
        ->capture_default_str();
    app.add_option("--position", options.position, "X,Y,Z of the head in metres, instead of the start pose's");
    app.add_option("--yaw", options.yaw_deg, "Degrees by which the head turns left from the start pose")
        ->capture_default_str();
    app.add_option("--pitch", options.pitch_deg, "Degrees by which it then looks up")->capture_default_str();
    app.add_option("--time", options.time_s, "Seconds into the scene's animation")->capture_default_str();
}

void add_sampling_options(CLI::App& app, RenderOptions& options) {
    app.add_option("--gaze", options.gaze, "YAW,PITCH of the gaze in degrees, to the left and up from straight ahead")
        ->capture_default_str();
    app.add_option("--sampling", options.sampling,
                   "How the frame is made, [SAMPLER:]PRESET[/RECONSTRUCTION]: full, 27, mesh:paper-27/raster, "
                   "layers:27, law:alpha=0.106,e2=2.3, ... (server/METHODS.md)")
        ->capture_default_str();
    app.add_option("--mesh", options.mesh, "Mesh file, made by macula-mask, that sampling mesh:file is made with");
    app.add_option("--mesh-cache", options.mesh_cache,
                   "Folder that meshes are kept in (default: $XDG_CACHE_HOME/macula/meshes or ~/.cache/macula/meshes)");
    app.add_option("--spp", options.spp, "Samples of each traced pixel")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    app.add_option("--reconstruct", options.reconstruct,
                   "Where pixels without a sample are interpolated: cpu, gl, auto; none leaves them black")
        ->check(CLI::IsMember({"cpu", "gl", "auto", "none"}))
        ->capture_default_str();
    app.add_option("--context", options.context, "GL context: auto, egl (a GPU), surfaceless or osmesa")
        ->check(CLI::IsMember({"auto", "egl", "surfaceless", "osmesa"}))
        ->capture_default_str();
}

void add_output_options(CLI::App& app, RenderOptions& options) {
    app.add_option("--out", options.out, "Path that the names of all files begin with (server/offline/README.md)")
        ->capture_default_str();
    app.add_option("--write", options.write, "What to write: color, depth, object, positions, levels, with commas")
        ->capture_default_str();
    app.add_option("--format", options.format, "png: a file for each; exr: all as channels of one file")
        ->check(CLI::IsMember({"png", "exr"}))
        ->capture_default_str();
    app.add_option("--json", options.json, "File for counts and times, - for standard output");
    app.add_option("--repeat", options.repeat, "Times that the frame is made, for --json")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--threads", options.threads, "Threads that trace and reconstruct; 0: one for each processor")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_flag("--quiet", options.quiet, "No progress on standard error")->capture_default_str();
}

}  // namespace

std::variant<RenderOptions, int> parse_render_options(int argc, char** argv) {
    RenderOptions options;
    CLI::App app{"macula-render: ray-traces one frame of a scene into picture files.", "macula-render"};
    add_scene_options(app, options.scene);
    add_view_options(app, options);
    add_sampling_options(app, options);
    add_output_options(app, options);
    if (const auto exit_code = read_command_line(app, MACULA_VERSION, argc, argv)) return *exit_code;
    return options;
}

}  // namespace macula
