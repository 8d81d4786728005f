#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "scenes/bunny_box.h"
#include "scenes/framing.h"
#include "scenes/mesh_edit.h"
#include "scenes/obj.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

const Instance& find(const Scene& scene, const std::string& name) {
    for (const Instance& instance : scene.instances)
        if (instance.name == name) return instance;
    throw std::runtime_error("no instance " + name);
}

Bounds bounds_of(const Scene& scene, const Instance& instance) {
    Bounds bounds;
    for (const glm::vec3& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].position_m)
        bounds.add(glm::vec3(instance.world_from_mesh * glm::vec4(p, 1.0F)));
    return bounds;
}

TEST(BunnyBox, IsAWholeScene) {
    const LoadedScene loaded = make_bunny_box();
    const Scene& scene = *loaded.scene;
    EXPECT_EQ(scene_defect(scene), "");
    EXPECT_EQ(scene.name, "bunny-box");
    const Bounds room = world_bounds(scene);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(room.size()[i], i == 1 ? 4.0F : 6.0F, 1e-4F);
    std::set<std::string> names;
    for (const Instance& instance : scene.instances) EXPECT_TRUE(names.insert(instance.name).second) << instance.name;
    std::set<int> meshes;
    for (const Instance& instance : scene.instances) meshes.insert(instance.mesh);
    EXPECT_EQ(meshes.size(), scene.meshes.size()) << "no mesh is unused";
    std::set<int> images;
    for (const Material& material : scene.materials)
        if (material.base_color_texture.present()) images.insert(material.base_color_texture.image);
    EXPECT_EQ(images.size(), scene.images.size()) << "no image is unused";
    std::size_t texture_bytes = 0;
    for (const TextureImage& image : scene.images) texture_bytes += image.texels.size();
    EXPECT_LT(texture_bytes, 64U << 20U);
    EXPECT_GE(scene.lights.size(), 2U);
}

TEST(BunnyBox, TheSessionStartsInTheRoomAndFacesTheBunny) {
    const LoadedScene loaded = make_bunny_box();
    const Scene& scene = *loaded.scene;
    const glm::vec3 eye = scene.world_from_start.position_m;
    EXPECT_FLOAT_EQ(eye.y, 1.6F);
    const Bounds bunny = bounds_of(scene, find(scene, "bunny"));
    const glm::vec3 forward = scene.world_from_start.direction({0, 0, -1});
    EXPECT_GT(glm::dot(glm::normalize(bunny.middle() - eye), forward), 0.99F);
    EXPECT_GT(glm::length(bunny.middle() - eye), 1.5F);
    EXPECT_NEAR(bunny.low.y, bounds_of(scene, find(scene, "pedestal plate")).high.y, 1e-4F) << "it stands on the plate";
    for (const Instance& instance : scene.instances) {
        const Bounds bounds = bounds_of(scene, instance);
        const glm::vec3 nearest = glm::clamp(eye, bounds.low, bounds.high);
        EXPECT_GT(glm::length(nearest - eye), 3.0F * scene.near_m) << instance.name << " is in the viewer's face";
    }
}

TEST(BunnyBox, TheMirrorIsPlaneAndFacesTheViewer) {
    const LoadedScene loaded = make_bunny_box();
    const Scene& scene = *loaded.scene;
    const Instance& mirror = find(scene, "mirror");
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(mirror.mesh)];
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    EXPECT_EQ(material.metallic, 1.0F);
    EXPECT_EQ(material.roughness, 0.0F);
    const Bounds bounds = bounds_of(scene, mirror);
    EXPECT_EQ(bounds.size().z, 0.0F);
    EXPECT_GT(bounds.size().x * bounds.size().y, 2.0F);
    for (const glm::vec3& n : mesh.normal) EXPECT_EQ(n, glm::vec3(0.0F, 0.0F, 1.0F));
    EXPECT_LT(bounds.high.z, scene.world_from_start.position_m.z);
}

TEST(BunnyBox, TheGlassBallIsClosedAndLiesOnItsRing) {
    const LoadedScene loaded = make_bunny_box();
    const Scene& scene = *loaded.scene;
    const Instance& ball = find(scene, "glass ball");
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(ball.mesh)];
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    EXPECT_EQ(material.transmission, 1.0F);
    EXPECT_GT(material.thickness_m, 0.0F);
    EXPECT_TRUE(is_closed(mesh));
    for (std::size_t i = 0; i < mesh.normal.size(); ++i)
        EXPECT_GT(glm::dot(mesh.normal[i], mesh.position_m[i]), 0.0F) << "normals look out";
    double volume = 0.0;  // by the divergence theorem: positive where the corners turn counter-clockwise outside
    for (const glm::uvec3& t : mesh.triangle)
        volume += glm::dot(glm::dvec3(mesh.position_m[t.x]),
                           glm::cross(glm::dvec3(mesh.position_m[t.y]), glm::dvec3(mesh.position_m[t.z]))) /
                  6.0;
    EXPECT_NEAR(volume, 4.0 / 3.0 * 3.14159265 * 0.008, 1e-4);
    Mesh open = mesh;
    open.triangle.pop_back();
    EXPECT_FALSE(is_closed(open)) << "the test finds a hole";
    const Bounds bounds = bounds_of(scene, ball);
    const Bounds ring = bounds_of(scene, find(scene, "ring under the glass ball"));
    EXPECT_NEAR(ring.low.y, bounds_of(scene, find(scene, "marble cylinder")).high.y, 1e-4F);
    EXPECT_GT(bounds.low.y, ring.low.y) << "it does not reach into the cylinder";
    EXPECT_LT(bounds.low.y, ring.high.y) << "it lies in the ring";
}

TEST(BunnyBox, TheBunnyIsStanfords) {
    if (!std::filesystem::exists(kBunnyPath)) GTEST_SKIP() << kBunnyPath << " is not here: install glmark2-data";
    const LoadedScene loaded = make_bunny_box();
    EXPECT_TRUE(loaded.warnings.empty());
    const Mesh& mesh = loaded.scene->meshes[static_cast<std::size_t>(find(*loaded.scene, "bunny").mesh)];
    EXPECT_EQ(mesh.position_m.size(), 34835U);
    EXPECT_EQ(mesh.triangle.size(), 69666U);
}

TEST(BunnyBox, AStandInForAMissingBunny) {
    const LoadedScene loaded = make_bunny_box("/nowhere/bunny.obj");
    EXPECT_EQ(scene_defect(*loaded.scene), "");
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("/nowhere/bunny.obj"), std::string::npos);
    EXPECT_NE(loaded.warnings[0].find("glmark2-data"), std::string::npos);
    EXPECT_GT(loaded.scene->meshes[static_cast<std::size_t>(find(*loaded.scene, "bunny").mesh)].triangle.size(), 1000U);
}

/// Writes text to a file that goes away with the test.
class ObjFile : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "macula-obj-XXXXXX").string();
        ASSERT_TRUE(mkdtemp(pattern.data()));
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    Expected<Mesh> read(const std::string& text) {
        const std::string path = (folder_ / "test.obj").string();
        std::ofstream(path) << text;
        return read_obj(path);
    }
    std::filesystem::path folder_;
};

TEST_F(ObjFile, CornersOfEveryForm) {
    const std::string vertices =
        "# comment\r\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvn 0 0 2\no name\n";
    const Expected<Mesh> quad = read(vertices + "f 1/1/1 2/2/1 3/2/1 4/1/1\n");
    ASSERT_TRUE(quad) << quad.error().message;
    EXPECT_EQ(quad->triangle, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(quad->uv0.size(), 4U);
    EXPECT_EQ(quad->normal[0], glm::vec3(0, 0, 1)) << "made unit";

    const Expected<Mesh> back = read(vertices + "f -4 -3 -2\nf -4//1 3 4\n");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->triangle.size(), 2U);
    EXPECT_TRUE(back->uv0.empty());
    EXPECT_EQ(back->normal[0], glm::vec3(0, 0, 1)) << "smooth where some are missing";
}

TEST_F(ObjFile, DefectsAreNamedWithTheirLine) {
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {three + "f 1 2 4\n", "line 4: a face names a vertex that does not exist"},
        {three + "f 1 2 0\n", "line 4"},
        {three + "f -4 2 1\n", "line 4"},
        {three + "f 1/1 2/1 3/1\n", "line 4"},
        {three + "f 99999999999 2 1\n", "line 4"},
        {three + "f 1 2\n", "line 4: a face needs three corners"},
        {"v 0 0\n", "line 1: a vertex needs three finite numbers"},
        {"v 0 0 nan\n", "line 1"},
        {"v 0 0 1x\n", "line 1"},
        {"v 0 0 1e99\n", "line 1"},
        {"vn 0 0\n", "line 1: a normal"},
        {"vt 0\n", "line 1: a texture coordinate"},
        {three, "contains no triangles"},
        {"", "contains no triangles"},
    };
    for (const auto& [text, message] : cases) {
        const Expected<Mesh> mesh = read(text);
        ASSERT_FALSE(mesh) << text;
        EXPECT_EQ(mesh.error().code, ErrorCode::input_file);
        EXPECT_NE(mesh.error().message.find(message), std::string::npos) << mesh.error().message;
        EXPECT_NE(mesh.error().message.find("test.obj"), std::string::npos);
    }
}

}  // namespace
}  // namespace macula
