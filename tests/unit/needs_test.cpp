// What a scene needs, found for one feature at a time: exactly its bits are set, and not where it has no effect.

#include "scenes/needs.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/shapes.h"

namespace macula {
namespace {

/// A rough white dielectric square, which needs nothing.
Scene plain_scene() {
    Scene scene;
    Material material;
    material.metallic = 0.0F;
    scene.materials.push_back(material);
    scene.meshes.push_back(make_quad({-1, 1, 0}, {2, 0, 0}, {0, -2, 0}));
    scene.instances.push_back({"wall", 0, glm::mat4(1.0F)});
    return scene;
}

std::uint32_t needs_of(const Scene& scene) {
    return scene_needs(scene).needs;
}

/// Adds an image of one texel and lets the material use it.
void use_texel(Scene& scene, TextureUse& use, std::vector<std::uint8_t> rgba) {
    TextureImage image;
    image.name = "texel";
    image.width_px = 1;
    image.height_px = 1;
    image.texels = std::move(rgba);
    use.image = static_cast<int>(scene.images.size());
    scene.images.push_back(std::move(image));
}

TEST(Needs, APlainSceneNeedsNothing) {
    const SceneNeeds needs = scene_needs(plain_scene());
    EXPECT_EQ(needs.needs, 0U);
    ASSERT_EQ(needs.reason.size(), static_cast<std::size_t>(kNeedCount));
    for (const std::string& reason : needs.reason) EXPECT_FALSE(reason.empty());
}

TEST(Needs, WhatNoInstanceShowsIsNotNeeded) {
    Scene scene = plain_scene();
    Mesh hidden = scene.meshes[0];
    hidden.material = 1;
    scene.meshes.push_back(hidden);
    Material mirror;
    mirror.roughness = 0.0F;
    scene.materials.push_back(mirror);
    EXPECT_EQ(needs_of(scene), 0U);
    scene.instances.push_back({"mirror", 1, glm::mat4(1.0F)});
    EXPECT_EQ(needs_of(scene), kNeedMirrors);
}

TEST(Needs, ReflectionsDependOnRoughness) {
    Scene scene = plain_scene();
    Material& material = scene.materials[0];
    material.roughness = kGlossLimit;
    EXPECT_EQ(needs_of(scene), kNeedGloss);
    material.roughness = kMirrorLimit;
    EXPECT_EQ(needs_of(scene), kNeedMirrors);
    material.specular = 0.0F;
    EXPECT_EQ(needs_of(scene), kNeedSpecular) << "a dielectric that does not reflect needs no ray";
    material.metallic = 1.0F;
    EXPECT_EQ(needs_of(scene), kNeedMirrors) << "metals reflect whatever the dielectric part does";
    material.unlit = true;
    EXPECT_EQ(needs_of(scene), 0U);
}

TEST(Needs, ImagesAreRead) {
    Scene scene = plain_scene();
    Material& material = scene.materials[0];
    material.roughness = 1.0F;
    use_texel(scene, material.metallic_roughness_texture, {0, 255, 0, 255});
    EXPECT_EQ(needs_of(scene), kNeedTextures);
    use_texel(scene, material.metallic_roughness_texture, {0, 60, 0, 255});
    EXPECT_EQ(needs_of(scene), kNeedTextures | kNeedGloss) << "60/255 is smooth enough for a traced reflection";
}

TEST(Needs, AlphaOfOneCoversEverything) {
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        const std::uint32_t expected = mode == AlphaMode::mask ? kNeedAlphaMasks : kNeedBlending;
        Scene scene = plain_scene();
        scene.materials[0].alpha_mode = mode;
        EXPECT_EQ(needs_of(scene), 0U);
        use_texel(scene, scene.materials[0].base_color_texture, {0, 0, 0, 255});
        EXPECT_EQ(needs_of(scene), kNeedTextures);
        use_texel(scene, scene.materials[0].base_color_texture, {0, 0, 0, 100});
        EXPECT_EQ(needs_of(scene), kNeedTextures | expected);
        scene.materials[0].alpha_mode = AlphaMode::opaque;
        EXPECT_EQ(needs_of(scene), kNeedTextures) << "alpha is ignored";

        Scene colored = plain_scene();
        colored.materials[0].alpha_mode = mode;
        colored.meshes[0].color.assign(4, {1, 1, 1, 0.25F});
        EXPECT_EQ(needs_of(colored), kNeedVertexColors | expected);
    }
}

TEST(Needs, GlassIsAThinWallOrAVolume) {
    Scene scene = plain_scene();
    Material& material = scene.materials[0];
    material.transmission = 1.0F;
    EXPECT_EQ(needs_of(scene), kNeedTransmission);
    material.thickness_m = 0.1F;
    EXPECT_EQ(needs_of(scene), kNeedRefraction);
    material.attenuation_color = {0.5F, 1, 1};
    EXPECT_EQ(needs_of(scene), kNeedRefraction) << "without a distance nothing is absorbed";
    material.attenuation_distance_m = 1.0F;
    EXPECT_EQ(needs_of(scene), kNeedRefraction | kNeedAbsorption);
    material.metallic = 1.0F;
    EXPECT_EQ(needs_of(scene), 0U) << "metals let no light through";
}

TEST(Needs, Layers) {
    Scene scene = plain_scene();
    scene.materials[0].clearcoat = 1.0F;
    scene.materials[0].clearcoat_roughness = 0.2F;
    scene.materials[0].sheen_color = {0, 0, 0.1F};
    EXPECT_EQ(needs_of(scene), kNeedClearcoat | kNeedGloss | kNeedSheen);
}

TEST(Needs, NormalMaps) {
    Scene scene = plain_scene();
    use_texel(scene, scene.materials[0].normal_texture, {128, 128, 255, 255});
    EXPECT_EQ(needs_of(scene), kNeedTextures | kNeedNormalMaps);
    scene.materials[0].normal_scale = 0.0F;
    EXPECT_EQ(needs_of(scene), 0U);
}

TEST(Needs, Lights) {
    Scene scene = plain_scene();
    Light light;
    light.casts_shadow = false;
    scene.lights = {light};
    EXPECT_EQ(needs_of(scene), 0U);
    scene.lights[0].casts_shadow = true;
    EXPECT_EQ(needs_of(scene), kNeedShadows);
    scene.lights[0].angular_radius_rad = 0.005F;
    EXPECT_EQ(needs_of(scene), kNeedShadows | kNeedSoftShadows);
    scene.lights[0].intensity = glm::vec3(0.0F);
    EXPECT_EQ(needs_of(scene), 0U);
    scene.lights[0] = {};
    scene.lights[0].kind = LightKind::rectangle;
    EXPECT_EQ(needs_of(scene), kNeedShadows | kNeedSoftShadows);
}

TEST(Needs, MotionAndEnvironment) {
    Scene scene = plain_scene();
    scene.instances[0].node = 0;
    EXPECT_EQ(needs_of(scene), kNeedAnimation);
    scene.instances[0].node = -1;
    TextureUse use;
    use_texel(scene, use, {255, 255, 255, 255});
    scene.environment.image = use.image;
    EXPECT_EQ(needs_of(scene), kNeedEnvironment);
}

TEST(Needs, TheReasonNamesWhoAsks) {
    Scene scene = plain_scene();
    scene.materials[0].name = "lake";
    scene.materials[0].roughness = 0.0F;
    const SceneNeeds needs = scene_needs(scene);
    const std::string text = explain(needs);
    EXPECT_NE(text.find("mirrors         yes  material 'lake'\n"), std::string::npos) << text;
    EXPECT_NE(text.find("sheen           no   no material is a fabric\n"), std::string::npos) << text;
    EXPECT_EQ(summary(needs), "mirrors");
    EXPECT_EQ(summary(scene_needs(plain_scene())), "nothing");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), kNeedCount);
}

}  // namespace
}  // namespace macula
