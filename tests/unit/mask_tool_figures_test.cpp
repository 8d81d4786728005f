// The pictures of masks and meshes, and what the options of macula-mask mean.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "masks/make/mesh_store.h"
#include "masks/tool/mask_figure.h"
#include "masks/tool/mask_input.h"
#include "masks/tool/mesh_figure.h"
#include "tests/support/small_display.h"
#include "tests/support/xml.h"

namespace macula {
namespace {

using testing::read_xml;
using testing::XmlElement;

Mask small_mask() {
    Recipe recipe;
    recipe.display = test::small_display(64, 72);
    recipe.preset = *parse_sampling("27");
    return make_mask(recipe).value();
}

TEST(Crop, MeansWhatItSays) {
    const Display display = test::small_display(64, 72);
    const glm::ivec2 mask_px(128, 144);
    const glm::ivec2 gaze_px(64, 72);
    const MaskCrop window = parse_crop("window", mask_px, gaze_px, display).value();
    EXPECT_EQ(window.size_px, glm::ivec2(64, 72));
    EXPECT_EQ(window.begin_px + axis_px(display, kLeftEye), gaze_px);
    EXPECT_EQ(parse_crop("mask", mask_px, gaze_px, display)->size_px, mask_px);
    const MaskCrop part = parse_crop("3,4,5,6", mask_px, gaze_px, display).value();
    EXPECT_EQ(part.begin_px, glm::ivec2(3, 4));
    EXPECT_EQ(part.size_px, glm::ivec2(5, 6));
    EXPECT_TRUE(parse_crop("127,143,1,1", mask_px, gaze_px, display));
    for (const char* wrong : {"", "all", "1,2,3", "1,2,3,4,5", "1,2,3,4,", "1,2,3,x", "-1,0,5,5", "0,0,0,5",
                              "0,0,129,5", "120,0,2147483647,5", "1, 2,3,4"}) {
        const auto crop = parse_crop(wrong, mask_px, gaze_px, display);
        ASSERT_FALSE(crop) << wrong;
        EXPECT_EQ(crop.error().code, ErrorCode::option);
        EXPECT_NE(crop.error().message.find("128 x 144"), std::string::npos) << crop.error().message;
    }
    EXPECT_FALSE(parse_crop("window", {50, 50}, {25, 25}, display));
}

TEST(MaskPicture, ShowsPixelsOneToOneAndLarger) {
    const Mask mask = small_mask();
    const MaskCrop crop{{10, 20}, {40, 30}};
    const GreyPicture same = mask_picture(mask, crop, 40);
    const GreyPicture larger = mask_picture(mask, crop, 120);
    ASSERT_EQ(same.height_px, 30);
    ASSERT_EQ(larger.height_px, 90);
    for (int y = 0; y < 90; ++y) {
        for (int x = 0; x < 120; ++x) {
            const int sampled = mask.sampled[static_cast<std::size_t>((20 + y / 3) * mask.width_px + 10 + x / 3)];
            EXPECT_EQ(larger.at(x, y), 255 * sampled);
            EXPECT_EQ(same.at(x / 3, y / 3), 255 * sampled);
        }
    }
}

/// Where pixels share one of the picture's, the mean of their light is shown, at any scale.
TEST(MaskPicture, AveragesLight) {
    const Mask mask = small_mask();
    const MaskCrop crop{{0, 0}, {mask.width_px, mask.height_px}};
    const int width_px = 37;
    const GreyPicture picture = mask_picture(mask, crop, width_px);
    const double step_x = 1.0 * mask.width_px / width_px;
    const double step_y = 1.0 * mask.height_px / picture.height_px;
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            double light = 0.0;
            for (int j = 0; j < mask.height_px; ++j) {
                const double high = std::min(j + 1.0, step_y * (y + 1)) - std::max(1.0 * j, step_y * y);
                if (high <= 0.0) continue;
                for (int i = 0; i < mask.width_px; ++i) {
                    const double wide = std::min(i + 1.0, step_x * (x + 1)) - std::max(1.0 * i, step_x * x);
                    if (wide > 0.0)
                        light += wide * high * mask.sampled[static_cast<std::size_t>(j * mask.width_px + i)];
                }
            }
            const double code = picture.at(x, y) / 255.0;
            const double shown = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
            EXPECT_NEAR(shown, light / (step_x * step_y), 0.006) << x << ' ' << y;
        }
    }
}

TEST(Panels, StandSideBySideWithTheirCaptions) {
    const std::vector<Panel> panels = {{GreyPicture(20, 10, 0), "one <1>"}, {GreyPicture(20, 30, 0), "two"}};
    const std::vector<XmlElement> elements = read_xml(panels_svg(panels, 100.0, "title").value());
    std::vector<XmlElement> images;
    std::vector<std::string> captions;
    for (const XmlElement& element : elements) {
        if (element.name == "image") images.push_back(element);
        if (element.name == "text") captions.push_back(element.text);
    }
    ASSERT_EQ(images.size(), 2U);
    EXPECT_EQ(captions, (std::vector<std::string>{"one <1>", "two"}));
    EXPECT_EQ(images[0].number("height"), 50.0);
    EXPECT_EQ(images[1].number("height"), 150.0);
    EXPECT_GT(images[1].number("x"), images[0].number("x") + 100.0);
    EXPECT_LT(images[1].number("x") + 100.0, elements.front().number("width"));

    const GreyPicture whole = panels_picture(panels);
    EXPECT_EQ(whole.height_px, 30);
    EXPECT_EQ(std::ranges::count(whole.texels, 0), 20 * 10 + 20 * 30);
    EXPECT_EQ(whole.at(0, 0), 0);
    EXPECT_EQ(whole.at(whole.width_px - 1, 29), 0);
    EXPECT_EQ(whole.at(0, 29), 255) << "below the lower panel";
}

TEST(MeshFigure, HasEachEdgeOnce) {
    const SampleMesh mesh = triangulate_mask(small_mask());
    const std::vector<MeshEdge> edges = visible_edges(mesh, {{0, 0}, {mesh.width_px, mesh.height_px}});
    std::set<std::set<std::uint32_t>> all;
    for (const SampleMesh::Triangle& triangle : mesh.triangle)
        for (int k = 0; k < 3; ++k) all.insert({triangle[k], triangle[(k + 1) % 3]});
    EXPECT_EQ(edges.size(), all.size());
    for (const MeshEdge& edge : edges) EXPECT_TRUE(all.contains({edge[0], edge[1]}));

    const MaskCrop crop{{30, 30}, {20, 20}};
    const std::vector<MeshEdge> near = visible_edges(mesh, crop);
    EXPECT_LT(near.size(), edges.size() / 4);
    // No edge with an end inside is missing.
    const auto inside = [&](std::uint32_t site) {
        const SamplePosition p = mesh.site[site];
        return p.x_px >= 30 && p.x_px < 50 && p.y_px >= 30 && p.y_px < 50;
    };
    for (const MeshEdge& edge : edges)
        EXPECT_TRUE(!(inside(edge[0]) || inside(edge[1])) || std::ranges::binary_search(near, edge));
}

TEST(MeshFigure, LinesEndAtPixelCentres) {
    SampleMesh mesh;
    mesh.width_px = 40;
    mesh.height_px = 20;
    mesh.site = {{10, 5}, {20, 5}, {10, 15}};
    mesh.triangle = {{0, 1, 2}};
    const MaskCrop crop{{8, 4}, {20, 16}};
    const std::vector<MeshEdge> edges = visible_edges(mesh, crop);
    ASSERT_EQ(edges.size(), 3U);
    const std::vector<XmlElement> elements = read_xml(mesh_svg(mesh, edges, crop, 200.0));
    const auto path = std::ranges::find(elements, "path", &XmlElement::name);
    ASSERT_NE(path, elements.end());
    EXPECT_EQ(path->at("d"), "M25 15L125 15M25 15L25 115M125 15L25 115");

    // Of the level and the upright line, every pixel within is dark, and the one beyond the end white.
    const GreyPicture picture = mesh_picture(mesh, edges, crop, 200);
    ASSERT_EQ(picture.height_px, 160);
    for (int x = 26; x < 124; ++x) EXPECT_LT(std::min(picture.at(x, 14), picture.at(x, 15)), 160);
    for (int y = 16; y < 114; ++y) EXPECT_LT(std::min(picture.at(24, y), picture.at(25, y)), 160);
    EXPECT_EQ(picture.at(20, 15), 255);
    EXPECT_EQ(picture.at(60, 40), 255);
}

TEST(MaskInput, ListsOfPresetsKeepLawsWhole) {
    using List = std::vector<std::string>;
    EXPECT_EQ(split_presets("paper-54,27"), (List{"paper-54", "27"}));
    EXPECT_EQ(split_presets("law:e2=3,contrast=.02,watson,law:e2=2"),
              (List{"law:e2=3,contrast=.02", "watson", "law:e2=2"}));
    EXPECT_EQ(split_presets("54,e2=3"), (List{"54", "e2=3"}));
    EXPECT_EQ(split_presets(""), List{});
}

TEST(MaskInput, OptionsThatMeanNothingAreNamed) {
    const auto message = [](RecipeOptions options) { return recipes_of(options).error(); };
    EXPECT_NE(message({.sampling = "54,nonsense"}).message.find("'nonsense'"), std::string::npos);
    EXPECT_NE(message({.placement = "dice"}).message.find("'dice'"), std::string::npos);
    EXPECT_NE(message({.geometry = "round"}).message.find("'round'"), std::string::npos);
    EXPECT_NE(message({.display = "monocle"}).message.find("'monocle'"), std::string::npos);
    EXPECT_EQ(message({.sampling = ""}).code, ErrorCode::option);
    const auto recipes = recipes_of({.sampling = "paper-54,watson", .placement = "quincunx", .seed = 9});
    ASSERT_TRUE(recipes) << recipes.error().message;
    ASSERT_EQ(recipes->size(), 2U);
    EXPECT_EQ((*recipes)[1].preset.name, "watson");
    EXPECT_EQ((*recipes)[1].placement, Placement::quincunx);
    EXPECT_EQ((*recipes)[1].seed, 9U);
}

TEST(MaskInput, PixelsAreTwoNumbers) {
    EXPECT_EQ(parse_pixel("12,-3"), glm::ivec2(12, -3));
    for (const char* wrong : {"", "1", "1,", ",1", "1,2,3", "1;2", "1,2 ", "a,b"})
        EXPECT_FALSE(parse_pixel(wrong)) << wrong;
}

TEST(MaskInput, AMeshesSitesAreItsMask) {
    const Mask mask = small_mask();
    const Mask back = mask_of(triangulate_mask(mask));
    EXPECT_EQ(back.sampled, mask.sampled);
    EXPECT_EQ(back.gaze_px, mask.gaze_px);
    EXPECT_EQ(back.recipe, mask.recipe);
}

}  // namespace
}  // namespace macula
