// macula-mask make

#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "masks/make/mesh_store.h"
#include "masks/mesh/mesh_file.h"
#include "masks/mesh/mesh_table.h"
#include "masks/tool/commands.h"
#include "masks/tool/mask_input.h"
#include "masks/tool/output_file.h"

namespace macula {
namespace {

/// What is made: of the mesh only what is asked for.
struct Made {
    Mask mask;
    std::optional<SampleMesh> mesh;
};

Expected<void> check_outputs(const MakeOptions& options) {
    if (options.mask.empty() && options.mesh.empty())
        return fail(ErrorCode::option, "make: there is nothing to write; name --mask FILE.png or --mesh FILE.glb");
    if (!options.mask.empty() && !options.mask.ends_with(".png"))
        return fail(ErrorCode::option, "--mask " + options.mask + ": a mask is a FILE.png");
    if (!options.mesh.empty() && !options.mesh.ends_with(".glb"))
        return fail(ErrorCode::option, "--mesh " + options.mesh + ": a mesh is a FILE.glb");
    for (const std::string& path : {options.mask, options.mesh}) {
        if (path.empty()) continue;
        if (auto writable = check_writable(path); !writable) return writable;
    }
    return {};
}

std::string size_text(glm::ivec2 size_px) {
    return std::to_string(size_px.x) + " x " + std::to_string(size_px.y);
}

/// A mask must cover the window at least while the gaze is on the axis; whether it does so for other gazes is told.
Expected<void> check_cover(const MakeOptions& options, const Mask& mask, const Display& display,
                           const Progress& progress) {
    const glm::ivec2 size_px(mask.width_px, mask.height_px);
    const glm::ivec2 window_px(display.eye_width_px, display.eye_height_px);
    const glm::ivec2 before_px = mask.gaze_px - axis_px(display, kLeftEye);
    const glm::ivec2 after_px = size_px - before_px - window_px;
    const std::string needs = "; display " + display.name + " shows " + size_text(window_px) + " pixels of it, and " +
                              size_text(2 * window_px) + " with the gaze in the middle serve any gaze";
    if (glm::min(glm::min(before_px.x, before_px.y), glm::min(after_px.x, after_px.y)) < 0)
        return fail(ErrorCode::input_file,
                    "mask " + options.from + " of " + size_text(size_px) + " pixels is too small around its gaze at " +
                        std::to_string(mask.gaze_px.x) + "," + std::to_string(mask.gaze_px.y) + needs);
    const glm::ivec2 below_px = size_px - mask.gaze_px;
    if (mask.gaze_px.x < window_px.x || mask.gaze_px.y < window_px.y || below_px.x < window_px.x ||
        below_px.y < window_px.y)
        progress.note("mask " + options.from + " of " + size_text(size_px) +
                      " pixels does not cover the window for every gaze" + needs);
    return {};
}

Expected<Made> from_png(const MakeOptions& options, Progress& progress) {
    const auto display = load_display(options.recipe.display);
    if (!display) return tl::unexpected(display.error());
    auto mask = read_mask_png(options.from);
    if (!mask) return tl::unexpected(mask.error());
    if (!options.gaze.empty()) {
        const auto gaze_px = parse_pixel(options.gaze);
        if (!gaze_px || gaze_px->x < 0 || gaze_px->y < 0 || gaze_px->x >= mask->width_px ||
            gaze_px->y >= mask->height_px)
            return fail(ErrorCode::option, "--gaze " + options.gaze + ": it must be X,Y of a pixel of " + options.from);
        mask->gaze_px = *gaze_px;
        mask->recipe.clear();  // which would put the gaze elsewhere
    }
    if (const auto covers = check_cover(options, *mask, *display, progress); !covers)
        return tl::unexpected(covers.error());
    Made made{*std::move(mask), std::nullopt};
    if (options.mesh.empty()) return made;
    made.mesh = triangulate_mask(made.mask, tell_stages(progress));
    // Gaps wider than pixels can reach are the one thing that makes a user's mask useless: better told here than when
    // a server starts.
    if (const auto table = MeshTable::make(*made.mesh); !table)
        return fail(table.error().code, "mask " + options.from + ": " + table.error().message);
    return made;
}

Expected<Made> from_recipe(const MakeOptions& options, Progress& progress) {
    const auto recipe = recipe_of(options.recipe);
    if (!recipe) return tl::unexpected(recipe.error());
    if (options.mesh.empty() || options.no_cache) {
        auto mask = make_mask(*recipe, tell_stages(progress));
        if (!mask) return tl::unexpected(mask.error());
        Made made{*std::move(mask), std::nullopt};
        if (!options.mesh.empty()) made.mesh = triangulate_mask(made.mask, tell_stages(progress));
        return made;
    }
    std::filesystem::path cache = options.cache;
    if (cache.empty()) {
        const auto usual = default_mesh_cache();
        if (!usual) return tl::unexpected(usual.error());
        cache = *usual;
    }
    auto mesh = obtain_mesh(*recipe, cache, tell_stages(progress));
    if (!mesh) return tl::unexpected(mesh.error());
    Made made;
    if (!options.mask.empty()) made.mask = mask_of(*mesh);
    made.mesh = *std::move(mesh);
    return made;
}

}  // namespace

Expected<void> run(const MakeOptions& options) {
    Progress progress("macula-mask", options.quiet);
    if (auto good = check_outputs(options); !good) return good;
    const auto made = options.from.empty() ? from_recipe(options, progress) : from_png(options, progress);
    if (!made) return tl::unexpected(made.error());
    if (!options.mask.empty()) {
        if (auto written = write_mask_png(made->mask, options.mask); !written) return written;
        progress.note("wrote " + options.mask);
    }
    if (!options.mesh.empty()) {
        if (auto written = write_mesh(*made->mesh, options.mesh); !written) return written;
        progress.note("wrote " + options.mesh + ": " + std::to_string(made->mesh->site.size()) + " samples, " +
                      std::to_string(made->mesh->triangle.size()) + " triangles");
    }
    return {};
}

}  // namespace macula
