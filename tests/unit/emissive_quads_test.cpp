#include "scenes/emissive_quads.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/shapes.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

constexpr glm::vec3 kRight(2, 0, 0);
constexpr glm::vec3 kDown(0, 0, 1);  // of a quad that faces up

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5F) << i;
}

/// One quad of 2 x 1 m that faces up, its middle at the origin, with radiance 5.
Scene lamp() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].emissive = glm::vec3(5.0F);
    scene.meshes = {make_quad({-1, 0, -0.5F}, kRight, kDown)};
    scene.instances.resize(1);
    return scene;
}

/// Adds an instance of the lamp's mesh.
void add(Scene& scene, const glm::mat4& world_from_mesh) {
    Instance instance;
    instance.world_from_mesh = world_from_mesh;
    scene.instances.push_back(instance);
}

TEST(EmissiveQuads, AQuadBecomesARectangle) {
    Scene scene = lamp();
    scene.instances[0].world_from_mesh = glm::translate(glm::mat4(1.0F), {1, 2, 3});
    scene.instances[0].node = -1;
    add_emissive_quads(scene);
    EXPECT_EQ(scene_defect(scene), "");
    ASSERT_EQ(scene.lights.size(), 1U);
    const Light& light = scene.lights[0];
    EXPECT_EQ(light.kind, LightKind::rectangle);
    expect_near(light.position_m, {1, 2, 3});
    expect_near(light.direction, {0, 1, 0});
    EXPECT_NEAR(glm::length(light.half_u_m) * glm::length(light.half_v_m), 0.5F, 1e-6F) << "a quarter of 2 m2";
    expect_near(glm::normalize(glm::cross(light.half_u_m, light.half_v_m)), {0, 1, 0});
    EXPECT_EQ(light.intensity, glm::vec3(5.0F));
    EXPECT_EQ(light.instance, 0);
}

TEST(EmissiveQuads, EveryWayToCutAQuad) {
    // Both diagonals, each triangle begun at each corner, with shared corners and with corners of their own.
    const std::array<glm::vec3, 4> corners = {glm::vec3(-1, 0, 0.5F), glm::vec3(1, 0, 0.5F), glm::vec3(1, 0, -0.5F),
                                              glm::vec3(-1, 0, -0.5F)};
    for (unsigned diagonal = 0; diagonal < 2; ++diagonal)
        for (int start = 0; start < 9; ++start)
            for (const bool shared : {true, false}) {
                std::array<glm::uvec3, 2> triangles = {glm::uvec3(diagonal, diagonal + 1, diagonal + 2),
                                                       glm::uvec3(diagonal, diagonal + 2, (diagonal + 3) % 4)};
                const auto begun_at = [](const glm::uvec3& t, int i) {
                    return glm::uvec3(t[i % 3], t[(i + 1) % 3], t[(i + 2) % 3]);
                };
                triangles = {begun_at(triangles[0], start % 3), begun_at(triangles[1], start / 3)};
                Mesh mesh;
                for (const glm::uvec3& triangle : triangles)
                    for (int c = 0; c < 3; ++c) mesh.position_m.push_back(corners[triangle[c] % 4]);
                mesh.triangle = {{0, 1, 2}, {3, 4, 5}};
                if (shared) {
                    mesh.position_m.assign(corners.begin(), corners.end());
                    mesh.triangle.clear();
                    for (const glm::uvec3& t : triangles) mesh.triangle.emplace_back(t.x % 4, t.y % 4, t.z % 4);
                }
                const std::optional<MeshQuad> found = mesh_quad(mesh);
                ASSERT_TRUE(found) << diagonal << " " << start;
                expect_near(found->center, {0, 0, 0});
                expect_near(glm::cross(found->half_u, found->half_v), {0, 0.5F, 0});
            }
}

TEST(EmissiveQuads, OtherMeshesAreNone) {
    Mesh mesh = lamp().meshes[0];
    mesh.triangle.pop_back();
    EXPECT_FALSE(mesh_quad(mesh)) << "one triangle";
    mesh = lamp().meshes[0];
    mesh.position_m[mesh.triangle[0].x] += glm::vec3(0.1F, 0, 0);
    EXPECT_FALSE(mesh_quad(mesh)) << "a trapezium";
    mesh = lamp().meshes[0];
    std::swap(mesh.triangle[1].x, mesh.triangle[1].y);
    EXPECT_FALSE(mesh_quad(mesh)) << "one half faces down";
    mesh = lamp().meshes[0];
    for (int c = 0; c < 3; ++c) {
        mesh.position_m.push_back(mesh.position_m[mesh.triangle[1][c]] + glm::vec3(0, 1, 0));
        mesh.triangle[1][c] = static_cast<unsigned>(mesh.position_m.size()) - 1;
    }
    EXPECT_FALSE(mesh_quad(mesh)) << "two triangles apart";
    EXPECT_FALSE(mesh_quad(make_box(glm::vec3(1.0F))));
}

TEST(EmissiveQuads, OnlyOpaqueMaterialsThatEmit) {
    for (int i = 0; i < 4; ++i) {
        Scene scene = lamp();
        Material& material = scene.materials[0];
        if (i == 0) material.emissive = glm::vec3(0.0F);
        if (i == 1) material.unlit = true;
        if (i == 2) material.alpha_mode = AlphaMode::blend;
        if (i == 3) material.alpha_mode = AlphaMode::mask;
        add_emissive_quads(scene);
        EXPECT_TRUE(scene.lights.empty()) << i;
    }
}

TEST(EmissiveQuads, DoubleSidedOnesShineBothWays) {
    Scene scene = lamp();
    scene.materials[0].double_sided = true;
    add_emissive_quads(scene);
    EXPECT_EQ(scene_defect(scene), "");
    ASSERT_EQ(scene.lights.size(), 2U);
    expect_near(scene.lights[0].direction, {0, 1, 0});
    expect_near(scene.lights[1].direction, {0, -1, 0});
    EXPECT_EQ(scene.lights[1].instance, 0);
}

TEST(EmissiveQuads, AMirrorDoesNotTurnTheFront) {
    Scene scene = lamp();
    scene.instances[0].world_from_mesh = glm::scale(glm::mat4(1.0F), {-1, 1, 1});
    add_emissive_quads(scene);
    EXPECT_EQ(scene_defect(scene), "");
    expect_near(scene.lights.at(0).direction, {0, 1, 0});
    scene = lamp();
    scene.instances[0].world_from_mesh = glm::scale(glm::mat4(1.0F), {1, -1, 1});
    add_emissive_quads(scene);
    expect_near(scene.lights.at(0).direction, {0, -1, 0});
}

TEST(EmissiveQuads, TheStrongestAreTaken) {
    Scene scene = lamp();
    for (int i = 1; i < 20; ++i) {  // larger and larger
        glm::mat4 m = glm::translate(glm::mat4(1.0F), {0, 0.1F * static_cast<float>(i), 0});
        add(scene, glm::scale(m, glm::vec3(1.0F + 0.1F * static_cast<float>(i))));
    }
    add_emissive_quads(scene);
    ASSERT_EQ(scene.lights.size(), kMostEmissiveRectangles);
    for (std::size_t i = 0; i < kMostEmissiveRectangles; ++i)
        EXPECT_EQ(scene.lights[i].instance, 19 - static_cast<int>(i));
}

TEST(EmissiveQuads, TheWeakOnesGlow) {
    Scene scene = lamp();
    add(scene, glm::scale(glm::mat4(1.0F), glm::vec3(0.09F)));  // less than a hundredth of the area
    add(scene, glm::scale(glm::mat4(1.0F), glm::vec3(0.11F)));
    add_emissive_quads(scene);
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.lights[1].instance, 2);

    // In a scene of 2 km a lamp of 10 W / sr lights nothing that anyone sees from afar.
    scene = lamp();
    scene.materials.resize(2);
    scene.meshes.push_back(make_quad({-1000, -1, -1000}, {2000, 0, 0}, {0, 0, 2000}));
    scene.meshes[1].material = 1;
    add(scene, glm::mat4(1.0F));
    scene.instances[1].mesh = 1;
    add_emissive_quads(scene);
    EXPECT_TRUE(scene.lights.empty());
}

TEST(EmissiveQuads, ATextureCountsWithItsMean) {
    Scene scene = lamp();
    Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.uv0.size(), 4U);
    TextureImage image;
    image.width_px = 4;
    image.height_px = 1;
    image.channels = 1;
    image.texels = {255, 0, 51, 51};
    scene.images = {image};
    TextureUse& use = scene.materials[0].emissive_texture;
    use.image = 0;
    add_emissive_quads(scene);
    EXPECT_NEAR(scene.lights.at(0).intensity.r, 5.0F * 0.35F, 1e-4F);

    use.uv_scale_rotation.x = 0.5F;  // the left half only
    scene.lights.clear();
    add_emissive_quads(scene);
    EXPECT_NEAR(scene.lights.at(0).intensity.r, 5.0F * 0.5F, 1e-4F);

    use.uv_scale_rotation.x = 2.0F;  // beyond the right edge: its texel again and again
    use.wrap_u = TextureWrap::clamp_to_edge;
    scene.lights.clear();
    add_emissive_quads(scene);
    EXPECT_NEAR(scene.lights.at(0).intensity.r, 5.0F * 0.5F * (0.35F + 0.2F), 1e-4F);

    use.wrap_u = TextureWrap::mirrored_repeat;
    scene.lights.clear();
    add_emissive_quads(scene);
    EXPECT_NEAR(scene.lights.at(0).intensity.r, 5.0F * 0.35F, 1e-4F);

    scene.images[0].srgb = true;
    scene.images[0].texels = {188, 188, 188, 188};  // half of full light
    scene.lights.clear();
    add_emissive_quads(scene);
    EXPECT_NEAR(scene.lights.at(0).intensity.r, 5.0F * 0.5029F, 1e-3F);
}

/// A glTF file of one emissive square of 1 m.
GltfBuilder gltf_lamp(double strength) {
    GltfBuilder b = GltfBuilder::triangle();
    b.json["extensionsUsed"] = {"KHR_materials_emissive_strength"};
    b.primitive()["attributes"]["POSITION"] = b.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    b.primitive()["indices"] = b.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 2, 1, 3});
    b.primitive()["material"] = 0;
    b.json["materials"] = {{{"emissiveFactor", {1, 1, 1}},
                            {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}}};
    return b;
}

TEST(EmissiveQuads, GltfFilesAreLitByThem) {
    GltfBuilder b = gltf_lamp(3.0);
    // Something that is lit: a square a metre in front of the lamp.
    b.json["meshes"].push_back(b.json["meshes"][0]);
    b.json["meshes"][1]["primitives"][0].erase("material");
    b.json["nodes"].push_back({{"mesh", 1}, {"translation", {0, 0, 1}}});
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(scene_defect(*loaded->scene), "");
    ASSERT_EQ(loaded->scene->lights.size(), 1U) << "no sun where a lamp is";
    EXPECT_EQ(loaded->scene->lights[0].kind, LightKind::rectangle);
    EXPECT_EQ(loaded->scene->lights[0].intensity, glm::vec3(3.0F)) << "not metered: it lights as it is seen";
    EXPECT_EQ(loaded->scene->background_radiance, glm::vec3(0.0F));
}

TEST(EmissiveQuads, AWeakLampDoesNotReplaceTheSun) {
    const Expected<LoadedScene> loaded = gltf_lamp(0.1).load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->scene->lights.size(), 2U);
    EXPECT_EQ(loaded->scene->lights[0].kind, LightKind::rectangle);
    EXPECT_EQ(loaded->scene->lights[1].kind, LightKind::directional);
}

TEST(EmissiveQuads, TheyMoveWithTheirInstance) {
    GltfBuilder b = gltf_lamp(3.0);
    b.json["animations"] = {{{"samplers",
                              {{{"input", b.accessor<float>("SCALAR", {0, 1})},
                                {"output", b.accessor<float>("VEC3", {0, 1, 0, 0, 2, 0})}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Light& light = loaded->scene->lights.at(0);
    EXPECT_EQ(light.kind, LightKind::rectangle);
    EXPECT_EQ(light.node, loaded->scene->instances[0].node);
    EXPECT_GE(light.node, 0);
    expect_near(light.position_m, {0.5F, 1.5F, 0});
}

}  // namespace
}  // namespace macula
