#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "scenes/framing.h"
#include "scenes/load.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

constexpr const char* kBalloon = MACULA_SOURCE_DIR "/../shared/scenes/balloon/scene.gltf";

TEST(GltfBalloon, AFileFromTheWild) {
    if (!std::filesystem::exists(kBalloon)) GTEST_SKIP() << kBalloon << " is not here";
    const Expected<LoadedScene> loaded = load_scene(kBalloon);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings.front();
    const Scene& scene = *loaded->scene;
    EXPECT_EQ(scene_defect(scene), "");

    // Counted in the file's JSON: sum of the index counts / 3, meshes, materials, images.
    EXPECT_EQ(scene.triangle_count(), 35698U);
    EXPECT_EQ(scene.instances.size(), 37U);
    EXPECT_EQ(scene.materials.size(), 37U);
    EXPECT_EQ(scene.images.size(), 17U);
    EXPECT_TRUE(std::all_of(scene.images.begin(), scene.images.end(), [](const TextureImage& i) { return i.srgb; }));
    EXPECT_TRUE(std::all_of(scene.materials.begin(), scene.materials.end(),
                            [](const Material& m) { return m.double_sided && m.roughness <= 1.0F; }));
    const auto nearest = std::find_if(scene.materials.begin(), scene.materials.end(),
                                      [](const Material& m) { return m.name == "material_15"; });
    ASSERT_NE(nearest, scene.materials.end());
    EXPECT_EQ(nearest->base_color_texture.filter, TextureFilter::nearest);
    EXPECT_EQ(nearest->base_color_texture.wrap_u, TextureWrap::mirrored_repeat);
    EXPECT_EQ(nearest->base_color_texture.wrap_v, TextureWrap::repeat);
    EXPECT_EQ(nearest->metallic, 1.0F) << "glTF's default";

    // The root turns z up into y up, after the second node has moved the mesh box by (-.141, -.292, .213).
    const Bounds bounds = world_bounds(scene);
    EXPECT_NEAR(bounds.low.x, -0.14143F, 1e-4F);
    EXPECT_NEAR(bounds.high.x, 0.57983F - 0.14143F, 1e-4F);
    EXPECT_NEAR(bounds.low.y, 0.21339F, 1e-4F);
    EXPECT_NEAR(bounds.high.y, 0.69471F + 0.21339F, 1e-4F);
    EXPECT_NEAR(bounds.low.z, -(0.57776F - 0.29178F), 1e-4F);
    EXPECT_NEAR(bounds.high.z, 0.29178F, 1e-4F);
    EXPECT_GT(scene.world_from_start.position_m.z, bounds.high.z) << "seen from the front";
}

}  // namespace
}  // namespace macula
