// Materials on single walls against what glTF 2.0 and its extensions say that they must show.

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;
using glm::vec4;

/// A wall that fills the view at tangents -1..1, u to the right and v down over 0..1.
Mesh screen() {
    return test::wall({0.0F, 0.0F, -2.0F}, 2.0F);
}

/// A 2x2 image: red, green / blue, white.
int add_four_colors(Scene& scene) {
    return test::add_image(scene, 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}, true);
}

Material pictured(int image) {
    Material material = test::unlit();
    material.base_color_texture.image = image;
    material.base_color_texture.filter = TextureFilter::nearest;
    return material;
}

const vec3 kRed(1.0F, 0.0F, 0.0F);
const vec3 kGreen(0.0F, 1.0F, 0.0F);
const vec3 kBlue(0.0F, 0.0F, 1.0F);
const vec3 kWhite(1.0F);

TEST(MaterialTexture, ImageRowZeroIsOnTop) {
    Scene scene;
    const Material material = pictured(add_four_colors(scene));
    test::add(scene, screen(), material);
    const test::Traced traced = test::trace(scene, test::square_view(8));
    EXPECT_EQ(traced.radiance(1, 1), kRed);
    EXPECT_EQ(traced.radiance(6, 1), kGreen);
    EXPECT_EQ(traced.radiance(1, 6), kBlue);
    EXPECT_EQ(traced.radiance(6, 6), kWhite);
}

TEST(MaterialTexture, LinearFilterMixesDecodedColors) {
    Scene scene;
    Material material = pictured(add_four_colors(scene));
    material.base_color_texture.filter = TextureFilter::linear;
    test::add(scene, screen(), material);
    const test::Traced traced = test::trace(scene, test::square_view(9));
    const vec3 centre = traced.radiance(4, 4);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(centre[c], 0.5F, 1e-5F);
}

TEST(MaterialTexture, SrgbImagesAreDecodedAndOthersAreNot) {
    for (const bool srgb : {false, true}) {
        Scene scene;
        const Material material = pictured(test::add_image(scene, 1, 1, {128, 128, 128, 255}, srgb));
        test::add(scene, screen(), material);
        const float expected = srgb ? std::pow((128.0F / 255.0F + 0.055F) / 1.055F, 2.4F) : 128.0F / 255.0F;
        EXPECT_NEAR(test::trace(scene, test::square_view(4)).radiance(1, 1).x, expected, 1e-6F);
    }
}

TEST(MaterialTexture, WrapModesBeyondTheImage) {
    const auto row = [](TextureWrap wrap) {
        Scene scene;
        Material material = pictured(add_four_colors(scene));
        TextureUse& use = material.base_color_texture;
        use.wrap_u = wrap;
        use.uv_scale_rotation = vec4(2.0F, 0.0F, 0.0F, 1.0F);  // u runs over -.5 .. 1.5
        use.uv_offset.x = -0.5F;
        test::add(scene, screen(), material);
        const test::Traced traced = test::trace(scene, test::square_view(8));
        return std::array{traced.radiance(0, 0), traced.radiance(2, 0), traced.radiance(5, 0), traced.radiance(7, 0)};
    };
    EXPECT_EQ(row(TextureWrap::repeat), (std::array{kGreen, kRed, kGreen, kRed}));
    EXPECT_EQ(row(TextureWrap::clamp_to_edge), (std::array{kRed, kRed, kGreen, kGreen}));
    EXPECT_EQ(row(TextureWrap::mirrored_repeat), (std::array{kRed, kRed, kGreen, kGreen}));
    // Where mirroring and clamping differ: further out.
    const auto far = [](TextureWrap wrap) {
        Scene scene;
        Material material = pictured(add_four_colors(scene));
        material.base_color_texture.wrap_u = wrap;
        material.base_color_texture.uv_offset.x = 1.0F;
        test::add(scene, screen(), material);
        const test::Traced traced = test::trace(scene, test::square_view(4));
        return std::array{traced.radiance(0, 0), traced.radiance(3, 0)};
    };
    EXPECT_EQ(far(TextureWrap::mirrored_repeat), (std::array{kGreen, kRed}));
    EXPECT_EQ(far(TextureWrap::clamp_to_edge), (std::array{kGreen, kGreen}));
}

TEST(MaterialTexture, TransformRotatesAboutTheOrigin) {
    // KHR_texture_transform's matrix for a quarter turn, shifted back into the image: u' = v, v' = 1 - u.
    Scene scene;
    Material material = pictured(add_four_colors(scene));
    material.base_color_texture.uv_scale_rotation = vec4(0.0F, -1.0F, 1.0F, 0.0F);
    material.base_color_texture.uv_offset = glm::vec2(0.0F, 1.0F);
    test::add(scene, screen(), material);
    const test::Traced traced = test::trace(scene, test::square_view(8));
    EXPECT_EQ(traced.radiance(1, 1), kBlue);
    EXPECT_EQ(traced.radiance(6, 1), kRed);
    EXPECT_EQ(traced.radiance(1, 6), kWhite);
    EXPECT_EQ(traced.radiance(6, 6), kGreen);
}

TEST(MaterialTexture, SecondCoordinateSet) {
    Scene scene;
    Material material = pictured(add_four_colors(scene));
    material.base_color_texture.uv_set = 1;
    Mesh mesh = screen();
    mesh.uv1.assign(4, glm::vec2(0.25F, 0.75F));
    test::add(scene, std::move(mesh), material);
    EXPECT_EQ(test::trace(scene, test::square_view(4)).radiance(3, 0), kBlue);
}

TEST(Material, UnlitShowsItsColourAndNoLight) {
    Scene scene;
    scene.lights.emplace_back();
    scene.ambient_radiance = vec3(1.0F);
    Material material = test::unlit({0.25F, 0.5F, 0.75F, 1.0F});
    material.emissive = vec3(1.0F);
    test::add(scene, screen(), material);
    EXPECT_EQ(test::trace(scene, test::square_view(4)).radiance(1, 2), vec3(0.25F, 0.5F, 0.75F));
}

TEST(Material, VertexColoursMultiplyAndInterpolate) {
    Scene scene;
    Mesh mesh = screen();
    mesh.color = {vec4(1, 0, 0, 1), vec4(1, 0, 0, 1), vec4(0, 0, 1, 1), vec4(0, 0, 1, 1)};  // left red, right blue
    test::add(scene, std::move(mesh), test::unlit({0.5F, 1.0F, 1.0F, 1.0F}));
    const test::Traced traced = test::trace(scene, test::square_view(64));
    for (const int x : {0, 20, 63}) {
        const float u = (static_cast<float>(x) + 0.5F) / 64.0F;
        EXPECT_NEAR(traced.radiance(x, 30).x, 0.5F * (1.0F - u), 1e-5F);
        EXPECT_NEAR(traced.radiance(x, 30).z, u, 1e-5F);
    }
}

TEST(Material, EmissionAddsItsTexture) {
    Scene scene;
    Material material = test::white();
    material.base_color = vec4(0.0F, 0.0F, 0.0F, 1.0F);
    material.emissive = vec3(4.0F, 2.0F, 1.0F);
    material.emissive_texture.image = add_four_colors(scene);
    material.emissive_texture.filter = TextureFilter::nearest;
    test::add(scene, screen(), material);
    const test::Traced traced = test::trace(scene, test::square_view(8));
    EXPECT_EQ(traced.radiance(1, 1), vec3(4.0F, 0.0F, 0.0F));
    EXPECT_EQ(traced.radiance(6, 6), vec3(4.0F, 2.0F, 1.0F));
}

TEST(Material, MetallicRoughnessTextureReadsGreenAndBlue) {
    // A smooth metal in uniform light shows its base colour, a dielectric 4 % + 96 % of it.
    const auto radiance = [](std::uint8_t blue) {
        Scene scene;
        scene.ambient_radiance = vec3(1.0F);
        scene.background_radiance = vec3(1.0F);
        Material material = test::white();
        material.base_color = vec4(0.0F, 0.5F, 0.0F, 1.0F);
        material.metallic = 1.0F;
        material.metallic_roughness_texture.image = test::add_image(scene, 1, 1, {7, 10, blue, 255});
        test::add(scene, screen(), material);
        return test::trace(scene, test::square_view(4)).radiance(2, 2);
    };
    EXPECT_NEAR(radiance(255).x, 0.0F, 1e-3F);
    EXPECT_NEAR(radiance(255).y, 0.5F, 5e-3F);
    EXPECT_NEAR(radiance(0).x, 0.04F, 1e-3F);
    EXPECT_NEAR(radiance(0).y, 0.04F + 0.48F, 5e-3F);

    // Green is the roughness: the highlight of a light beside the eye is brighter on a smooth surface.
    const auto highlight = [](std::uint8_t green) {
        Scene scene;
        scene.lights.emplace_back();  // shines along -Z
        Material material = test::white();
        material.metallic = 1.0F;
        material.metallic_roughness_texture.image = test::add_image(scene, 1, 1, {7, green, 255, 255});
        test::add(scene, screen(), material);
        return test::trace(scene, test::square_view(5)).radiance(2, 2).x;
    };
    EXPECT_GT(highlight(64), 4.0F * highlight(255));
}

/// Radiance of a wall with a one-texel normal map, lit from `to_light`.
float mapped(const std::array<std::uint8_t, 3>& texel, const vec3& to_light, const glm::mat4& place = glm::mat4(1.0F),
             float scale = 1.0F) {
    Scene scene;
    Light sun;
    sun.direction = -glm::normalize(to_light);
    scene.lights.push_back(sun);
    Material material = test::white();
    material.normal_scale = scale;
    material.normal_texture.image = test::add_image(scene, 1, 1, {texel[0], texel[1], texel[2], 255});
    material.double_sided = true;
    Mesh mesh = screen();
    mesh.tangent.assign(4, vec4(1.0F, 0.0F, 0.0F, 1.0F));  // towards +u; the bitangent +Y is -v, as glTF has it
    test::add(scene, std::move(mesh), material, place);
    return test::trace(scene, test::square_view(5)).radiance(2, 2).x;
}

TEST(NormalMap, FlatTexelChangesNothing) {
    Scene scene;
    scene.lights.emplace_back();
    test::add(scene, screen(), test::white());
    const float plain = test::trace(scene, test::square_view(5)).radiance(2, 2).x;
    EXPECT_NEAR(mapped({128, 128, 255}, {0.0F, 0.0F, 1.0F}), plain, 2e-3F * plain);
}

TEST(NormalMap, RedLeansTowardsTheTangentAndGreenTowardsTheBitangent) {
    const vec3 right(1.0F, 0.0F, 1.0F);
    const vec3 up(0.0F, 1.0F, 1.0F);
    const vec3 left(-1.0F, 0.0F, 1.0F);
    const vec3 down(0.0F, -1.0F, 1.0F);
    const std::array<std::uint8_t, 3> red{220, 128, 220};
    const std::array<std::uint8_t, 3> green{128, 220, 220};
    EXPECT_GT(mapped(red, right), 2.0F * mapped(red, left));
    EXPECT_NEAR(mapped(red, up), mapped(red, down), 0.02F);
    EXPECT_GT(mapped(green, up), 2.0F * mapped(green, down));
    EXPECT_NEAR(mapped(green, right), mapped(green, left), 0.02F);
    // Scale zero flattens.
    const glm::mat4 here(1.0F);
    EXPECT_NEAR(mapped(red, right, here, 0.0F), mapped(red, left, here, 0.0F), 1e-3F);
}

TEST(NormalMap, TurnsWithTheInstanceAndItsMirrorImage) {
    const std::array<std::uint8_t, 3> red{220, 128, 220};
    const std::array<std::uint8_t, 3> green{128, 220, 220};
    const vec3 right(1.0F, 0.0F, 1.0F);
    const vec3 up(0.0F, 1.0F, 1.0F);
    const vec3 left(-1.0F, 0.0F, 1.0F);
    const glm::mat4 quarter = glm::rotate(glm::mat4(1.0F), glm::radians(90.0F), vec3(0.0F, 0.0F, 1.0F));
    EXPECT_NEAR(mapped(red, up, quarter), mapped(red, right), 1e-3F);
    const glm::mat4 mirror = glm::scale(glm::mat4(1.0F), vec3(-1.0F, 1.0F, 1.0F));
    EXPECT_NEAR(mapped(red, left, mirror), mapped(red, right), 1e-3F);
    EXPECT_NEAR(mapped(green, up, mirror), mapped(green, up), 1e-3F);
}

TEST(AlphaMask, CutsHolesForEyesAndForLight) {
    Scene scene;
    Light sun;
    sun.direction = glm::normalize(vec3(0.0F, 0.0F, -1.0F));
    scene.lights.push_back(sun);
    // A mask whose left half is a hole, 1 m before a wall.
    Material mask = test::unlit({1, 0, 0, 1});
    mask.alpha_mode = AlphaMode::mask;
    mask.double_sided = true;
    mask.base_color_texture.image = test::add_image(scene, 2, 1, {255, 255, 255, 0, 255, 255, 255, 255});
    mask.base_color_texture.filter = TextureFilter::nearest;
    const std::uint32_t masked = test::add(scene, test::wall({0.0F, 0.0F, -1.0F}, 0.5F), mask);
    const std::uint32_t back = test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 3.0F), test::white());
    const test::Traced traced = test::trace(scene, test::square_view(64));
    EXPECT_EQ(traced.object(40, 32), masked);
    EXPECT_EQ(traced.object(24, 32), back);  // through the hole
    // Seen past the mask's left edge, the wall at x = -.4 (hole) is lit and at x = .4 it would be shaded.
    const auto column = [](float wall_x) { return static_cast<int>((wall_x / 2.0F + 1.0F) / 2.0F * 64.0F); };
    EXPECT_GT(traced.radiance(column(-0.4F), 32).x, 0.0F);
    const test::Traced aside = test::trace(scene, test::square_view(64, {2.0F, 0.0F, 0.0F}));
    EXPECT_EQ(aside.object(column(-1.6F), 32), back);
    EXPECT_EQ(aside.radiance(column(-1.6F), 32), vec3(0.0F));  // x = .4, in the mask's shadow
    EXPECT_GT(aside.radiance(column(-1.2F), 32).x, 0.0F);      // x = .8, beside it
}

TEST(AlphaMask, CutoffAndFactorsDecide) {
    const auto object_at = [](float factor, float cutoff) {
        Scene scene;
        Material material = test::unlit({1, 1, 1, factor});
        material.alpha_mode = AlphaMode::mask;
        material.alpha_cutoff = cutoff;
        test::add(scene, screen(), material);
        return test::trace(scene, test::square_view(4)).object(1, 1);
    };
    EXPECT_EQ(object_at(0.5F, 0.4F), 1U);
    EXPECT_EQ(object_at(0.5F, 0.5F), 1U);
    EXPECT_EQ(object_at(0.5F, 0.6F), 0U);
}

TEST(Sides, SingleSidedBacksAreInvisible) {
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -2.0F)), glm::radians(180.0F),
                                         vec3(0.0F, 1.0F, 0.0F));
    for (const bool double_sided : {false, true}) {
        for (const bool back : {false, true}) {
            for (const bool masked : {false, true}) {
                Scene scene;
                Material material = test::unlit();
                material.double_sided = double_sided;
                material.alpha_mode = masked ? AlphaMode::mask : AlphaMode::opaque;
                const glm::mat4 ahead = glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -2.0F));
                const auto object = test::add(scene, test::wall(vec3(0.0F), 4.0F), material, back ? turned : ahead);
                EXPECT_EQ(test::trace(scene, test::square_view(4)).object(1, 2), back && !double_sided ? 0U : object);
            }
        }
    }
}

TEST(Sides, BothSidesOfAnySurfaceCastShadows) {
    for (const bool double_sided : {false, true}) {
        for (const bool back : {false, true}) {
            Scene scene;
            scene.lights.emplace_back();  // shines along -Z
            test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 8.0F), test::white());
            Material material = test::white();
            material.double_sided = double_sided;
            // Behind the eye, between the wall and the light.
            const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, 1.0F)),
                                                 glm::radians(back ? 0.0F : 180.0F), vec3(0.0F, 1.0F, 0.0F));
            test::add(scene, test::wall(vec3(0.0F), 8.0F), material, turned);
            EXPECT_EQ(test::trace(scene, test::square_view(4)).radiance(1, 2).x, 0.0F);
        }
    }
}

TEST(Sides, BacksOfDoubleSidedSurfacesAreLitFromTheirSide) {
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -2.0F)), glm::radians(180.0F),
                                         vec3(0.0F, 1.0F, 0.0F));
    Scene scene;
    scene.lights.emplace_back();
    Material material = test::white();
    material.double_sided = true;
    test::add(scene, test::wall(vec3(0.0F), 4.0F), material, turned);
    Scene front;
    front.lights.emplace_back();
    test::add(front, test::wall({0.0F, 0.0F, -2.0F}, 4.0F), material);
    const float back_radiance = test::trace(scene, test::square_view(4)).radiance(1, 2).x;
    EXPECT_NEAR(back_radiance, test::trace(front, test::square_view(4)).radiance(1, 2).x, 1e-6F);
    EXPECT_GT(back_radiance, 0.1F);
}

}  // namespace
}  // namespace macula
