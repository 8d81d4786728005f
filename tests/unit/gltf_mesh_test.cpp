#include <gtest/gtest.h>

#include "scenes/gltf.h"
#include "tests/support/encoded_image.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

/// The scene, or a test failure and nothing.
std::shared_ptr<const Scene> load_clean(const GltfBuilder& builder) {
    const Expected<LoadedScene> loaded = builder.load();
    if (!loaded) {
        ADD_FAILURE() << loaded.error().message;
        return nullptr;
    }
    EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings.front();
    EXPECT_EQ(scene_defect(*loaded->scene), "");
    return loaded->scene;
}

/// Four corners of the unit square.
GltfBuilder square() {
    GltfBuilder b = GltfBuilder::triangle();
    b.primitive()["attributes"]["POSITION"] = b.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    return b;
}

TEST(GltfMesh, TriangleWithoutIndicesGetsAFlatNormal) {
    const auto scene = load_clean(GltfBuilder::triangle());
    ASSERT_TRUE(scene);
    ASSERT_EQ(scene->meshes.size(), 1U);
    const Mesh& mesh = scene->meshes[0];
    EXPECT_EQ(mesh.triangle, (std::vector<glm::uvec3>{{0, 1, 2}}));
    EXPECT_EQ(mesh.position_m[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.normal, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    EXPECT_EQ(scene->materials[0].name, "default");
    EXPECT_EQ(scene->materials[0].metallic, 1.0F);
}

TEST(GltfMesh, TextFormWithDataUriIsTheSame) {
    const std::string text = GltfBuilder::triangle().gltf();
    const Expected<LoadedScene> loaded =
        load_gltf_from_memory({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "test.gltf");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene->meshes[0].position_m[2], glm::vec3(0, 1, 0));
}

TEST(GltfMesh, EveryIndexWidth) {
    for (int width = 0; width < 3; ++width) {
        GltfBuilder b = square();
        b.primitive()["indices"] = width == 0   ? b.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 2, 1, 3})
                                   : width == 1 ? b.accessor<std::uint16_t>("SCALAR", {0, 1, 2, 2, 1, 3})
                                                : b.accessor<std::uint32_t>("SCALAR", {0, 1, 2, 2, 1, 3});
        b.primitive()["attributes"]["NORMAL"] = b.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 2});
        const auto scene = load_clean(b);
        ASSERT_TRUE(scene);
        EXPECT_EQ(scene->meshes[0].triangle, (std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}})) << width;
        EXPECT_EQ(scene->meshes[0].normal[3], glm::vec3(0, 0, 1)) << "normals are made unit";
    }
}

TEST(GltfMesh, StripAndFanKeepTheWinding) {
    for (const int mode : {5, 6}) {
        GltfBuilder b = square();
        b.primitive()["mode"] = mode;
        const std::vector<std::uint16_t> order =
            mode == 5 ? std::vector<std::uint16_t>{0, 1, 2, 3, 3} : std::vector<std::uint16_t>{0, 1, 3, 2};
        b.primitive()["indices"] = b.accessor<std::uint16_t>("SCALAR", order);
        const auto scene = load_clean(b);
        ASSERT_TRUE(scene);
        EXPECT_EQ(scene->meshes[0].triangle.size(), 2U) << "the stitching triangle of a strip is dropped silently";
        for (const glm::vec3& normal : scene->meshes[0].normal) EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << mode;
    }
}

TEST(GltfMesh, PointsAndLinesAreLeftOutWithAWarning) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfBuilder b = GltfBuilder::triangle();
        auto other = b.primitive();
        other["mode"] = mode;
        b.json["meshes"][0]["primitives"].push_back(other);
        const Expected<LoadedScene> loaded = b.load();
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->scene->meshes.size(), 1U);
        ASSERT_EQ(loaded->warnings.size(), 1U);
        EXPECT_NE(loaded->warnings[0].find("mesh 0, primitive 1: points and lines"), std::string::npos);
    }
}

TEST(GltfMesh, TrianglesWithoutAreaAreCounted) {
    GltfBuilder b = square();
    b.primitive()["indices"] = b.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 1, 1, 3, 2, 0, 0});
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene->triangle_count(), 1U);
    ASSERT_EQ(loaded->warnings.size(), 1U);
    EXPECT_NE(loaded->warnings[0].find("2 triangle(s) without area"), std::string::npos) << loaded->warnings[0];
}

TEST(GltfMesh, SparseReplacesWithAndWithoutABase) {
    GltfBuilder b = GltfBuilder::triangle();
    const int indices = b.view(GltfBuilder::bytes_of<std::uint16_t>({2}));
    const int values = b.view(GltfBuilder::bytes_of<float>({5, 6, 7}));
    const int base = b.primitive()["attributes"]["POSITION"];
    b.json["accessors"][static_cast<std::size_t>(base)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    // Normals that are all zero but for three replacements.
    const int normal_indices = b.view(GltfBuilder::bytes_of<std::uint8_t>({0, 1, 2}));
    const int normal_values = b.view(GltfBuilder::bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}));
    b.primitive()["attributes"]["NORMAL"] =
        b.push("accessors", {{"componentType", 5126},
                             {"count", 3},
                             {"type", "VEC3"},
                             {"sparse",
                              {{"count", 3},
                               {"indices", {{"bufferView", normal_indices}, {"componentType", 5121}}},
                               {"values", {{"bufferView", normal_values}}}}}});
    const auto scene = load_clean(b);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->meshes[0].position_m, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {5, 6, 7}}));
    EXPECT_EQ(scene->meshes[0].normal, (std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

TEST(GltfMesh, InterleavedAttributes) {
    GltfBuilder b = GltfBuilder::triangle();
    const int view = b.view(GltfBuilder::bytes_of<float>({0, 0, 0, 0, 1, 0, 2, 0, 0, 0, 1, 0, 0, 0, 3, 0, 1, 0}), 24);
    for (const auto& [name, offset] : {std::pair{"POSITION", 0}, std::pair{"NORMAL", 12}})
        b.primitive()["attributes"][name] = b.push(
            "accessors",
            {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    const auto scene = load_clean(b);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->meshes[0].position_m[2], glm::vec3(0, 0, 3));
    EXPECT_EQ(scene->meshes[0].normal[2], glm::vec3(0, 1, 0));
}

TEST(GltfMesh, VertexColoursOfEveryKind) {
    const auto load_colors = [](auto add) {
        GltfBuilder b = GltfBuilder::triangle();
        b.primitive()["attributes"]["COLOR_0"] = add(b);
        const auto scene = load_clean(b);
        return scene ? scene->meshes[0].color.at(1) : glm::vec4(-1.0F);
    };
    EXPECT_EQ(load_colors([](GltfBuilder& b) {
                  return b.accessor<float>("VEC3", {0, 0, 0, .25F, .5F, 1, 0, 0, 0});
              }),
              glm::vec4(.25F, .5F, 1, 1));
    EXPECT_EQ(load_colors([](GltfBuilder& b) {
                  return b.accessor<float>("VEC4", {0, 0, 0, 0, .25F, .5F, 1, .75F, 0, 0, 0, 0});
              }),
              glm::vec4(.25F, .5F, 1, .75F));
    EXPECT_EQ(load_colors([](GltfBuilder& b) {
                  return b.accessor<std::uint8_t>("VEC4", {0, 0, 0, 0, 0, 51, 255, 102, 0, 0, 0, 0}, true);
              }),
              glm::vec4(0, 51.0F / 255.0F, 1, 102.0F / 255.0F));
    EXPECT_EQ(load_colors([](GltfBuilder& b) {
                  return b.accessor<std::uint16_t>("VEC4", {0, 0, 0, 0, 0, 13107, 65535, 26214, 0, 0, 0, 0}, true);
              }),
              glm::vec4(0, 13107.0F / 65535.0F, 1, 26214.0F / 65535.0F));
}

TEST(GltfMesh, QuantisedPositionsAndNormals) {
    GltfBuilder b = GltfBuilder::triangle();
    b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    b.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const int position_view = b.view(GltfBuilder::bytes_of<std::int16_t>({-4, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0}), 8);
    b.primitive()["attributes"]["POSITION"] =
        b.push("accessors", {{"bufferView", position_view}, {"componentType", 5122}, {"count", 3}, {"type", "VEC3"}});
    const int normal_view = b.view(GltfBuilder::bytes_of<std::int8_t>({0, 0, 127, 0, 0, 0, -128, 0, 0, -127, 0, 0}), 4);
    b.primitive()["attributes"]["NORMAL"] = b.push(
        "accessors",
        {{"bufferView", normal_view}, {"componentType", 5120}, {"normalized", true}, {"count", 3}, {"type", "VEC3"}});
    const auto scene = load_clean(b);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->meshes[0].position_m[0], glm::vec3(-4, 0, 0));
    EXPECT_EQ(scene->meshes[0].normal, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, -1}, {0, -1, 0}}));
}

TEST(GltfMesh, TangentsAreComputedWhereANormalMapNeedsThem) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.primitive()["attributes"]["NORMAL"] = b.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int texture = b.texture(encode_image("png", 1, 1, 3, {128, 128, 255}));
    b.material()["normalTexture"] = {{"index", texture}, {"scale", 0.5}};
    auto scene = load_clean(b);
    ASSERT_TRUE(scene);
    // u runs along +x, v down along -y: right-handed, w = 1.
    EXPECT_EQ(scene->meshes[0].tangent, std::vector<glm::vec4>(3, glm::vec4(1, 0, 0, 1)));
    EXPECT_EQ(scene->materials[0].normal_scale, 0.5F);
    EXPECT_FALSE(scene->images[0].srgb);

    b.primitive()["attributes"]["TEXCOORD_0"] = b.accessor<float>("VEC2", {1, 1, 0, 1, 1, 0});
    scene = load_clean(b);
    EXPECT_EQ(scene->meshes[0].tangent[0], glm::vec4(-1, 0, 0, -1)) << "a mirrored chart";

    b.primitive()["attributes"]["TANGENT"] = b.accessor<float>("VEC4", {0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1});
    scene = load_clean(b);
    EXPECT_EQ(scene->meshes[0].tangent[0], glm::vec4(0, 1, 0, -1)) << "the file's own tangents";

    b.material().erase("normalTexture");
    scene = load_clean(b);
    EXPECT_TRUE(scene->meshes[0].tangent.empty()) << "nobody needs them";
}

TEST(GltfMesh, MissingCoordinatesOfATextureAreWarnedOf) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    const int texture = b.texture(encode_image("png", 1, 1, 3, {1, 2, 3}));
    b.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", texture}, {"texCoord", 1}}}};
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->warnings.size(), 1U);
    EXPECT_NE(loaded->warnings[0].find("TEXCOORD_1 is missing"), std::string::npos);
    EXPECT_EQ(scene_defect(*loaded->scene), "");
}

TEST(GltfMesh, ZeroNormalsAreReplaced) {
    GltfBuilder b = GltfBuilder::triangle();
    b.primitive()["attributes"]["NORMAL"] = b.accessor<float>("VEC3", {1, 0, 0, 0, 0, 0, 1, 0, 0});
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->warnings.size(), 1U);
    EXPECT_EQ(loaded->scene->meshes[0].normal[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(loaded->scene->meshes[0].normal[0], glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace macula
