#include <set>

#include <gtest/gtest.h>

#include "masks/make/recipe.h"
#include "tests/support/small_display.h"

namespace macula {
namespace {

Recipe recipe_of(const std::string& sampling) {
    return {test::small_display(), parse_sampling(sampling).value(), Placement::quincunx, MaskGeometry::planar,
            4294967295U};
}

TEST(Recipe, ReadsBackItsJson) {
    for (const char* sampling : {"full", "27.5", "paper-41", "paper-18", "guenter", "hvvr-27",
                                 "law:e2=3,exponent=1.5,full=2", "watson", "peli"}) {
        const std::string json = to_json(recipe_of(sampling));
        EXPECT_EQ(json.find('\n'), std::string::npos);
        const auto read = parse_recipe(json);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(to_json(*read), json);
        EXPECT_EQ(read->seed, 4294967295U);
        EXPECT_EQ(read->display.eyes[kRightEye].tangents.left, -read->display.eyes[kLeftEye].tangents.right);
    }
}

TEST(Recipe, HasAHashOfItsOwnForEachChange) {
    std::vector<Recipe> recipes;
    for (const char* sampling : {"full", "27", "28", "paper-27", "watson", "watson-27", "law:e2=3", "law:e2=3.0000001"})
        recipes.push_back(recipe_of(sampling));
    const auto change = [&recipes](auto&& changed) {
        recipes.push_back(recipe_of("27"));
        changed(recipes.back());
    };
    change([](Recipe& recipe) { recipe.display.eye_width_px += 4; });
    change([](Recipe& recipe) { recipe.display.eyes[kLeftEye].tangents.left *= 1.000001F; });
    change([](Recipe& recipe) { recipe.placement = Placement::poisson_disk; });
    change([](Recipe& recipe) { recipe.geometry = MaskGeometry::flat; });
    change([](Recipe& recipe) { recipe.seed = 2; });
    // The same name with other constants, as another version of the program may have.
    change([](Recipe& recipe) { std::get<GeislerPerry>(recipe.preset.law.model).alpha_deg = 0.107; });
    change([](Recipe& recipe) { recipe.preset.law.full_acuity_deg = 1.0; });
    change([](Recipe& recipe) { recipe.preset.fovea_scale = 1.1; });
    std::set<std::string> hashes;
    for (const Recipe& recipe : recipes) hashes.insert(recipe_hash(to_json(recipe)));
    EXPECT_EQ(hashes.size(), recipes.size());
}

TEST(Recipe, OfADisplayWhoseNameIsNotUtf8IsJson) {
    Recipe recipe = recipe_of("27");
    recipe.display.name = "caf\xe9 \"\n";
    EXPECT_TRUE(parse_recipe(to_json(recipe)));
}

TEST(Recipe, ThatIsWrongIsAnErrorThatSaysWhat) {
    const std::string json = to_json(recipe_of("27"));
    const auto with = [&json](const std::string& old_text, const std::string& new_text) {
        std::string changed = json;
        const std::size_t at = changed.find(old_text);
        EXPECT_NE(at, std::string::npos) << old_text;
        return changed.replace(at, old_text.size(), new_text);
    };
    for (const auto& [text, hint] : {std::pair<std::string, std::string>("", "JSON"),
                                     {"[1]", "JSON"},
                                     {json.substr(0, json.size() / 2), "JSON"},
                                     {"{}", "eye_width_px"},
                                     {with("188", "187"), "eye_width_px"},
                                     {with("188", "1e99"), "eye_width_px"},
                                     {with("\"display\":{", "\"display\":[],\"other\":{"), "eye_width_px"},
                                     {with("\"left\":-", "\"left\":"), "tangents"},
                                     {with("\"left\":", "\"lift\":"), "tangents"},
                                     {with("\"27\"", "\"0\""), "sampling '0'"},
                                     {with("\"27\"", "27"), "sampling ''"},
                                     {with("quincunx", "hexagons"), "placement 'hexagons'"},
                                     {with("planar", "round"), "geometry 'round'"},
                                     {with("4294967295", "4294967296"), "seed"},
                                     {with("4294967295", "-1"), "seed"}}) {
        const auto recipe = parse_recipe(text);
        ASSERT_FALSE(recipe) << text;
        EXPECT_EQ(recipe.error().code, ErrorCode::input_file);
        EXPECT_NE(recipe.error().message.find(hint), std::string::npos) << text << "\n" << recipe.error().message;
    }
}

TEST(RecipeHash, IsFnv1a) {
    // Test vectors of the function's authors (Fowler, Noll, Vo).
    EXPECT_EQ(recipe_hash(""), "cbf29ce484222325");
    EXPECT_EQ(recipe_hash("a"), "af63dc4c8601ec8c");
    EXPECT_EQ(recipe_hash("foobar"), "85944171f73967e8");
}

TEST(PlacementNames, AreParsedToWhatTheyName) {
    for (const Placement placement : {Placement::void_and_cluster, Placement::floyd_steinberg, Placement::poisson_disk,
                                      Placement::white_noise, Placement::quincunx})
        EXPECT_EQ(parse_placement(to_string(placement)).value(), placement);
    for (const MaskGeometry geometry : {MaskGeometry::flat, MaskGeometry::planar})
        EXPECT_EQ(parse_mask_geometry(to_string(geometry)).value(), geometry);
    EXPECT_EQ(parse_placement("Quincunx").error().code, ErrorCode::option);
    EXPECT_EQ(parse_mask_geometry("").error().code, ErrorCode::option);
}

}  // namespace
}  // namespace macula
