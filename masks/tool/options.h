#pragma once

#include <string>
#include <variant>
#include <vector>

namespace macula {

// What macula-mask is started with, as typed: defaults, then the configuration file, then the command line. What the
// texts mean is found out by the functions that take them.

/// Of a recipe (masks/make/recipe.h).
struct RecipeOptions {
    std::string display = "vive";
    std::string sampling = "paper-54";
    std::string placement = "void-and-cluster";
    std::string geometry = "flat";
    unsigned seed = 1;
};

/// macula-mask make
struct MakeOptions {
    RecipeOptions recipe;
    std::string from;   ///< PNG that is taken instead of drawing one; empty: none
    std::string gaze;   ///< "X,Y": pixel of that PNG at the gaze; empty: as the file says, or its middle
    std::string mask;   ///< PNG to write; empty: none
    std::string mesh;   ///< GLB to write; empty: none
    std::string cache;  ///< folder; empty: default_mesh_cache()
    bool no_cache = false;
    bool quiet = false;
};

/// macula-mask inspect
struct InspectOptions {
    std::string file;
    std::string display;            ///< empty: of the file's recipe
    std::string sampling;           ///< empty: of the file's recipe
    std::string geometry = "flat";  ///< of a file without recipe
    std::string rings;              ///< "0,5,10": edges in degrees; empty: finer near the gaze
    std::string json;               ///< file; "-": standard output, instead of the table; empty: none
};

/// macula-mask plot cutoff
struct CutoffPlotOptions {
    RecipeOptions recipe;  ///< `sampling` is a list
    double to_deg = 60.0;
    double to_cpd = 0.0;  ///< 0: that of the sharpest fovea
    bool logarithmic = false;
    std::string out;
};

/// How masks and meshes are shown.
struct PictureOptions {
    std::string crop = "window";  ///< "window", "mask" or "X,Y,W,H" in pixels of the mask
    int panel = 0;                ///< width of one picture in pixels; 0: by kind
    std::string out;
};

/// macula-mask plot mask
struct MaskPlotOptions {
    std::vector<std::string> files;
    RecipeOptions recipe;  ///< `sampling` is a list, drawn where there are no files
    PictureOptions picture;
    bool quiet = false;
};

/// macula-mask plot mesh
struct MeshPlotOptions {
    std::string file;
    std::string display = "vive";  ///< of a file without recipe
    PictureOptions picture;
    bool quiet = false;
};

using MaskToolOptions = std::variant<MakeOptions, InspectOptions, CutoffPlotOptions, MaskPlotOptions, MeshPlotOptions>;

/// Reads the command line and the configuration file that it names. Returns an exit code instead where that is all
/// there is to do: 0 after --help, --version and --print-config, ErrorCode::option after a mistake, which is told
/// on standard error.
std::variant<MaskToolOptions, int> parse_mask_tool_options(int argc, char** argv);

}  // namespace macula
