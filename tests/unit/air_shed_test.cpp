#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scenes/air_shed.h"
#include "scenes/air_shed_lamps.h"
#include "scenes/air_shed_materials.h"
#include "scenes/framing.h"
#include "scenes/mesh_edit.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

/// FNV-1a over the bytes of arrays.
class Hash {
public:
    template <class T>
    void add(const std::vector<T>& values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) value_ = (value_ ^ bytes[i]) * 0x100000001B3U;
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325U;
};

std::uint64_t hash_of(const Scene& scene) {
    Hash hash;
    for (const TextureImage& image : scene.images) hash.add(image.texels);
    for (const Mesh& mesh : scene.meshes) {
        hash.add(mesh.position_m);
        hash.add(mesh.normal);
        hash.add(mesh.tangent);
        hash.add(mesh.uv0);
        hash.add(mesh.color);
        hash.add(mesh.triangle);
    }
    for (const Instance& instance : scene.instances) hash.add(std::vector<glm::mat4>{instance.world_from_mesh});
    return hash.value();
}

struct Stage {
    std::string name;
    double share;
};
std::vector<Stage> stages;  ///< what shed() was told

/// Built once for all tests.
const Scene& shed() {
    static const std::shared_ptr<const Scene> scene = [] {
        const auto begin = std::chrono::steady_clock::now();
        std::shared_ptr<const Scene> made = make_air_shed([](const std::string& stage, double share) {
                                                stages.push_back({stage, share});
                                            }).scene;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        std::size_t texture_bytes = 0;
        for (const TextureImage& image : made->images) texture_bytes += image.texels.size();
        std::printf("made in %.2f s: %zu triangles, %zu meshes, %zu instances, %zu images of %.1f MB\n", took.count(),
                    made->triangle_count(), made->meshes.size(), made->instances.size(), made->images.size(),
                    1e-6 * static_cast<double>(texture_bytes));
        return made;
    }();
    return *scene;
}

TEST(AirShed, IsAWholeSceneOfManyModels) {
    const Scene& scene = shed();
    EXPECT_EQ(scene_defect(scene), "");
    EXPECT_EQ(scene.name, "air-shed");
    EXPECT_GE(scene.triangle_count(), 500'000U);
    EXPECT_GE(scene.meshes.size(), 200U);
    std::size_t largest = 0;
    for (const Mesh& mesh : scene.meshes) largest = std::max(largest, mesh.triangle.size());
    EXPECT_LT(largest, scene.triangle_count() / 10) << "varied models, not one that is cut small";
    std::set<std::string> names;
    for (const Instance& instance : scene.instances) EXPECT_TRUE(names.insert(instance.name).second) << instance.name;
    std::set<int> meshes;
    for (const Instance& instance : scene.instances) meshes.insert(instance.mesh);
    EXPECT_EQ(meshes.size(), scene.meshes.size()) << "no mesh is unused";
    std::set<int> used;
    for (const Mesh& mesh : scene.meshes) used.insert(mesh.material);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        EXPECT_TRUE(used.count(static_cast<int>(i)) > 0) << scene.materials[i].name << " is unused";
}

TEST(AirShed, EveryTriangleHasAnAreaAndAFrontThatItsNormalsAgreeWith) {
    for (const Mesh& mesh : shed().meshes) {
        std::size_t turned = 0;
        for (const glm::uvec3& t : mesh.triangle) {
            const glm::dvec3 a = mesh.position_m[t.x];
            const glm::dvec3 across =
                glm::cross(glm::dvec3(mesh.position_m[t.y]) - a, glm::dvec3(mesh.position_m[t.z]) - a);
            ASSERT_GT(glm::length(across), 0.0) << mesh.name;
            const glm::dvec3 shading(mesh.normal[t.x] + mesh.normal[t.y] + mesh.normal[t.z]);
            if (glm::dot(across, shading) < 0.0) ++turned;
        }
        EXPECT_LE(turned, mesh.triangle.size() / 100) << mesh.name << ": fronts look away from the normals";
    }
}

TEST(AirShed, TexturesAreModestAndColoursStayInRange) {
    const Scene& scene = shed();
    std::size_t bytes = 0;
    for (const TextureImage& image : scene.images) {
        EXPECT_LE(image.width_px, 1024) << image.name;
        EXPECT_LE(image.height_px, 1024) << image.name;
        bytes += image.texels.size();
    }
    EXPECT_LT(bytes, 100U << 20U);
    for (const Mesh& mesh : scene.meshes)
        for (const glm::vec4& c : mesh.color)
            for (int i = 0; i < 3; ++i) ASSERT_TRUE(c[i] >= 0.0F && c[i] <= 1.6F) << mesh.name << " " << c[i];
    for (const Material& m : scene.materials)
        for (int i = 0; i < 3; ++i)
            EXPECT_TRUE(m.unlit || (m.base_color[i] >= 0.0F && m.base_color[i] <= 1.0F)) << m.name;
}

TEST(AirShed, ThickGlassIsClosed) {
    const Scene& scene = shed();
    int closed = 0;
    for (const Mesh& mesh : scene.meshes) {
        const Material& m = scene.materials[static_cast<std::size_t>(mesh.material)];
        if (m.transmission == 0.0F || m.thickness_m == 0.0F) continue;
        EXPECT_TRUE(is_closed(mesh)) << mesh.name;
        ++closed;
    }
    EXPECT_GE(closed, 1);
}

TEST(AirShed, IsTheSameEachTime) {
    EXPECT_EQ(hash_of(shed()), hash_of(*make_air_shed().scene));
}

TEST(AirShed, TellsHowFarItIs) {
    shed();
    ASSERT_GE(stages.size(), 5U);
    std::set<std::string> names;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        names.insert(stages[i].name);
        EXPECT_GE(stages[i].share, stages[i > 0 ? i - 1 : 0].share);
    }
    EXPECT_EQ(stages.front().share, 0.0);
    EXPECT_EQ(stages.back().share, 1.0);
    EXPECT_EQ(names.size(), stages.size());
}

/// Distance to the nearest triangle that a segment from `from` to `to` meets, over its length; 1 if none.
float first_hit(const Scene& scene, const glm::vec3& from, const glm::vec3& to) {
    float nearest = 1.0F;
    const glm::vec3 d = to - from;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        // In the mesh's space the parameter along the segment is the same.
        const glm::mat4 mesh_from_world = glm::inverse(instance.world_from_mesh);
        const glm::vec3 o(mesh_from_world * glm::vec4(from, 1.0F));
        const glm::vec3 r(mesh_from_world * glm::vec4(d, 0.0F));
        for (const glm::uvec3& t : mesh.triangle) {
            const glm::vec3 a = mesh.position_m[t.x];
            const glm::vec3 e1 = mesh.position_m[t.y] - a;
            const glm::vec3 e2 = mesh.position_m[t.z] - a;
            const glm::vec3 p = glm::cross(r, e2);
            const float det = glm::dot(e1, p);
            if (det == 0.0F) continue;
            const glm::vec3 s = o - a;
            const float u = glm::dot(s, p) / det;
            const glm::vec3 q = glm::cross(s, e1);
            const float v = glm::dot(r, q) / det;
            const float k = glm::dot(e2, q) / det;
            if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F && k > 0.0F) nearest = std::min(nearest, k);
        }
    }
    return nearest;
}

TEST(AirShed, TheViewerStandsFreeOnTheFloor) {
    const Scene& scene = shed();
    const glm::vec3 eye = scene.world_from_start.position_m;
    EXPECT_FLOAT_EQ(eye.y, 1.7F);
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.5F, 0.5F}) {
            glm::vec3 to = eye;
            to[axis] += side;
            EXPECT_EQ(first_hit(scene, eye, to), 1.0F) << "something is within half a metre";
        }
    const float floor = first_hit(scene, eye, eye - glm::vec3(0.0F, 2.0F, 0.0F));
    EXPECT_NEAR(floor * 2.0F, 1.7F, 0.02F);
    const glm::vec3 ahead = eye + 40.0F * scene.world_from_start.direction({0.0F, 0.0F, -1.0F});
    EXPECT_GT(first_hit(scene, eye, ahead) * 40.0F, 3.0F) << "the view is open";
}

TEST(AirShed, LightsAreFewAndTheLampsThatShineHang) {
    const Scene& scene = shed();
    int shadows = 0;
    for (const Light& light : scene.lights) {
        shadows += light.casts_shadow ? 1 : 0;
        if (light.kind != LightKind::spot) continue;
        bool hangs = false;
        for (const glm::vec3& hook : AirShedLamps::kHighBays)
            hangs = hangs || glm::length(glm::vec2(hook.x - light.position_m.x, hook.z - light.position_m.z)) < 0.01F;
        EXPECT_TRUE(hangs) << "a light without a lamp";
    }
    EXPECT_GE(shadows, 3);
    EXPECT_LE(shadows, 6);
}

TEST(AirShed, EveryTextHasAPlaceOnItsSheet) {
    SceneBuilder builder;
    const AirShedMaterials materials = add_air_shed_materials(builder);
    for (int i = 0; i < static_cast<int>(AirShedText::count); ++i) {
        const DecalPlace& place = materials.text[i];
        EXPECT_GT(place.uv_high.x, place.uv_low.x) << i;
        EXPECT_GT(place.uv_high.y, place.uv_low.y) << i;
        EXPECT_LE(place.uv_high.y, 1.0F) << i;
    }
}

}  // namespace
}  // namespace macula
