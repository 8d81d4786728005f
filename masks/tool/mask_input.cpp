#include "masks/tool/mask_input.h"

#include <charconv>
#include <utility>

#include "masks/mesh/mesh_file.h"

namespace macula {
namespace {

Expected<MaskInput> read(const std::string& path) {
    MaskInput input;
    if (path.ends_with(".glb")) {
        auto mesh = read_mesh(path);
        if (!mesh) return tl::unexpected(mesh.error());
        input.mask = mask_of(*mesh);
        input.mesh = *std::move(mesh);
        return input;
    }
    if (!path.ends_with(".png"))
        return fail(ErrorCode::input_file, path + ": masks are FILE.png and meshes are FILE.glb");
    auto mask = read_mask_png(path);
    if (!mask) return tl::unexpected(mask.error());
    input.mask = *std::move(mask);
    return input;
}

}  // namespace

Expected<MaskInput> read_mask_input(const std::string& path) {
    auto input = read(path);
    if (!input || input->mask.recipe.empty()) return input;
    auto recipe = parse_recipe(input->mask.recipe);
    if (!recipe) return fail(recipe.error().code, path + ": " + recipe.error().message);
    input->recipe = *std::move(recipe);
    return input;
}

Mask mask_of(const SampleMesh& mesh) {
    Mask mask{mesh.width_px, mesh.height_px, mesh.gaze_px, {}, mesh.recipe};
    mask.sampled.resize(static_cast<std::size_t>(mesh.width_px) * mesh.height_px);
    for (const SamplePosition& site : mesh.site)
        mask.sampled[static_cast<std::size_t>(site.y_px) * mesh.width_px + site.x_px] = 1;
    return mask;
}

Expected<Recipe> recipe_of(const RecipeOptions& options) {
    Recipe recipe;
    auto display = load_display(options.display);
    if (!display) return tl::unexpected(display.error());
    recipe.display = *std::move(display);
    auto preset = parse_sampling(options.sampling);
    if (!preset) return tl::unexpected(preset.error());
    recipe.preset = *std::move(preset);
    const auto placement = parse_placement(options.placement);
    if (!placement) return tl::unexpected(placement.error());
    recipe.placement = *placement;
    const auto geometry = parse_mask_geometry(options.geometry);
    if (!geometry) return tl::unexpected(geometry.error());
    recipe.geometry = *geometry;
    recipe.seed = options.seed;
    return recipe;
}

Expected<std::vector<Recipe>> recipes_of(const RecipeOptions& options) {
    std::vector<Recipe> recipes;
    RecipeOptions one = options;
    for (const std::string& preset : split_presets(options.sampling)) {
        one.sampling = preset;
        auto recipe = recipe_of(one);
        if (!recipe) return tl::unexpected(recipe.error());
        recipes.push_back(*std::move(recipe));
    }
    if (recipes.empty()) return fail(ErrorCode::option, "--sampling names nothing");
    return recipes;
}

std::vector<std::string> split_presets(const std::string& list) {
    std::vector<std::string> presets;
    for (std::size_t begin = 0; begin < list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string part = list.substr(begin, end - begin);
        const bool goes_on = !presets.empty() && presets.back().starts_with("law:") && !part.starts_with("law:") &&
                             part.find('=') != std::string::npos;
        if (goes_on)
            presets.back() += "," + part;
        else
            presets.push_back(part);
        begin = end + 1;
    }
    return presets;
}

std::optional<glm::ivec2> parse_pixel(const std::string& text) {
    glm::ivec2 pixel(0);
    const char* const end = text.data() + text.size();
    const auto [comma, error_x] = std::from_chars(text.data(), end, pixel.x);
    if (error_x != std::errc() || comma == end || *comma != ',') return std::nullopt;
    const auto [last, error_y] = std::from_chars(comma + 1, end, pixel.y);
    if (error_y != std::errc() || last != end) return std::nullopt;
    return pixel;
}

MaskProgress tell_stages(Progress& progress) {
    return [&progress, last = std::string()](const std::string& stage, double share) mutable {
        if (stage != last) {
            // Some stages are one long step, of which nothing more can be told.
            progress.note(stage);
            progress.begin(stage);
            last = stage;
        }
        if (share < 1.0) progress.tell(share);
    };
}

}  // namespace macula
