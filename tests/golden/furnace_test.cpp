// A furnace: in light from everywhere a white surface is as bright as the light, whatever its shape.

#include <gtest/gtest.h>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

void expect_furnace(const Scene& scene, const EyeView& view, std::uint32_t object) {
    const test::Traced traced = test::trace(scene, view);
    for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) {
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(traced.radiance(x, y)[c], 1.0F, 1e-3F) << x << ", " << y;
            ASSERT_EQ(traced.color(x, y), 0xFFFFFFFFU);
            if (object != 0) {
                ASSERT_EQ(traced.object(x, y), object);
            }
        }
    }
}

Material double_sided_white(float metallic) {
    Material material = test::white();
    material.metallic = metallic;
    material.double_sided = true;
    return material;
}

TEST(Furnace, InsideAWhiteSphereEverythingIsOne) {
    for (const float metallic : {0.0F, 0.5F, 1.0F}) {
        Scene scene;
        scene.ambient_radiance = glm::vec3(1.0F);
        const std::uint32_t sphere = test::add(scene, make_sphere(3.0F), double_sided_white(metallic));
        expect_furnace(scene, test::square_view(96, {0.3F, -0.2F, 0.5F}), sphere);
    }
}

TEST(Furnace, InsideAClosedWhiteRoomEverythingIsOne) {
    Scene scene;
    scene.ambient_radiance = glm::vec3(1.0F);
    const std::uint32_t room = test::add(scene, make_box({4.0F, 3.0F, 5.0F}), double_sided_white(0.0F));
    expect_furnace(scene, test::square_view(96, {0.5F, 1.2F, 0.1F}), room);
}

TEST(Furnace, AWhiteBallVanishesInWhiteSurroundings) {
    Scene scene;
    scene.ambient_radiance = glm::vec3(1.0F);
    scene.background_radiance = glm::vec3(1.0F);
    test::add(scene, make_sphere(1.0F), test::white());
    expect_furnace(scene, test::square_view(96, {0.0F, 0.0F, 2.0F}), 0);
}

TEST(Furnace, ASmoothMetalBallReflectsItsColor) {
    Scene scene;
    scene.ambient_radiance = glm::vec3(2.0F);
    scene.background_radiance = glm::vec3(2.0F);
    Material metal = test::white();
    metal.base_color = glm::vec4(0.5F, 0.25F, 0.125F, 1.0F);
    metal.metallic = 1.0F;
    metal.roughness = 0.0F;
    test::add(scene, make_sphere(1.0F), metal);
    const test::Traced traced = test::trace(scene, test::square_view(33, {0.0F, 0.0F, 2.0F}));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(traced.radiance(16, 16)[c], 2.0F * metal.base_color[c], 5e-3F);
}

}  // namespace
}  // namespace macula
