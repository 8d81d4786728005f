#include <gtest/gtest.h>

#include <numbers>

#include "scenes/gltf.h"
#include "tests/support/encoded_image.h"
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

Bytes one_texel() {
    return encode_image("png", 1, 1, 3, {10, 20, 30});
}

TEST(GltfMaterial, FactorsAndFlags) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.json["extensionsUsed"] = {"KHR_materials_unlit"};
    b.material() = {{"name", "leaf"},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.6}}},
                    {"emissiveFactor", {0.7, 0.8, 0.9}},
                    {"alphaMode", "MASK"},
                    {"alphaCutoff", 0.25},
                    {"doubleSided", true},
                    {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    const Material& m = loaded->scene->materials.at(0);
    EXPECT_EQ(m.name, "leaf");
    EXPECT_EQ(m.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(m.metallic, 0.5F);
    EXPECT_EQ(m.roughness, 0.6F);
    EXPECT_EQ(m.emissive, glm::vec3(0.7F, 0.8F, 0.9F));
    EXPECT_TRUE(m.alpha_mode == AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.25F);
    EXPECT_TRUE(m.double_sided);
    EXPECT_TRUE(m.unlit);
}

TEST(GltfMaterial, BlendStaysBlend) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.material() = {{"alphaMode", "BLEND"}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->scene->materials[0].alpha_mode == AlphaMode::blend);
    EXPECT_TRUE(loaded->warnings.empty());
}

TEST(GltfMaterial, AnImageIsStoredOncePerKindOfUse) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    const int texture = b.texture(one_texel());
    const nlohmann::json use = {{"index", texture}};
    b.material() = {{"pbrMetallicRoughness", {{"baseColorTexture", use}, {"metallicRoughnessTexture", use}}},
                    {"normalTexture", use},
                    {"emissiveTexture", use}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Scene& scene = *loaded->scene;
    ASSERT_EQ(scene.images.size(), 2U);
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.base_color_texture.image, m.emissive_texture.image);
    EXPECT_EQ(m.metallic_roughness_texture.image, m.normal_texture.image);
    EXPECT_TRUE(scene.images[static_cast<std::size_t>(m.base_color_texture.image)].srgb);
    EXPECT_FALSE(scene.images[static_cast<std::size_t>(m.normal_texture.image)].srgb);
    EXPECT_EQ(scene.images[1].texels, (Bytes{10, 20, 30}));
}

TEST(GltfMaterial, SamplersAndCoordinateSets) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.primitive()["attributes"]["TEXCOORD_1"] = b.accessor<std::uint16_t>("VEC2", {0, 0, 65535, 0, 0, 13107}, true);
    b.texture(one_texel());
    b.json["textures"][0]["sampler"] = 0;
    b.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9987}}};
    b.material()["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const TextureUse& use = loaded->scene->materials[0].emissive_texture;
    EXPECT_EQ(use.wrap_u, TextureWrap::clamp_to_edge);
    EXPECT_EQ(use.wrap_v, TextureWrap::mirrored_repeat);
    EXPECT_EQ(use.filter, TextureFilter::nearest);
    EXPECT_EQ(use.uv_set, 1);
    const Mesh& mesh = loaded->scene->meshes[0];
    EXPECT_TRUE(mesh.uv0.empty()) << "a set that no texture uses is not kept";
    EXPECT_EQ(mesh.uv1, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 13107.0F / 65535.0F}}));
}

TEST(GltfMaterial, TextureTransform) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.json["extensionsUsed"] = {"KHR_texture_transform"};
    b.primitive()["attributes"]["TEXCOORD_1"] = b.accessor<float>("VEC2", {0, 0, 0, 0, 0, 0});
    b.texture(one_texel());
    b.material()["emissiveTexture"] = {
        {"index", 0},
        {"extensions",
         {{"KHR_texture_transform",
           {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"rotation", std::numbers::pi / 2}, {"texCoord", 1}}}}}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const TextureUse& use = loaded->scene->materials[0].emissive_texture;
    EXPECT_EQ(use.uv_set, 1);
    EXPECT_EQ(use.uv_offset, glm::vec2(0.25F, 0.5F));
    // Scaled, then turned counter-clockwise while v points down: (1, 0) -> (2, 0) -> (0, -2); (0, 1) -> (3, 0).
    const glm::vec4 expected(0, -2, 3, 0);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(use.uv_scale_rotation[i], expected[i], 1e-6F) << i;
}

TEST(GltfMaterial, EveryKindOfPictureIsStoredAsSmallAsItIs) {
    struct Case {
        const char* what;
        Bytes file;
        int channels;
        TexelType type;
    };
    const std::vector<Case> cases = {
        {"grey", encode_image("png", 2, 1, 1, {7, 200}), 1, TexelType::u8},
        {"grey and alpha", encode_image("png", 2, 1, 2, {7, 100, 200, 0}), 2, TexelType::u8},
        {"RGB", encode_image("png", 2, 1, 3, {1, 2, 3, 4, 5, 6}), 3, TexelType::u8},
        {"RGBA", encode_image("png", 2, 1, 4, {1, 2, 3, 4, 5, 6, 7, 0}), 4, TexelType::u8},
        {"16 bit", encode_image("png", 2, 1, 3, {1, 2, 3, 4, 5, 6}, 16), 3, TexelType::u16},
        {"JPEG", encode_image("jpeg", 8, 8, 3, Bytes(192, 90)), 3, TexelType::u8},
        {"grey JPEG", encode_image("jpeg", 8, 8, 1, Bytes(64, 90)), 1, TexelType::u8},
    };
    for (const Case& c : cases) {
        GltfBuilder b = GltfBuilder::textured_triangle();
        b.material()["emissiveTexture"] = {{"index", b.texture(c.file)}};
        const Expected<LoadedScene> loaded = load_valid(b);
        ASSERT_TRUE(loaded) << c.what << ": " << loaded.error().message;
        const TextureImage& image = loaded->scene->images.at(0);
        EXPECT_EQ(image.channels, c.channels) << c.what;
        EXPECT_EQ(image.type, c.type) << c.what;
    }
}

TEST(GltfMaterial, ImagesInDataUris) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.json["images"] = {{{"uri", "data:image/png;base64," + GltfBuilder::base64(one_texel())}}};
    b.json["textures"] = {{{"source", 0}}};
    b.material()["emissiveTexture"] = {{"index", 0}};
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene->images.at(0).texels, (Bytes{10, 20, 30}));
}

TEST(GltfMaterial, UnusedMaterialsAndImagesAreNotRead) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.texture({'b', 'r', 'o', 'k', 'e', 'n'});
    b.json["materials"].push_back({{"emissiveTexture", {{"index", 0}}}});
    const Expected<LoadedScene> loaded = load_valid(b);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->scene->images.empty());
    EXPECT_EQ(loaded->scene->materials.size(), 1U);
}

}  // namespace
}  // namespace macula
