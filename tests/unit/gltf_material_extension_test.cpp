#include <gtest/gtest.h>

#include "scenes/gltf_material_extension.h"
#include "tests/support/encoded_image.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

Bytes one_texel() {
    return encode_image("png", 1, 1, 3, {10, 20, 30});
}

/// A triangle whose material has these extensions; texture 0 is a single texel.
GltfBuilder with_extensions(const nlohmann::json& extensions) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.texture(one_texel());
    b.material()["name"] = "stuff";
    b.material()["extensions"] = extensions;
    b.json["extensionsUsed"] = nlohmann::json::array();
    for (const auto& [name, value] : extensions.items()) b.json["extensionsUsed"].push_back(name);
    return b;
}

/// The scene; a failure where a promise is broken or a warning differs from `warnings`, of which each is a part.
std::shared_ptr<const Scene> load_with_warnings(const GltfBuilder& b, const std::vector<std::string>& warnings) {
    const Expected<LoadedScene> loaded = b.load();
    if (!loaded) {
        ADD_FAILURE() << loaded.error().message;
        Scene nothing;
        nothing.materials.resize(1);
        nothing.meshes.resize(1);
        return std::make_shared<Scene>(std::move(nothing));
    }
    EXPECT_EQ(scene_defect(*loaded->scene), "");
    EXPECT_EQ(loaded->warnings.size(), warnings.size());
    for (std::size_t i = 0; i < std::min(warnings.size(), loaded->warnings.size()); ++i)
        EXPECT_NE(loaded->warnings[i].find(warnings[i]), std::string::npos) << loaded->warnings[i];
    return loaded->scene;
}

Material load_material(const nlohmann::json& extensions, const std::vector<std::string>& warnings = {}) {
    return load_with_warnings(with_extensions(extensions), warnings)->materials.at(0);
}

/// A textureInfo that has everything: the second set of coordinates and a transform.
nlohmann::json use_of_texture(double offset) {
    return {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {offset, 0.5}}}}}}};
}

bool is_srgb(const Scene& scene, const TextureUse& use) {
    return scene.images.at(static_cast<std::size_t>(use.image)).srgb;
}

TEST(GltfMaterialExtension, EveryFactor) {
    const Material m = load_material(
        {{"KHR_materials_ior", {{"ior", 1.33}}},
         {"KHR_materials_specular", {{"specularFactor", 0.25}, {"specularColorFactor", {0.5, 1.0, 2.0}}}},
         {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.125}}},
         {"KHR_materials_sheen", {{"sheenColorFactor", {0.1, 0.2, 0.3}}, {"sheenRoughnessFactor", 0.625}}},
         {"KHR_materials_transmission", {{"transmissionFactor", 0.875}}},
         {"KHR_materials_volume",
          {{"thicknessFactor", 0.02}, {"attenuationDistance", 0.5}, {"attenuationColor", {0.5, 0.25, 0.0}}}}});
    EXPECT_EQ(m.ior, 1.33F);
    EXPECT_EQ(m.specular, 0.25F);
    EXPECT_EQ(m.specular_color, glm::vec3(0.5F, 1, 2)) << "more than 1 is allowed";
    EXPECT_EQ(m.clearcoat, 0.75F);
    EXPECT_EQ(m.clearcoat_roughness, 0.125F);
    EXPECT_EQ(m.sheen_color, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(m.sheen_roughness, 0.625F);
    EXPECT_EQ(m.transmission, 0.875F);
    EXPECT_EQ(m.thickness_m, 0.02F);
    EXPECT_EQ(m.attenuation_distance_m, 0.5F);
    EXPECT_EQ(m.attenuation_color, glm::vec3(0.5F, 0.25F, kDarkestAttenuation));
}

TEST(GltfMaterialExtension, DefaultsOfEmptyExtensions) {
    const nlohmann::json none = nlohmann::json::object();
    const Material m = load_material({{"KHR_materials_ior", none},
                                      {"KHR_materials_specular", none},
                                      {"KHR_materials_clearcoat", none},
                                      {"KHR_materials_sheen", none},
                                      {"KHR_materials_transmission", none},
                                      {"KHR_materials_volume", none},
                                      {"KHR_materials_emissive_strength", none}});
    EXPECT_EQ(m.ior, 1.5F);
    EXPECT_EQ(m.specular, 1.0F);
    EXPECT_EQ(m.specular_color, glm::vec3(1.0F));
    EXPECT_EQ(m.clearcoat, 0.0F);
    EXPECT_EQ(m.sheen_color, glm::vec3(0.0F));
    EXPECT_EQ(m.transmission, 0.0F);
    EXPECT_EQ(m.thickness_m, 0.0F);
    EXPECT_EQ(m.attenuation_distance_m, 0.0F) << "infinitely far: clear";
    EXPECT_EQ(m.attenuation_color, glm::vec3(1.0F));
}

TEST(GltfMaterialExtension, EmissiveStrengthMultiplies) {
    GltfBuilder b = with_extensions({{"KHR_materials_emissive_strength", {{"emissiveStrength", 12.5}}}});
    b.material()["emissiveFactor"] = {1.0, 0.5, 0.0};
    EXPECT_EQ(load_with_warnings(b, {})->materials[0].emissive, glm::vec3(12.5F, 6.25F, 0));
}

TEST(GltfMaterialExtension, EveryTextureWithItsTransformAndCoding) {
    GltfBuilder b = with_extensions(
        {{"KHR_materials_specular",
          {{"specularTexture", use_of_texture(1)}, {"specularColorTexture", use_of_texture(2)}}},
         {"KHR_materials_clearcoat",
          {{"clearcoatFactor", 1},
           {"clearcoatTexture", use_of_texture(3)},
           {"clearcoatRoughnessTexture", use_of_texture(4)},
           {"clearcoatNormalTexture", {{"index", 0}, {"texCoord", 1}, {"scale", -0.5}}}}},
         {"KHR_materials_sheen",
          {{"sheenColorFactor", {1, 1, 1}},
           {"sheenColorTexture", use_of_texture(6)},
           {"sheenRoughnessTexture", use_of_texture(7)}}},
         {"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", use_of_texture(8)}}},
         {"KHR_materials_volume", {{"thicknessFactor", 1}, {"thicknessTexture", use_of_texture(9)}}}});
    b.json["extensionsUsed"].push_back("KHR_texture_transform");
    b.primitive()["attributes"]["TEXCOORD_1"] = b.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
    const auto scene = load_with_warnings(b, {});
    const Material& m = scene->materials[0];
    const std::vector<std::pair<const TextureUse*, float>> transformed = {
        {&m.specular_texture, 1.0F},     {&m.specular_color_texture, 2.0F},
        {&m.clearcoat_texture, 3.0F},    {&m.clearcoat_roughness_texture, 4.0F},
        {&m.sheen_color_texture, 6.0F},  {&m.sheen_roughness_texture, 7.0F},
        {&m.transmission_texture, 8.0F}, {&m.thickness_texture, 9.0F}};
    for (const auto& [use, offset] : transformed) {
        ASSERT_TRUE(use->present()) << offset;
        EXPECT_EQ(use->uv_offset, glm::vec2(offset, 0.5F));
        EXPECT_EQ(is_srgb(*scene, *use), use == &m.specular_color_texture || use == &m.sheen_color_texture) << offset;
    }
    ASSERT_TRUE(m.clearcoat_normal_texture.present());
    EXPECT_FALSE(is_srgb(*scene, m.clearcoat_normal_texture));
    EXPECT_EQ(m.clearcoat_normal_texture.uv_set, 1);
    EXPECT_EQ(m.clearcoat_normal_scale, -0.5F);
    EXPECT_EQ(scene->images.size(), 2U) << "one image, stored once as sRGB and once as linear";
    EXPECT_EQ(scene->meshes[0].uv0.size(), 3U);
    EXPECT_EQ(scene->meshes[0].uv1.size(), 3U);
    // The coat's normal map is the only one: its coordinates, u along +x and v along +y, give the tangents.
    EXPECT_EQ(scene->meshes[0].tangent, std::vector<glm::vec4>(3, glm::vec4(1, 0, 0, -1)));
}

TEST(GltfMaterialExtension, TexturesOfAbsentLayersAreNotRead) {
    GltfBuilder b =
        with_extensions({{"KHR_materials_clearcoat", {{"clearcoatTexture", use_of_texture(0)}}},
                         {"KHR_materials_sheen", {{"sheenColorTexture", use_of_texture(0)}}},
                         {"KHR_materials_transmission", {{"transmissionTexture", use_of_texture(0)}}},
                         {"KHR_materials_volume", {{"thicknessTexture", use_of_texture(0)}}},
                         {"KHR_materials_specular", {{"specularFactor", 0}, {"specularTexture", use_of_texture(0)}}}});
    const auto scene = load_with_warnings(b, {});
    EXPECT_TRUE(scene->images.empty());
    EXPECT_TRUE(scene->meshes[0].uv0.empty());
}

TEST(GltfMaterialExtension, OutOfRangeIsClampedAndNamed) {
    const std::string element = "material 0 (\"stuff\"), ";
    Material m = load_material({{"KHR_materials_clearcoat", {{"clearcoatFactor", 1.5}}}},
                               {element + "KHR_materials_clearcoat: clearcoatFactor is out of range"});
    EXPECT_EQ(m.clearcoat, 1.0F);
    m = load_material({{"KHR_materials_transmission", {{"transmissionFactor", -1}}}}, {"transmissionFactor"});
    EXPECT_EQ(m.transmission, 0.0F);
    m = load_material({{"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 2.0, 0.5}}}}}, {"sheenColorFactor"});
    EXPECT_EQ(m.sheen_color, glm::vec3(0.5F, 1, 0.5F));
    m = load_material({{"KHR_materials_ior", {{"ior", -2}}}}, {"ior is out of range"});
    EXPECT_GE(m.ior, 1.0F);
    m = load_material({{"KHR_materials_volume", {{"thicknessFactor", -2}, {"attenuationDistance", -1}}}},
                      {"thicknessFactor", "attenuationDistance"});
    EXPECT_EQ(m.thickness_m, 0.0F);
    m = load_material({{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e300}}}}, {"emissiveStrength"});

    GltfBuilder core = GltfBuilder::textured_triangle();
    core.material()["pbrMetallicRoughness"] = {{"metallicFactor", 2}, {"roughnessFactor", -1}};
    m = load_with_warnings(core, {"metallicFactor", "roughnessFactor"})->materials[0];
    EXPECT_EQ(m.metallic, 1.0F);
    EXPECT_EQ(m.roughness, 0.0F);
    core.material() = {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 2, 1}}}}, {"emissiveFactor", {-1, 2, 0}}};
    m = load_with_warnings(core, {"baseColorFactor", "emissiveFactor"})->materials[0];
    EXPECT_EQ(m.base_color, glm::vec4(1.0F));
    EXPECT_EQ(m.emissive, glm::vec3(0, 2, 0));
}

TEST(GltfMaterialExtension, IorOfZeroIsAMirrorAtEveryAngle) {
    EXPECT_EQ(load_material({{"KHR_materials_ior", {{"ior", 0}}}}).ior, kMirrorIor);
    EXPECT_EQ(load_material({{"KHR_materials_ior", {{"ior", 0.5}}}}).ior, 1.0F);
}

TEST(GltfMaterialExtension, MalformedMembersAreRefusedAndNamed) {
    const std::vector<std::pair<nlohmann::json, std::string>> cases = {
        {{{"KHR_materials_clearcoat", {{"clearcoatFactor", "much"}}}}, "clearcoatFactor is not a number"},
        {{{"KHR_materials_sheen", {{"sheenColorFactor", {1, 2}}}}}, "sheenColorFactor is not three numbers"},
        {{{"KHR_materials_sheen", {{"sheenColorFactor", {1, 2, "x"}}}}}, "sheenColorFactor is not three numbers"},
        {{{"KHR_materials_specular", {{"specularTexture", 3}}}}, "specularTexture is not a texture"},
        {{{"KHR_materials_specular", {{"specularTexture", {{"index", "a"}}}}}}, "specularTexture is not a texture"},
        {{{"KHR_materials_specular", {{"specularTexture", {{"index", 7}}}}}}, "texture 7 does not exist"},
        {{{"KHR_materials_specular", {{"specularTexture", {{"index", -7}}}}}}, "texture -7 does not exist"},
        {{{"KHR_materials_specular", {{"specularTexture", {{"index", 0}, {"texCoord", 4}}}}}}, "TEXCOORD_0 and"},
        {{{"KHR_materials_clearcoat",
           {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}, {"scale", "x"}}}}}},
         "the scale is not a finite number"},
    };
    for (const auto& [extensions, message] : cases) {
        const Expected<LoadedScene> loaded = with_extensions(extensions).load();
        ASSERT_FALSE(loaded) << message;
        EXPECT_EQ(loaded.error().code, ErrorCode::input_file);
        EXPECT_NE(loaded.error().message.find("material 0 (\"stuff\"), KHR_materials_"), std::string::npos)
            << loaded.error().message;
        EXPECT_NE(loaded.error().message.find(message), std::string::npos) << loaded.error().message;
    }
}

/// The triangle with an emissive texture that has a WebP image and, if `core` is not empty, a PNG beside it.
GltfBuilder with_webp(const Bytes& webp, const Bytes& core) {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.json["extensionsUsed"] = {"EXT_texture_webp"};
    const int webp_image = b.push("images", {{"bufferView", b.view(webp)}, {"mimeType", "image/webp"}});
    b.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", webp_image}}}}}}};
    if (!core.empty())
        b.json["textures"][0]["source"] = b.push("images", {{"bufferView", b.view(core)}, {"mimeType", "image/png"}});
    b.material()["emissiveTexture"] = {{"index", 0}};
    b.material()["emissiveFactor"] = {1, 1, 1};
    return b;
}

TEST(GltfMaterialExtension, WebPImagesAreTakenFirst) {
    const Bytes webp = encode_image("webp", 2, 2, 3, Bytes(12, 200));
    for (const Bytes& core : {Bytes(), one_texel()}) {
        const auto scene = load_with_warnings(with_webp(webp, core), {});
        ASSERT_EQ(scene->images.size(), 1U);
        EXPECT_EQ(scene->images[0].width_px, 2) << "the PNG beside it has one texel";
        EXPECT_NEAR(scene->images[0].texels.at(0), 200, 6);
    }
}

TEST(GltfMaterialExtension, WebPThatCannotBeDecodedIsReplacedOnce) {
    GltfBuilder b = with_webp({'R', 'I', 'F', 'F', 4, 0, 0, 0, 'W', 'E', 'B', 'P'}, one_texel());
    b.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    const auto scene = load_with_warnings(b, {"texture 0: its WebP image is replaced by image 1 ("});
    ASSERT_EQ(scene->images.size(), 1U);
    EXPECT_EQ(scene->images[0].texels, (Bytes{10, 20, 30}));
}

TEST(GltfMaterialExtension, WebPThatCannotBeReplacedIsRefused) {
    const Expected<LoadedScene> loaded = with_webp({'R', 'I', 'F', 'F', 4, 0, 0, 0, 'W', 'E', 'B', 'P'}, {}).load();
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message.find("image 0"), std::string::npos) << loaded.error().message;
    GltfBuilder nameless = with_webp(Bytes(4, 0), {});
    nameless.json["textures"][0]["extensions"]["EXT_texture_webp"] = nlohmann::json::object();
    const Expected<LoadedScene> second = nameless.load();
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("EXT_texture_webp does not name an image"), std::string::npos);
}

}  // namespace
}  // namespace macula
