#include "masks/make/recipe.h"

#include <array>
#include <cstdio>
#include <limits>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

namespace macula {
namespace {

using nlohmann::json;

/// To be raised with every change of the placements or the solver that changes masks.
constexpr int kMakingVersion = 1;

template <class Value>
using Names = std::array<std::pair<const char*, Value>, 5>;

constexpr Names<Placement> kPlacements = {{{"void-and-cluster", Placement::void_and_cluster},
                                           {"floyd-steinberg", Placement::floyd_steinberg},
                                           {"poisson-disk", Placement::poisson_disk},
                                           {"white-noise", Placement::white_noise},
                                           {"quincunx", Placement::quincunx}}};

json constants(const GeislerPerry& law) {
    return {{"alpha_deg", law.alpha_deg}, {"e2_deg", law.e2_deg}, {"contrast", law.contrast}};
}

json constants(const Peli& law) {
    return {{"k", law.k}, {"alpha_deg", law.alpha_deg}, {"contrast", law.contrast}};
}

json constants(const LinearMar& law) {
    return {{"slope", law.slope}, {"foveal_deg", law.foveal_deg}};
}

json constants(const RingMap& law) {
    return {{"slope", law.slope}, {"foveal_deg", law.foveal_deg}, {"flat_deg", law.flat_deg}};
}

json constants(const Watson& law) {
    return {{"meridian", static_cast<int>(law.meridian)}};
}

json constants(const CastleCsf& law) {
    return {{"k1", law.k1}, {"k2", law.k2}};
}

json to_json(const SamplingPreset& preset) {
    if (preset.full) return json::object();
    return {{"model", preset.law.model.index()},
            {"constants", std::visit([](const auto& model) { return constants(model); }, preset.law.model)},
            {"stretch", preset.law.stretch},
            {"exponent", preset.law.exponent},
            {"full_acuity_deg", preset.law.full_acuity_deg},
            {"free", static_cast<int>(preset.free)},
            {"share", preset.share},
            {"fovea_share", preset.fovea_share},
            {"fovea_scale", preset.fovea_scale}};
}

/// Member of an object; null where there is none.
const json& member(const json& object, const char* key) {
    static const json kNothing;
    const auto found = object.find(key);
    return found == object.end() ? kNothing : *found;
}

std::string text_of(const json& value) {
    return value.is_string() ? value.get<std::string>() : std::string();
}

int number_of(const json& value) {
    const bool fits = value.is_number_integer() && value >= 0 && value <= std::numeric_limits<int>::max();
    return fits ? value.get<int>() : -1;
}

/// Fields of the wrong type give a display that validate_display() refuses.
Display display_of(const json& value) {
    Display display;
    display.name = text_of(member(value, "name"));
    display.eye_width_px = number_of(member(value, "eye_width_px"));
    display.eye_height_px = number_of(member(value, "eye_height_px"));
    const json& edge = member(value, "tangents");
    const auto tangent = [&edge](const char* key) {
        const json& number = member(edge, key);
        return number.is_number() ? number.get<float>() : std::numeric_limits<float>::quiet_NaN();
    };
    const Tangents left{tangent("left"), tangent("right"), tangent("bottom"), tangent("top")};
    display.eyes[kLeftEye].tangents = left;
    display.eyes[kRightEye].tangents = {-left.right, -left.left, left.bottom, left.top};
    return display;
}

}  // namespace

Expected<Placement> parse_placement(const std::string& text) {
    for (const auto& [name, placement] : kPlacements)
        if (text == name) return placement;
    return fail(ErrorCode::option, "placement '" + text +
                                       "' is unknown: use void-and-cluster, floyd-steinberg, poisson-disk, "
                                       "white-noise or quincunx");
}

Expected<MaskGeometry> parse_mask_geometry(const std::string& text) {
    if (text == "flat") return MaskGeometry::flat;
    if (text == "planar") return MaskGeometry::planar;
    return fail(ErrorCode::option, "geometry '" + text + "' is unknown: use flat or planar");
}

std::string to_string(Placement placement) {
    for (const auto& [name, value] : kPlacements)
        if (placement == value) return name;
    return {};
}

std::string to_string(MaskGeometry geometry) {
    return geometry == MaskGeometry::flat ? "flat" : "planar";
}

std::string to_json(const Recipe& recipe) {
    const Tangents& edge = recipe.display.eyes[kLeftEye].tangents;
    const json display = {
        {"name", recipe.display.name},
        {"eye_width_px", recipe.display.eye_width_px},
        {"eye_height_px", recipe.display.eye_height_px},
        {"tangents", {{"left", edge.left}, {"right", edge.right}, {"bottom", edge.bottom}, {"top", edge.top}}}};
    const json whole = {{"version", kMakingVersion},
                        {"display", display},
                        {"sampling", recipe.preset.name},
                        {"law", to_json(recipe.preset)},
                        {"placement", to_string(recipe.placement)},
                        {"geometry", to_string(recipe.geometry)},
                        {"seed", recipe.seed}};
    // A display's name is a user's, and may not be UTF-8.
    return whole.dump(-1, ' ', false, json::error_handler_t::replace);
}

Expected<Recipe> parse_recipe(const std::string& text) {
    const auto wrong = [](const std::string& what) {
        return fail(ErrorCode::input_file, "recipe of a mask: " + what + " (macula-mask writes recipes)");
    };
    const json root = json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!root.is_object()) return wrong("it is not a JSON object");
    Recipe recipe;
    recipe.display = display_of(member(root, "display"));
    if (const auto valid = validate_display(recipe.display); !valid) return wrong(valid.error().message);
    const auto preset = parse_sampling(text_of(member(root, "sampling")));
    if (!preset) return wrong(preset.error().message);
    recipe.preset = *preset;
    const auto placement = parse_placement(text_of(member(root, "placement")));
    if (!placement) return wrong(placement.error().message);
    recipe.placement = *placement;
    const auto geometry = parse_mask_geometry(text_of(member(root, "geometry")));
    if (!geometry) return wrong(geometry.error().message);
    recipe.geometry = *geometry;
    const json& seed = member(root, "seed");
    if (!seed.is_number_unsigned() || seed > std::numeric_limits<std::uint32_t>::max())
        return wrong("'seed' must be a whole number from 0 to 4294967295");
    recipe.seed = seed.get<std::uint32_t>();
    return recipe;
}

std::string recipe_hash(const std::string& recipe_json) {
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char c : recipe_json) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001B3U;
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
    return digits.data();
}

}  // namespace macula
