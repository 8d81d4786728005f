#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/framing.h"
#include "scenes/gltf_camera.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr glm::vec3 kAhead(0, 0, -1);
constexpr glm::vec3 kUp(0, 1, 0);

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5F) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

/// The triangle with a camera below a node that is changed like this.
GltfBuilder with_camera(const nlohmann::json& node, const char* type = "perspective") {
    GltfBuilder b = GltfBuilder::triangle();
    const nlohmann::json lens = std::string(type) == "perspective"
                                    ? nlohmann::json({{"yfov", 1.0}, {"znear", 0.1}})
                                    : nlohmann::json({{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 10}});
    b.json["cameras"] = {{{"type", type}, {type, lens}, {"name", "porch"}}};
    b.json["nodes"].push_back(node);
    b.json["nodes"].back()["camera"] = 0;
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    return b;
}

std::shared_ptr<const Scene> load(const GltfBuilder& b) {
    const Expected<LoadedScene> loaded = b.load();
    if (!loaded) {
        ADD_FAILURE() << loaded.error().message;
        Scene nothing;
        nothing.cameras.resize(1);
        return std::make_shared<Scene>(nothing);
    }
    EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings[0];
    EXPECT_EQ(scene_defect(*loaded->scene), "");
    return loaded->scene;
}

/// Quaternion xyzw of a yaw, then a pitch.
nlohmann::json turned(float yaw, float pitch) {
    const glm::quat q = glm::angleAxis(yaw, kUp) * glm::angleAxis(pitch, glm::vec3(1, 0, 0));
    return {q.x, q.y, q.z, q.w};
}

TEST(GltfCamera, IsAPoseToLookFrom) {
    for (const char* type : {"perspective", "orthographic"}) {
        const auto scene = load(with_camera({{"translation", {1, 2, 3}}, {"rotation", turned(kPi / 2, -0.25F)}}, type));
        ASSERT_EQ(scene->cameras.size(), 1U);
        EXPECT_EQ(scene->cameras[0].name, "porch");
        const Pose& pose = scene->cameras[0].world_from_head;
        EXPECT_EQ(pose.position_m, glm::vec3(1, 2, 3));
        expect_near(pose.direction(kAhead), {-std::cos(0.25F), -std::sin(0.25F), 0});
        // The session starts there, with the head level.
        EXPECT_EQ(scene->world_from_start.position_m, glm::vec3(1, 2, 3));
        expect_near(scene->world_from_start.direction(kAhead), {-1, 0, 0});
        expect_near(scene->world_from_start.direction(kUp), kUp);
    }
}

TEST(GltfCamera, TheFirstOneCounts) {
    GltfBuilder b = with_camera({{"translation", {1, 0, 0}}});
    b.json["cameras"].push_back(b.json["cameras"][0]);
    b.json["cameras"][1].erase("name");
    b.json["nodes"].push_back({{"camera", 0}, {"translation", {2, 0, 0}}});
    b.json["nodes"].push_back({{"camera", 1}, {"name", "attic"}});
    b.json["nodes"].push_back({{"camera", 1}});
    b.json["scenes"] = {{{"nodes", {0, 1, 2, 3, 4}}}};
    const auto scene = load(b);
    ASSERT_EQ(scene->cameras.size(), 4U);
    EXPECT_EQ(scene->cameras[0].name, "porch");
    EXPECT_EQ(scene->cameras[1].name, "porch (2)");
    EXPECT_EQ(scene->cameras[2].name, "attic") << "the node's, where the camera has none";
    EXPECT_EQ(scene->cameras[3].name, "node 4");
    EXPECT_EQ(scene->world_from_start.position_m.x, 1.0F);
}

TEST(GltfCamera, NamesDifferWhateverTheyAre) {
    GltfBuilder b = with_camera({{"translation", {1, 0, 0}}});
    b.json["cameras"].push_back(b.json["cameras"][0]);
    b.json["cameras"][1]["name"] = "porch (2)";
    b.json["nodes"].push_back({{"camera", 1}});
    b.json["nodes"].push_back({{"camera", 0}});
    b.json["nodes"].push_back({{"camera", 0}});
    b.json["scenes"] = {{{"nodes", {0, 1, 2, 3, 4}}}};
    const auto scene = load(b);
    ASSERT_EQ(scene->cameras.size(), 4U);
    EXPECT_EQ(scene->cameras[1].name, "porch (2)");
    EXPECT_EQ(scene->cameras[2].name, "porch (3)");
    EXPECT_EQ(scene->cameras[3].name, "porch (4)");
}

TEST(GltfCamera, ScalesAndMirrorsOfItsNodeAreTakenOut) {
    const nlohmann::json rotation = turned(0.5F, 0.0F);
    const glm::vec3 ahead(-std::sin(0.5F), 0, -std::cos(0.5F));
    for (const std::vector<float>& scale :
         {std::vector<float>{2, 3, 4}, {-1, 1, 1}, {0.001F, 0.001F, 0.001F}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}}) {
        const Pose pose = load(with_camera({{"rotation", rotation}, {"scale", scale}}))->cameras[0].world_from_head;
        expect_near(pose.direction(kAhead), ahead);
        expect_near(pose.direction(kUp), kUp);
    }
    // Looking backwards is not mirrored away.
    const Pose back = load(with_camera({{"rotation", rotation}, {"scale", {1, 1, -1}}}))->cameras[0].world_from_head;
    expect_near(back.direction(kAhead), -ahead);
    // Of a node that is shrunk to a point nothing but the place is left.
    const Pose point =
        load(with_camera({{"translation", {1, 2, 3}}, {"scale", {0, 0, 0}}}))->cameras[0].world_from_head;
    EXPECT_EQ(point.position_m, glm::vec3(1, 2, 3));
    EXPECT_NEAR(glm::length(point.orientation), 1.0F, 1e-6F);
}

TEST(GltfCamera, ShearIsTakenOut) {
    glm::mat4 m(1.0F);
    m[1] = glm::vec4(0.5F, 1, 0.5F, 0);  // +Y leans
    const glm::quat q = extract_rotation(m);
    expect_near(q * glm::vec3(0, 0, 1), {0, 0, 1});
    expect_near(q * kUp, glm::normalize(glm::vec3(0.5F, 1, 0)));
}

TEST(GltfCamera, MovesToItsPlaceAtTime0) {
    GltfBuilder b = with_camera({{"translation", {9, 9, 9}}});
    b.json["animations"] = {{{"samplers",
                              {{{"input", b.accessor<float>("SCALAR", {0, 1})},
                                {"output", b.accessor<float>("VEC3", {1, 2, 3, 4, 5, 6})}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    const auto scene = load(b);
    EXPECT_EQ(scene->cameras[0].world_from_head.position_m, glm::vec3(1, 2, 3));
    EXPECT_FALSE(scene->animation.present()) << "nothing that is shown moves";
}

TEST(GltfCamera, OutOfRangeIsRefused) {
    GltfBuilder b = with_camera({});
    b.json["nodes"][1]["camera"] = 3;
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message.find("camera 3: does not exist"), std::string::npos) << loaded.error().message;
}

TEST(LevelHead, KeepsYawAndPlace) {
    for (float yaw = -3.0F; yaw < 3.1F; yaw += 0.5F)
        for (const float pitch : {-1.5F, -0.3F, 0.0F, 0.9F, 1.5F}) {
            const glm::quat q = glm::angleAxis(yaw, kUp) * glm::angleAxis(pitch, glm::vec3(1, 0, 0)) *
                                glm::angleAxis(0.4F, glm::vec3(0, 0, 1));
            const Pose level = level_head({q, {1, 2, 3}});
            EXPECT_EQ(level.position_m, glm::vec3(1, 2, 3));
            expect_near(level.direction(kUp), kUp);
            expect_near(level.direction(kAhead), {-std::sin(yaw), 0, -std::cos(yaw)}, 1e-4F);
        }
}

TEST(LevelHead, StraightDownTheTopOfTheHeadPointsAhead) {
    for (const float pitch : {-kPi / 2, kPi / 2}) {
        const glm::quat q = glm::angleAxis(0.7F, kUp) * glm::angleAxis(pitch, glm::vec3(1, 0, 0));
        expect_near(level_head({q, {}}).direction(kAhead), {-std::sin(0.7F), 0, -std::cos(0.7F)}, 1e-4F);
    }
}

}  // namespace
}  // namespace macula
