// Moving scenes against the same scenes with everything put where it then is.

#include <gtest/gtest.h>

#include <thread>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

AnimationChannel channel(int node, AnimationPath path, std::vector<glm::vec4> value) {
    AnimationChannel result;
    result.node = node;
    result.path = path;
    for (std::size_t i = 0; i < value.size(); ++i) result.time_s.push_back(static_cast<float>(i));
    result.value = std::move(value);
    result.period_s = result.time_s.back();
    return result;
}

/// A mirrored, stretched box that turns and moves, a ball that moves, and a lamp on the ball's node, before a wall that
/// stands still.
Scene moving_scene() {
    Scene scene;
    scene.ambient_radiance = vec3(0.1F);
    scene.animation.nodes.resize(2);
    scene.animation.nodes[0].scale = vec3(-1.3F, 0.7F, 1.0F);
    const glm::quat turn = glm::angleAxis(1.2F, glm::normalize(vec3(0.3F, 1.0F, 0.2F)));
    scene.animation.channels = {channel(0, AnimationPath::translation, {{-1, 0, -3, 0}, {-0.4F, 0.5F, -3.5F, 0}}),
                                channel(0, AnimationPath::rotation, {{0, 0, 0, 1}, {turn.x, turn.y, turn.z, turn.w}}),
                                channel(1, AnimationPath::translation, {{1, 0, -3, 0}, {1.2F, -0.6F, -2.5F, 0}})};
    scene.animation.duration_s = 1.0F;
    std::vector<glm::mat4> start;
    pose_nodes(scene.animation, 0.0, start);
    test::add(scene, test::wall({0.0F, 0.0F, -5.0F}, 6.0F), test::white());
    Material checked = test::white();
    checked.base_color_texture.image =
        test::add_image(scene, 2, 2, {250, 240, 230, 255, 20, 30, 40, 255, 20, 30, 40, 255, 250, 240, 230, 255}, true);
    test::add(scene, make_box(vec3(0.8F)), checked, start[0]);
    scene.instances.back().node = 0;
    test::add(scene, make_sphere(0.5F), test::white(), start[1]);
    scene.instances.back().node = 1;
    Light lamp{
        .kind = LightKind::point, .position_m = vec3(0.0F, 1.5F, 0.0F) + vec3(start[1][3]), .intensity = vec3(9)};
    lamp.node = 1;
    scene.lights.push_back(lamp);
    return scene;
}

/// The same scene, without motion, as it is at a time.
Scene standing_scene(double time_s) {
    Scene scene = moving_scene();
    std::vector<glm::mat4> start;
    std::vector<glm::mat4> now;
    pose_nodes(scene.animation, 0.0, start);
    pose_nodes(scene.animation, time_s, now);
    for (Instance& instance : scene.instances) {
        if (instance.node >= 0) instance.world_from_mesh = now[static_cast<std::size_t>(instance.node)];
        instance.node = -1;
    }
    for (Light& light : scene.lights) {
        light.position_m += vec3(now[1][3] - start[1][3]);
        light.node = -1;
    }
    scene.animation = {};
    return scene;
}

/// Pixels that differ by more than rounding. Edges may fall to either side.
int different(const test::Traced& a, const test::Traced& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.samples.radiance.size(); ++i) {
        const vec3 difference = glm::abs(a.samples.radiance[i] - b.samples.radiance[i]);
        const bool same = a.samples.object_id[i] == b.samples.object_id[i] &&
                          std::abs(a.samples.inverse_depth_per_m[i] - b.samples.inverse_depth_per_m[i]) < 1e-4F &&
                          std::max({difference.x, difference.y, difference.z}) < 2e-3F;
        count += same ? 0 : 1;
    }
    return count;
}

TEST(TracerMotion, LooksLikeTheSameSceneStandingStill) {
    const EyeView view = test::square_view(96);
    for (const double time_s : {0.0, 0.3, 0.75, 1.6, -0.2}) {
        const test::Traced moving = test::trace(moving_scene(), view, {}, time_s);
        EXPECT_LT(different(moving, test::trace(standing_scene(time_s), view)), 40) << time_s << " s, of 9216";
    }
    EXPECT_GT(different(test::trace(moving_scene(), view, {}, 0.0), test::trace(moving_scene(), view, {}, 0.75)), 500);
}

TEST(TracerMotion, SessionsAtDifferentTimesShareATracer) {
    const EyeView view = test::square_view(48);
    const SamplePlan plan = test::full_plan(48, 48);
    const auto tracer = test::tracer_of(moving_scene());
    const auto at = [&](double time_s) {
        Samples samples;
        const TraceTask task{&view, &plan, &samples};
        tracer->trace({&task, 1}, time_s);
        return samples;
    };
    constexpr int kTimes = 12;
    std::vector<Samples> expected;
    expected.reserve(kTimes);
    for (int i = 0; i < kTimes; ++i) expected.push_back(at(0.07 * i));
    std::vector<std::thread> sessions;
    for (int session = 0; session < 4; ++session) {
        sessions.emplace_back([&, session] {
            for (int i = 0; i < kTimes; ++i) {
                const int k = (i * (2 * session + 1) + session) % kTimes;
                EXPECT_EQ(at(0.07 * k).color, expected[static_cast<std::size_t>(k)].color);
            }
        });
    }
    for (std::thread& session : sessions) session.join();
}

}  // namespace
}  // namespace macula
