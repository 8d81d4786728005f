#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <vector>

#include "scenes/framing.h"
#include "scenes/gltf.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

Expected<LoadedScene> load_valid(const GltfBuilder& builder) {
    Expected<LoadedScene> loaded = builder.load();
    if (loaded) {
        EXPECT_EQ(scene_defect(*loaded->scene), "");
    }
    return loaded;
}

glm::vec3 place(const Instance& instance, const glm::vec3& p) {
    return glm::vec3(instance.world_from_mesh * glm::vec4(p, 1.0F));
}

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5F) << i;
}

TEST(GltfScene, HierarchyOfMatrixAndTrs) {
    GltfBuilder b = GltfBuilder::triangle();
    // Quarter turn about z, scaled by 2, moved; below it a node moved by a matrix.
    b.json["nodes"] = {{{"translation", {10, 0, 0}},
                        {"rotation", {0, 0, std::sin(std::numbers::pi / 4), std::cos(std::numbers::pi / 4)}},
                        {"scale", {2, 2, 2}},
                        {"children", {1, 2}}},
                       {{"mesh", 0}, {"name", "leaf"}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}}},
                       {{"mesh", 0}}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Scene& scene = *loaded->scene;
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.meshes.size(), 1U) << "instances share the mesh";
    EXPECT_EQ(scene.instances[0].name, "leaf");
    expect_near(place(scene.instances[0], {1, 0, 0}), {10, 8, 0});  // (1 + 3) * 2 turned to +y
    expect_near(place(scene.instances[1], {0, 1, 0}), {8, 0, 0});
    EXPECT_EQ(scene.triangle_count(), 2U);
}

TEST(GltfScene, OnlyTheDefaultSceneIsShown) {
    GltfBuilder b = GltfBuilder::triangle();
    b.json["nodes"] = {{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}};
    b.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    b.json["scene"] = 1;
    const Expected<LoadedScene> second = load_valid(b);
    ASSERT_TRUE(second) << second.error().message;
    ASSERT_EQ(second->scene->instances.size(), 1U);
    EXPECT_EQ(second->scene->instances[0].name, "b");

    b.json.erase("scene");
    b.json.erase("scenes");
    const Expected<LoadedScene> roots = load_valid(b);
    ASSERT_TRUE(roots) << roots.error().message;
    EXPECT_EQ(roots->scene->instances.size(), 2U) << "without scenes all roots are shown";
}

TEST(GltfScene, SingularNodesAreLeftOut) {
    GltfBuilder b = GltfBuilder::triangle();
    b.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"name", "flat"}, {"scale", {1, 0, 1}}}};
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene->instances.size(), 1U);
    ASSERT_EQ(loaded->warnings.size(), 1U);
    EXPECT_NE(loaded->warnings[0].find("node 1 (\"flat\")"), std::string::npos);
}

TEST(GltfScene, TinyScaleIsNotSingular) {
    GltfBuilder b = GltfBuilder::triangle();
    b.node()["scale"] = {1e-5, 1e-5, 1e-5};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
}

nlohmann::json lights_extension(const nlohmann::json& lights) {
    return {{"KHR_lights_punctual", {{"lights", lights}}}};
}

GltfBuilder lit_triangle(const nlohmann::json& light) {
    GltfBuilder b = GltfBuilder::triangle();
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"] = lights_extension(nlohmann::json::array({light}));
    // It shines along -z of its node, which a quarter turn about x makes -y.
    const double h = std::sqrt(0.5);
    b.json["nodes"].push_back({{"translation", {0.5, 3, 0}},
                               {"rotation", {-h, 0, 0, h}},
                               {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    return b;
}

TEST(GltfScene, SpotLight) {
    const Expected<LoadedScene> loaded =
        load_valid(lit_triangle({{"type", "spot"},
                                 {"color", {1, 0.5, 0}},
                                 {"intensity", 1000},
                                 {"range", 7},
                                 {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}}));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    ASSERT_EQ(loaded->scene->lights.size(), 1U);
    const Light& light = loaded->scene->lights[0];
    EXPECT_EQ(light.kind, LightKind::spot);
    expect_near(light.position_m, {0.5F, 3, 0});
    expect_near(light.direction, {0, -1, 0});
    EXPECT_FLOAT_EQ(light.intensity.g / light.intensity.r, 0.5F);
    EXPECT_EQ(light.range_m, 7.0F);
    EXPECT_FLOAT_EQ(light.spot_cos_inner, std::cos(0.2F));
    EXPECT_FLOAT_EQ(light.spot_cos_outer, std::cos(0.6F));
}

TEST(GltfScene, LightsOfAnyStrengthStayFinite) {
    for (const double intensity : {1e-40, 1e-10, 1e30, 3e38}) {
        const Expected<LoadedScene> loaded = load_valid(lit_triangle({{"type", "point"}, {"intensity", intensity}}));
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_GE(loaded->scene->lights.size(), 1U);
    }
}

TEST(GltfScene, ExposureMetersTheLights) {
    // A white surface that faces the light in the middle of the scene has radiance 0.8, whatever unit the file uses.
    for (const double intensity : {1.0, 100000.0}) {
        const Expected<LoadedScene> sun = load_valid(lit_triangle({{"type", "directional"}, {"intensity", intensity}}));
        ASSERT_TRUE(sun) << sun.error().message;
        EXPECT_NEAR(sun->scene->lights[0].intensity.g / std::numbers::pi_v<float>, 0.8F, 1e-4F);
        const Expected<LoadedScene> lamp = load_valid(lit_triangle({{"type", "point"}, {"intensity", intensity}}));
        ASSERT_TRUE(lamp) << lamp.error().message;
        const Light& point = lamp->scene->lights[0];
        const float distance = glm::length(point.position_m - world_bounds(*lamp->scene).middle());
        EXPECT_NEAR(point.intensity.g / (distance * distance * std::numbers::pi_v<float>), 0.8F, 1e-4F);
        EXPECT_EQ(lamp->scene->exposure, 1.0F);
    }
}

TEST(GltfScene, WithoutLightsThereIsASunAndSky) {
    const Expected<LoadedScene> loaded = load_valid(GltfBuilder::triangle());
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->scene->lights.size(), 1U);
    EXPECT_EQ(loaded->scene->lights[0].kind, LightKind::directional);
    EXPECT_LT(loaded->scene->lights[0].direction.y, 0.0F);
    EXPECT_GT(loaded->scene->ambient_radiance.r, 0.0F);
}

TEST(GltfScene, AnObjectIsSeenFromItsFront) {
    const Expected<LoadedScene> loaded = load_valid(GltfBuilder::triangle());
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Scene& scene = *loaded->scene;
    EXPECT_EQ(scene.world_from_start.orientation, glm::quat(1, 0, 0, 0));
    expect_near(scene.world_from_start.position_m * glm::vec3(1, 1, 0), {0.5F, 0.5F, 0});
    const float distance = scene.world_from_start.position_m.z;
    const float radius = std::sqrt(0.5F);
    EXPECT_NEAR(radius / distance, std::sin(40.0F * std::numbers::pi_v<float> / 180.0F), 1e-3F);
    EXPECT_FLOAT_EQ(scene.near_m, 0.05F * distance);
}

/// A box of 5 x 3 x 4 m whose fronts are inside or outside.
GltfBuilder box(bool fronts_inside) {
    GltfBuilder b = GltfBuilder::triangle();
    std::vector<float> corners;
    for (int i = 0; i < 8; ++i)
        for (const float c : {i & 1 ? 5.0F : 0.0F, i & 2 ? 3.0F : 0.0F, i & 4 ? 4.0F : 0.0F}) corners.push_back(c);
    std::vector<std::uint8_t> indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                                         1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};
    if (fronts_inside)
        for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
    b.primitive()["attributes"]["POSITION"] = b.accessor<float>("VEC3", corners);
    b.primitive()["indices"] = b.accessor<std::uint8_t>("SCALAR", indices);
    return b;
}

TEST(GltfScene, ARoomIsEntered) {
    const Expected<LoadedScene> room = load_valid(box(true));
    ASSERT_TRUE(room) << room.error().message;
    expect_near(room->scene->world_from_start.position_m, {2.5F, 1.6F, 2});
    EXPECT_EQ(room->scene->near_m, 0.1F);

    const Expected<LoadedScene> block = load_valid(box(false));
    ASSERT_TRUE(block) << block.error().message;
    EXPECT_GT(block->scene->world_from_start.position_m.z, 4.0F) << "a closed block is an object";
}

TEST(GltfScene, IgnoredPartsAreNamedOnce) {
    GltfBuilder b = GltfBuilder::triangle();
    b.json["extensionsUsed"] = {"KHR_materials_iridescence", "EXT_whatever"};
    b.json["meshes"].push_back(b.json["meshes"][0]);
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
        b.json["meshes"][mesh]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->warnings.size(), 3U);
    EXPECT_NE(loaded->warnings[0].find("EXT_whatever"), std::string::npos);
    EXPECT_NE(loaded->warnings[1].find("KHR_materials_iridescence"), std::string::npos);
    EXPECT_NE(loaded->warnings[2].find("morph targets"), std::string::npos);
}

TEST(GltfScene, SkinnedNodesAreShownUnskinnedAndNamed) {
    GltfBuilder b = GltfBuilder::triangle();
    b.json["skins"] = {{{"joints", {0}}}};
    b.node()["skin"] = 0;
    b.node()["name"] = "cat";
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene->instances.size(), 1U);
    ASSERT_EQ(loaded->warnings.size(), 1U);
    EXPECT_NE(loaded->warnings[0].find("node 0 (\"cat\"): is skinned"), std::string::npos) << loaded->warnings[0];
}

TEST(GltfScene, AFloodOfWarningsIsCutShort) {
    GltfBuilder b = GltfBuilder::triangle();
    for (int i = 0; i < 150; ++i) b.json["meshes"][0]["primitives"].push_back({{"attributes", {{"NORMAL", 0}}}});
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->warnings.size(), 101U);
    EXPECT_EQ(loaded->warnings.back(), "test.glb: and 50 warnings more");
}

TEST(GltfScene, OneMeshPlacedVeryOften) {
    // 2000 nodes of a mesh of 40,000 triangles: the probes for a room look at boxes first.
    GltfBuilder b = GltfBuilder::triangle();
    std::vector<float> positions;
    for (int i = 0; i < 40000; ++i)
        for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
            positions.push_back(x + 1e-4F * static_cast<float>(i));
    b.primitive()["attributes"]["POSITION"] = b.accessor<float>("VEC3", positions);
    for (int i = 1; i < 2000; ++i) b.json["nodes"].push_back({{"mesh", 0}, {"translation", {7 * i, 0, 5}}});
    std::vector<int> roots(2000);
    std::iota(roots.begin(), roots.end(), 0);
    b.json["scenes"] = {{{"nodes", roots}}};
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Bounds bounds = world_bounds(*loaded->scene);
    EXPECT_NEAR(bounds.high.x, 7.0F * 1999.0F + 1.0F + 4.0F, 0.01F) << "80 million vertices, by the mesh's box";
    EXPECT_EQ(bounds.low, glm::vec3(0.0F));
}

TEST(GltfScene, AHundredThousandNodesDeep) {
    GltfBuilder b = GltfBuilder::triangle();
    constexpr std::size_t kDepth = 100000;
    b.json["nodes"] = nlohmann::json::array();
    for (std::size_t i = 0; i + 1 < kDepth; ++i) b.json["nodes"].push_back({{"children", {i + 1}}});
    b.json["nodes"].push_back({{"mesh", 0}, {"translation", {1, 2, 3}}});
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    expect_near(place(loaded->scene->instances.at(0), {0, 0, 0}), {1, 2, 3});
}

}  // namespace
}  // namespace macula
