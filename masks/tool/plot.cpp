// macula-mask plot

#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "masks/make/mesh_store.h"
#include "masks/tool/commands.h"
#include "masks/tool/cutoff_chart.h"
#include "masks/tool/mask_figure.h"
#include "masks/tool/mask_input.h"
#include "masks/tool/mesh_figure.h"
#include "masks/tool/output_file.h"

namespace macula {
namespace {

constexpr int kMaskPanel = 360;
constexpr int kMeshPanel = 900;
/// A megabyte or two; much more is slow to open, and no one sees single lines in it.
constexpr std::size_t kMostSvgEdges = 100000;

/// Whether a picture is to be SVG; else it is PNG.
Expected<bool> wants_svg(const std::string& path) {
    if (path == "-" || path.ends_with(".svg")) return true;
    if (path.ends_with(".png")) return false;
    return fail(ErrorCode::option, "--out " + path + ": a figure is FILE.svg or FILE.png");
}

Expected<void> write_png(const std::string& path, const GreyPicture& picture) {
    const auto png = encode_png(picture);
    if (!png) return tl::unexpected(png.error());
    return write_whole(path, *png);
}

std::string caption_of(const Mask& mask, const MaskCrop& crop, const std::string& name) {
    std::uint64_t samples = 0;
    for (int y = crop.begin_px.y; y < crop.begin_px.y + crop.size_px.y; ++y)
        for (int x = crop.begin_px.x; x < crop.begin_px.x + crop.size_px.x; ++x)
            samples += mask.sampled[static_cast<std::size_t>(y) * mask.width_px + x];
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), " (%.1f %%)",
                  100.0 * static_cast<double>(samples) / (1.0 * crop.size_px.x * crop.size_px.y));
    return name + text.data();
}

Expected<Panel> panel_of(const MaskPlotOptions& options, bool svg, const Mask& mask, const Display& display,
                         const std::string& name) {
    const auto crop = parse_crop(options.picture.crop, {mask.width_px, mask.height_px}, mask.gaze_px, display);
    if (!crop) return tl::unexpected(crop.error());
    // A picture in an SVG may be shown larger than its units say, or printed.
    const int panel = options.picture.panel > 0 ? options.picture.panel : kMaskPanel;
    return Panel{mask_picture(mask, *crop, svg ? 2 * panel : panel), caption_of(mask, *crop, name)};
}

Expected<std::vector<Panel>> panels_of(const MaskPlotOptions& options, bool svg) {
    std::vector<Panel> panels;
    for (const std::string& file : options.files) {
        const auto input = read_mask_input(file);
        if (!input) return tl::unexpected(input.error());
        const auto display =
            input->recipe ? Expected<Display>(input->recipe->display) : load_display(options.recipe.display);
        if (!display) return tl::unexpected(display.error());
        const std::string name =
            input->recipe ? input->recipe->preset.name : std::filesystem::path(file).filename().string();
        auto panel = panel_of(options, svg, input->mask, *display, name);
        if (!panel) return tl::unexpected(panel.error());
        panels.push_back(*std::move(panel));
    }
    if (!options.files.empty()) return panels;

    Progress progress("macula-mask", options.quiet);
    const auto recipes = recipes_of(options.recipe);
    if (!recipes) return tl::unexpected(recipes.error());
    for (const Recipe& recipe : *recipes) {
        progress.note(recipe.preset.name);
        const auto mask = make_mask(recipe, tell_stages(progress));
        if (!mask) return tl::unexpected(mask.error());
        auto panel = panel_of(options, svg, *mask, recipe.display, recipe.preset.name);
        if (!panel) return tl::unexpected(panel.error());
        panels.push_back(*std::move(panel));
    }
    return panels;
}

}  // namespace

Expected<void> run(const CutoffPlotOptions& options) {
    const auto svg = wants_svg(options.out);
    if (!svg) return tl::unexpected(svg.error());
    if (!*svg) return fail(ErrorCode::option, "--out " + options.out + ": charts are FILE.svg");
    if (auto writable = check_writable(options.out); !writable) return writable;
    const auto recipes = recipes_of(options.recipe);
    if (!recipes) return tl::unexpected(recipes.error());
    return write_whole(options.out,
                       draw_chart(cutoff_chart(*recipes, options.to_deg, options.to_cpd, options.logarithmic)));
}

Expected<void> run(const MaskPlotOptions& options) {
    const auto svg = wants_svg(options.picture.out);
    if (!svg) return tl::unexpected(svg.error());
    if (auto writable = check_writable(options.picture.out); !writable) return writable;
    const auto panels = panels_of(options, *svg);
    if (!panels) return tl::unexpected(panels.error());
    if (!*svg) return write_png(options.picture.out, panels_picture(*panels));
    const int width = options.picture.panel > 0 ? options.picture.panel : kMaskPanel;
    const auto text = panels_svg(*panels, width, "Sampling masks");
    if (!text) return tl::unexpected(text.error());
    return write_whole(options.picture.out, *text);
}

Expected<void> run(const MeshPlotOptions& options) {
    const auto svg = wants_svg(options.picture.out);
    if (!svg) return tl::unexpected(svg.error());
    if (auto writable = check_writable(options.picture.out); !writable) return writable;
    const auto input = read_mask_input(options.file);
    if (!input) return tl::unexpected(input.error());
    const auto display = input->recipe ? Expected<Display>(input->recipe->display) : load_display(options.display);
    if (!display) return tl::unexpected(display.error());
    const Mask& mask = input->mask;
    const auto crop = parse_crop(options.picture.crop, {mask.width_px, mask.height_px}, mask.gaze_px, *display);
    if (!crop) return tl::unexpected(crop.error());

    Progress progress("macula-mask", options.quiet);
    const SampleMesh mesh = input->mesh ? *input->mesh : triangulate_mask(mask, tell_stages(progress));
    const std::vector<MeshEdge> edges = visible_edges(mesh, *crop);
    const int panel = options.picture.panel > 0 ? options.picture.panel : kMeshPanel;
    if (!*svg) return write_png(options.picture.out, mesh_picture(mesh, edges, *crop, panel));
    if (edges.size() > kMostSvgEdges)
        return fail(ErrorCode::option, "--out " + options.picture.out + ": " + std::to_string(edges.size()) +
                                           " edges are too many for a file of lines (at most " +
                                           std::to_string(kMostSvgEdges) +
                                           "); show a part with --crop X,Y,W,H, or write FILE.png");
    return write_whole(options.picture.out, mesh_svg(mesh, edges, *crop, panel));
}

}  // namespace macula
