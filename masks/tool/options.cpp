#include "masks/tool/options.h"

#include <vector>

#include "protocol/base/command_line.h"

namespace macula {
namespace {

constexpr const char* kPresets =
    "full, a percentage, paper-54, -41, -27 or -18, a law such as watson or hvvr-27, law:NAME=VALUE,... "
    "(masks/law.h)";

void add_geometry_options(CLI::App& command, RecipeOptions& options) {
    command.add_option("--display", options.display, "vive, desktop, or a display file (masks/display.md)")
        ->capture_default_str();
    command
        .add_option("--geometry", options.geometry,
                    "Pixels per degree: flat, those of the axis everywhere, or planar, those of the display's plane")
        ->capture_default_str();
    command
        .add_option("--placement", options.placement,
                    "void-and-cluster, floyd-steinberg, poisson-disk, white-noise or quincunx")
        ->capture_default_str();
}

void add_recipe_options(CLI::App& command, RecipeOptions& options) {
    add_geometry_options(command, options);
    command.add_option("--seed", options.seed, "Which of the masks of a kind")->capture_default_str();
}

void add_sampling_list(CLI::App& command, RecipeOptions& options, const std::string& what) {
    command.add_option("--sampling", options.sampling, what + ", with commas: each " + kPresets)->capture_default_str();
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
    command
        .add_option("--crop", options.crop,
                    "Part that is shown: window, what the eye's buffer shows while the gaze is on the axis; mask; or "
                    "X,Y,W,H in pixels of the mask")
        ->capture_default_str();
    command.add_option("--panel", options.panel, "Width of a picture in pixels; 0: a width that suits")
        ->check(CLI::Range(0, 16384))
        ->capture_default_str();
    command.add_option("--out", options.out, "FILE.svg or FILE.png")->required();
}

void add_quiet(CLI::App& command, bool& quiet) {
    command.add_flag("--quiet", quiet, "No progress on standard error")->capture_default_str();
}

CLI::App* add_make(CLI::App& app, MakeOptions& options) {
    CLI::App* make = app.add_subcommand("make", "Make a mask and the mesh of its samples");
    make->add_option("--sampling", options.recipe.sampling, std::string("How many samples and where: ") + kPresets)
        ->capture_default_str();
    add_recipe_options(*make, options.recipe);
    make->add_option("--from", options.from,
                     "Take this PNG, white where a pixel is sampled, instead of drawing a mask; of the options above, "
                     "only --display counts");
    make->add_option("--gaze", options.gaze, "X,Y: pixel of that PNG at the gaze, instead of its middle");
    make->add_option("--mask", options.mask, "FILE.png to write the mask to");
    make->add_option("--mesh", options.mesh, "FILE.glb to write the mesh to");
    make->add_option("--cache", options.cache,
                     "Folder of made meshes; else $XDG_CACHE_HOME/macula/meshes or ~/.cache/macula/meshes");
    make->add_flag("--no-cache", options.no_cache, "Neither look for the mesh in a cache nor keep it there")
        ->capture_default_str();
    add_quiet(*make, options.quiet);
    return make;
}

CLI::App* add_inspect(CLI::App& app, InspectOptions& options) {
    CLI::App* inspect = app.add_subcommand("inspect", "Measure a mask or a mesh");
    inspect->add_option("file", options.file, "FILE.png or FILE.glb")->required();
    inspect->add_option("--display", options.display, "Display that it is for; else that of its recipe");
    inspect->add_option("--sampling", options.sampling,
                        "Law that it is compared with; else that of its recipe. " + std::string(kPresets));
    inspect->add_option("--geometry", options.geometry, "flat or planar, of a file without recipe")
        ->capture_default_str();
    inspect->add_option("--rings", options.rings, "Edges of the rings around the gaze in degrees: 0,5,10,20");
    inspect->add_option("--json", options.json, "File for all figures; -: standard output, instead of the table");
    return inspect;
}

CLI::App* add_plot_cutoff(CLI::App& plot, CutoffPlotOptions& options) {
    CLI::App* cutoff = plot.add_subcommand("cutoff", "Draw cut-off frequency against eccentricity");
    options.recipe.sampling = "paper-54,paper-27,paper-18,paper-41";
    add_sampling_list(*cutoff, options.recipe, "Curves");
    add_geometry_options(*cutoff, options.recipe);
    cutoff->add_option("--to-deg", options.to_deg, "Greatest eccentricity")
        ->check(CLI::Range(1.0, 180.0))
        ->capture_default_str();
    cutoff->add_option("--to-cpd", options.to_cpd, "Greatest frequency; 0: that of the sharpest fovea")
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    cutoff->add_flag("--log", options.logarithmic, "Logarithmic frequencies")->capture_default_str();
    cutoff->add_option("--out", options.out, "FILE.svg, or - for standard output")->required();
    return cutoff;
}

CLI::App* add_plot_mask(CLI::App& plot, MaskPlotOptions& options) {
    CLI::App* mask = plot.add_subcommand("mask", "Show masks side by side");
    mask->add_option("files", options.files, "FILE.png or FILE.glb; none: masks are drawn by the options below");
    options.recipe.sampling = "paper-54,paper-27,paper-18,paper-41";
    add_sampling_list(*mask, options.recipe, "Masks to draw");
    add_recipe_options(*mask, options.recipe);
    add_picture_options(*mask, options.picture);
    add_quiet(*mask, options.quiet);
    return mask;
}

CLI::App* add_plot_mesh(CLI::App& plot, MeshPlotOptions& options) {
    CLI::App* mesh = plot.add_subcommand("mesh", "Show a mesh's triangles");
    mesh->add_option("file", options.file, "FILE.glb, or FILE.png to be triangulated")->required();
    mesh->add_option("--display", options.display, "Display of a file without recipe")->capture_default_str();
    add_picture_options(*mesh, options.picture);
    add_quiet(*mesh, options.quiet);
    return mesh;
}

}  // namespace

std::variant<MaskToolOptions, int> parse_mask_tool_options(int argc, char** argv) {
    CLI::App app{"macula-mask: makes, measures and shows sampling masks and their meshes.", "macula-mask"};
    app.require_subcommand(1);
    app.fallthrough();  // --config and --print-config may follow the subcommand
    MakeOptions make;
    InspectOptions inspect;
    CutoffPlotOptions cutoff;
    MaskPlotOptions mask;
    MeshPlotOptions mesh;
    const CLI::App* const make_command = add_make(app, make);
    const CLI::App* const inspect_command = add_inspect(app, inspect);
    CLI::App* const plot = app.add_subcommand("plot", "Draw figures");
    plot->require_subcommand(1);
    const CLI::App* const cutoff_command = add_plot_cutoff(*plot, cutoff);
    const CLI::App* const mask_command = add_plot_mask(*plot, mask);
    add_plot_mesh(*plot, mesh);
    if (const auto exit_code = read_command_line(app, MACULA_VERSION, argc, argv)) return *exit_code;
    if (make_command->parsed()) return make;
    if (inspect_command->parsed()) return inspect;
    if (cutoff_command->parsed()) return cutoff;
    if (mask_command->parsed()) {
        std::erase(mask.files, "");  // how a configuration file writes that there are none
        return mask;
    }
    return mesh;
}

}  // namespace macula
