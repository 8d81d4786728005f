#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "scenes/animation.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

/// A triangle whose node has animations.
class AnimatedTriangle : public GltfBuilder {
public:
    AnimatedTriangle() : GltfBuilder(GltfBuilder::triangle()) {}

    /// Adds a channel of an animation (the last, or a new one) and its sampler.
    AnimatedTriangle& channel(int node, const char* path, const std::vector<float>& time_s,
                              const std::vector<float>& value, const char* interpolation = "LINEAR") {
        if (!json.contains("animations")) begin_animation();
        nlohmann::json& animation = json["animations"].back();
        const std::string type = std::string(path) == "rotation" ? "VEC4" : "VEC3";
        animation["samplers"].push_back({{"input", accessor<float>("SCALAR", time_s)},
                                         {"output", accessor<float>(type, value)},
                                         {"interpolation", interpolation}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
        return *this;
    }
    AnimatedTriangle& begin_animation() {
        json["animations"].push_back({{"samplers", nlohmann::json::array()}, {"channels", nlohmann::json::array()}});
        return *this;
    }
};

std::shared_ptr<const Scene> load_with_warnings(const GltfBuilder& b, const std::vector<std::string>& warnings = {}) {
    const Expected<LoadedScene> loaded = b.load();
    if (!loaded) {
        ADD_FAILURE() << loaded.error().message;
        return std::make_shared<Scene>();
    }
    EXPECT_EQ(scene_defect(*loaded->scene), "");
    EXPECT_EQ(loaded->warnings.size(), warnings.size()) << (loaded->warnings.empty() ? "" : loaded->warnings[0]);
    for (std::size_t i = 0; i < std::min(warnings.size(), loaded->warnings.size()); ++i)
        EXPECT_NE(loaded->warnings[i].find(warnings[i]), std::string::npos) << loaded->warnings[i];
    return loaded->scene;
}

/// Where the origin of the mesh of an instance is.
glm::vec3 origin(const Scene& scene, std::size_t instance, double time_s) {
    const Instance& of = scene.instances.at(instance);
    if (of.node < 0) return glm::vec3(of.world_from_mesh[3]);
    std::vector<glm::mat4> world_from_node;
    pose_nodes(scene.animation, time_s, world_from_node);
    return glm::vec3(world_from_node.at(static_cast<std::size_t>(of.node))[3]);
}

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5F) << i;
}

TEST(GltfAnimation, EachPathAndInterpolation) {
    const float h = std::sqrt(0.5F);
    AnimatedTriangle b;
    b.channel(0, "translation", {0, 2}, {1, 2, 3, 5, 2, 3});
    b.channel(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2}, "STEP");
    b.channel(0, "rotation", {0, 2}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0},
              "CUBICSPLINE");
    const auto scene = load_with_warnings(b);
    const Animation& animation = scene->animation;
    ASSERT_TRUE(animation.present());
    EXPECT_EQ(animation.duration_s, 2.0F);
    ASSERT_EQ(animation.channels.size(), 3U);
    EXPECT_EQ(animation.channels[1].interpolation, Interpolation::step);
    EXPECT_EQ(animation.channels[1].period_s, 2.0F) << "of its animation, not of the channel";
    EXPECT_EQ(animation.channels[2].interpolation, Interpolation::cubic_spline);
    EXPECT_NEAR(animation.channels[2].value[4].z, h, 1e-6F);
    ASSERT_EQ(scene->instances[0].node, 0);
    expect_near(origin(*scene, 0, 0.0), {1, 2, 3});
    expect_near(origin(*scene, 0, 1.0), {3, 2, 3});
    expect_near(origin(*scene, 0, 3.0), {3, 2, 3});

    std::vector<glm::mat4> posed;
    pose_nodes(animation, 1.0, posed);
    // Half way of the spline between 0 and 90 degrees it is turned by 45; the scale is 2 by then.
    expect_near(glm::vec3(posed[0][0]), {2 * h, 2 * h, 0});
}

TEST(GltfAnimation, NormalisedIntegersTurn) {
    AnimatedTriangle b;
    b.channel(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});
    b.json["animations"][0]["samplers"][0]["output"] =
        b.accessor<std::int8_t>("VEC4", {0, 0, 0, 127, 0, 0, 127, 0}, true);
    const auto scene = load_with_warnings(b);
    EXPECT_EQ(scene->animation.channels.at(0).value[1], glm::vec4(0, 0, 1, 0));
}

TEST(GltfAnimation, OnlyWhatMovesNamesANode) {
    AnimatedTriangle b;
    // A static root above a moving node, below it a static one with a mesh; beside it a static mesh.
    b.json["nodes"] = {{{"children", {1, 3}}, {"translation", {100, 0, 0}}},
                       {{"children", {2}}},
                       {{"mesh", 0}, {"translation", {0, 10, 0}}},
                       {{"mesh", 0}}};
    b.channel(1, "translation", {0, 1}, {0, 0, 0, 0, 0, 8});
    const auto scene = load_with_warnings(b);
    ASSERT_EQ(scene->instances.size(), 2U);
    EXPECT_GE(scene->instances[0].node, 0);
    EXPECT_EQ(scene->instances[1].node, -1);
    expect_near(origin(*scene, 0, 0.5), {100, 10, 4});
    expect_near(origin(*scene, 1, 0.5), {100, 0, 0});
    EXPECT_EQ(scene->animation.nodes.size(), 2U) << "the root is a matrix above the moving node";
}

TEST(GltfAnimation, MovingParentsMultiply) {
    AnimatedTriangle b;
    b.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}}};
    const float h = std::sqrt(0.5F);
    b.channel(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, h, h});
    b.channel(1, "translation", {0, 1}, {1, 0, 0, 3, 0, 0});
    const auto scene = load_with_warnings(b);
    expect_near(origin(*scene, 0, 0.0), {1, 0, 0});
    expect_near(origin(*scene, 0, 0.5), {2 * h, 2 * h, 0});
}

TEST(GltfAnimation, LightsMove) {
    AnimatedTriangle b;
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    b.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    b.channel(1, "translation", {0, 1}, {0, 5, 0, 0, 6, 0});
    const auto scene = load_with_warnings(b);
    ASSERT_EQ(scene->lights.size(), 1U);
    EXPECT_EQ(scene->lights[0].node, 0);
    EXPECT_EQ(scene->lights[0].position_m, glm::vec3(0, 5, 0)) << "at time 0, not at rest";
    EXPECT_EQ(scene->instances[0].node, -1);
}

TEST(GltfAnimation, WhatNeverChangesBecomesAPlace) {
    AnimatedTriangle b;
    b.node()["scale"] = {2, 2, 2};
    b.channel(0, "translation", {0, 1, 2}, {4, 5, 6, 4, 5, 6, 4, 5, 6});
    const auto scene = load_with_warnings(b);
    EXPECT_FALSE(scene->animation.present());
    EXPECT_TRUE(scene->animation.nodes.empty());
    EXPECT_EQ(scene->instances[0].node, -1);
    expect_near(origin(*scene, 0, 0.0), {4, 5, 6});
    EXPECT_EQ(scene->instances[0].world_from_mesh[0].x, 2.0F);
}

TEST(GltfAnimation, WhatNobodySeesIsNotPlayed) {
    AnimatedTriangle b;
    b.json["nodes"].push_back({{"name", "joint"}});
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    b.channel(1, "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
    const auto scene = load_with_warnings(b);
    EXPECT_FALSE(scene->animation.present());
    EXPECT_EQ(scene->animation.duration_s, 0.0F);
}

TEST(GltfAnimation, EachAnimationHasItsPeriodAndTheFirstCounts) {
    AnimatedTriangle b;
    b.node()["name"] = "door";
    b.channel(0, "translation", {0, 2}, {0, 0, 0, 2, 0, 0});
    b.begin_animation().channel(0, "scale", {0, 3}, {1, 1, 1, 2, 2, 2});
    b.channel(0, "translation", {0, 5}, {0, 0, 0, 0, 9, 0});
    const auto scene =
        load_with_warnings(b, {"animation 1, channel 1: node 0 (\"door\") is moved by an earlier channel already"});
    ASSERT_EQ(scene->animation.channels.size(), 2U);
    EXPECT_EQ(scene->animation.channels[0].period_s, 2.0F);
    EXPECT_EQ(scene->animation.channels[1].period_s, 3.0F);
    EXPECT_EQ(scene->animation.duration_s, 3.0F);
}

TEST(GltfAnimation, MorphWeightsAreIgnored) {
    AnimatedTriangle b;
    b.channel(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    b.json["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}});
    const auto scene = load_with_warnings(b, {"animation 0, channel 1: morph weights are ignored"});
    EXPECT_EQ(scene->animation.channels.size(), 1U);
}

TEST(GltfAnimation, ChannelsThatPointElsewhereAreLeftOut) {
    AnimatedTriangle b;
    b.json["extensionsUsed"] = {"KHR_animation_pointer"};
    b.channel(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    b.json["animations"][0]["channels"].push_back(
        {{"sampler", 0},
         {"target",
          {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0"}}}}}}}});
    EXPECT_EQ(load_with_warnings(b, {"KHR_animation_pointer"})->animation.channels.size(), 1U);
}

TEST(GltfAnimation, NodesWithAMatrixStay) {
    AnimatedTriangle b;
    b.node()["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1};
    b.channel(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    const auto scene = load_with_warnings(b, {"channel 0: node 0 has a matrix and is not moved"});
    EXPECT_FALSE(scene->animation.present());
    expect_near(origin(*scene, 0, 0.0), {7, 0, 0});
}

TEST(GltfAnimation, KeysThatComeTooEarlyAreDropped) {
    AnimatedTriangle b;
    b.channel(0, "translation", {0, 2, 1, 2, 3}, {0, 0, 0, 2, 0, 0, 9, 9, 9, 9, 9, 9, 3, 0, 0});
    const auto scene = load_with_warnings(b, {"animation 0, channel 0: 2 key(s) that do not come after"});
    const AnimationChannel& channel = scene->animation.channels.at(0);
    EXPECT_EQ(channel.time_s, (std::vector<float>{0, 2, 3}));
    EXPECT_EQ(channel.value[2], glm::vec4(3, 0, 0, 0));
}

TEST(GltfAnimation, KeysOfSplinesAreDroppedWithTheirTangents) {
    AnimatedTriangle b;
    b.channel(0, "translation", {0, 0, 1},
              {1, 0, 0, 2, 0, 0, 3, 0, 0, 9, 9, 9, 9, 9, 9, 9, 9, 9, 4, 0, 0, 5, 0, 0, 6, 0, 0}, "CUBICSPLINE");
    const auto scene = load_with_warnings(b, {"1 key(s)"});
    const AnimationChannel& channel = scene->animation.channels.at(0);
    ASSERT_EQ(channel.value.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(channel.value[i].x, static_cast<float>(i + 1));
}

TEST(GltfAnimation, RotationsAreMadeUnitOrNone) {
    AnimatedTriangle b;
    b.channel(0, "rotation", {0, 1, 2}, {0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 0, 0});
    const auto scene =
        load_with_warnings(b, {"animation 0, channel 0: 1 rotation(s) of length zero are taken as none"});
    const AnimationChannel& channel = scene->animation.channels.at(0);
    EXPECT_EQ(channel.value[0], glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(channel.value[1], glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(channel.value[2], glm::vec4(1, 0, 0, 0));
}

TEST(GltfAnimation, WhatGrowsFromNothingIsShown) {
    AnimatedTriangle b;
    b.channel(0, "scale", {0, 1}, {0, 0, 0, 1, 1, 1});
    const auto scene = load_with_warnings(b);
    ASSERT_EQ(scene->instances.size(), 1U);
    EXPECT_EQ(scene->instances[0].world_from_mesh[0].x, kSmallestAnimatedScale);
}

TEST(GltfAnimation, ADeepHierarchyOfTurningNodesIsNoOverflow) {
    AnimatedTriangle b;
    constexpr std::size_t kDepth = 300;
    b.json["nodes"] = nlohmann::json::array();
    for (std::size_t i = 0; i + 1 < kDepth; ++i) b.json["nodes"].push_back({{"children", {i + 1}}});
    b.json["nodes"].push_back({{"mesh", 0}});
    for (std::size_t i = 0; i < kDepth; ++i)
        b.channel(static_cast<int>(i), "rotation", {0, 1}, {0, 0, 0, 1, 0.6F, 0, 0, 0.8F});
    EXPECT_EQ(load_with_warnings(b)->animation.nodes.size(), kDepth);
}

struct Refusal {
    const char* what;
    std::function<void(AnimatedTriangle&)> spoil;
    const char* message;
};

TEST(GltfAnimation, EachDefectIsNamed) {
    const auto sampler = [](AnimatedTriangle& b) -> nlohmann::json& { return b.json["animations"][0]["samplers"][0]; };
    const auto target = [](AnimatedTriangle& b) -> nlohmann::json& {
        return b.json["animations"][0]["channels"][0]["target"];
    };
    const std::vector<Refusal> refusals = {
        {"sampler out of range", [](auto& b) { b.json["animations"][0]["channels"][0]["sampler"] = 4; },
         "animation 0 (\"spin\"), channel 0: sampler 4 does not exist"},
        {"node out of range", [&](auto& b) { target(b)["node"] = 9; }, "channel 0: node 9 does not exist"},
        {"negative node", [&](auto& b) { target(b)["node"] = -3; }, "channel 0: node -3 does not exist"},
        {"unknown path", [&](auto& b) { target(b)["path"] = "colour"; }, "the path \"colour\" is not glTF"},
        {"unknown interpolation", [&](auto& b) { sampler(b)["interpolation"] = "WILD"; },
         "the interpolation \"WILD\" is not glTF"},
        {"input out of range", [&](auto& b) { sampler(b)["input"] = 77; }, "accessor 77: does not exist"},
        {"output out of range", [&](auto& b) { sampler(b)["output"] = 78; }, "accessor 78: does not exist"},
        {"input of vectors", [&](auto& b) { sampler(b)["input"] = 0; }, "accessor 0: has to have 1"},
        {"output of the wrong type",
         [&](auto& b) {
             sampler(b)["output"] = b.template accessor<float>("VEC4", {0, 0, 0, 1, 0, 0, 0, 1});
         },
         "has to have 3"},
        {"too few values",
         [&](auto& b) {
             sampler(b)["output"] = b.template accessor<float>("VEC3", {0, 0, 0});
         },
         "channel 0: there are 1 values for 2 times, not 2"},
        {"spline without tangents", [&](auto& b) { sampler(b)["interpolation"] = "CUBICSPLINE"; },
         "there are 2 values for 2 times, not 6"},
        {"NaN time",
         [&](auto& b) {
             sampler(b)["input"] = b.template accessor<float>("SCALAR", {0, std::numeric_limits<float>::quiet_NaN()});
         },
         "NaN or infinity"},
        {"endless value",
         [&](auto& b) {
             sampler(b)["output"] =
                 b.template accessor<float>("VEC3", {0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0});
         },
         "NaN or infinity"},
        {"absurd time",
         [&](auto& b) {
             sampler(b)["input"] = b.template accessor<float>("SCALAR", {0, 1e12F});
         },
         "a time is beyond 1e9 s"},
        {"absurd distance",
         [&](auto& b) {
             sampler(b)["output"] = b.template accessor<float>("VEC3", {0, 0, 0, 1e10F, 0, 0});
         },
         "animations: move nodes beyond 1e9 m"},
        {"tangents that lead too far",
         [&](auto& b) {
             sampler(b)["interpolation"] = "CUBICSPLINE";
             std::vector<float> values(18, 0.0F);
             values[6] = 1e20F;
             sampler(b)["output"] = b.template accessor<float>("VEC3", values);
         },
         "animations: move nodes beyond 1e9 m"},
    };
    for (const Refusal& refusal : refusals) {
        AnimatedTriangle b;
        b.channel(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
        b.json["animations"][0]["name"] = "spin";
        ASSERT_TRUE(b.load()) << "the file is good before it is spoilt";
        refusal.spoil(b);
        const Expected<LoadedScene> loaded = b.load();
        ASSERT_FALSE(loaded) << refusal.what;
        EXPECT_EQ(loaded.error().code, ErrorCode::input_file) << refusal.what;
        EXPECT_NE(loaded.error().message.find(refusal.message), std::string::npos)
            << refusal.what << ": " << loaded.error().message;
    }
}

TEST(GltfAnimation, ScalesThatMultiplyBeyondReason) {
    AnimatedTriangle b;
    b.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}}};
    for (const int node : {0, 1}) b.channel(node, "scale", {0, 1}, {1, 1, 1, 1e6F, 1, 1});
    const Expected<LoadedScene> loaded = b.load();
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message.find("grow them beyond 1e9 times"), std::string::npos) << loaded.error().message;
}

}  // namespace
}  // namespace macula
