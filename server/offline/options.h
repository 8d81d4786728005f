#pragma once

#include <string>
#include <variant>

#include "server/scene_options.h"

namespace macula {

/// What macula-render is started with, as typed: defaults, then the configuration file, then the command line. What
/// the texts mean is found out by shots_of() and output_of().
struct RenderOptions {
    SceneOptions scene;
    std::string display = "vive";
    std::string eye = "both";
    double camera_fov_deg = 0.0;  ///< of a plain camera, top to bottom; 0: the display
    std::string size = "960x720";
    std::string position;    ///< "X,Y,Z" in metres; empty: the start pose's
    double yaw_deg = 0.0;    ///< to the left of the start pose
    double pitch_deg = 0.0;  ///< upwards from it
    double time_s = 0.0;
    std::string gaze = "0,0";  ///< "YAW,PITCH" in degrees, to the left and up from straight ahead
    std::string sampling = "full";
    std::string mesh;        ///< file of sampling `mesh:file`
    std::string mesh_cache;  ///< folder of made meshes; empty: default_mesh_cache()
    int spp = 1;
    std::string reconstruct = "cpu";
    std::string context = "auto";
    std::string out = "macula";
    std::string write = "color";
    std::string format = "png";
    std::string json;  ///< empty: none; "-": standard output
    int repeat = 1;
    int threads = 0;  ///< 0: one for each processor
    bool quiet = false;
};

/// Reads the command line and the configuration file that it names. Returns an exit code instead where that is all
/// there is to do: 0 after --help, --version and --print-config, ErrorCode::option after a mistake, which is told
/// on standard error.
std::variant<RenderOptions, int> parse_render_options(int argc, char** argv);

}  // namespace macula
