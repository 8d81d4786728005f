// What a tracer does with plans: every address is filled, tasks do not mix, calls may overlap.

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

/// A lit ball before a wall, with a texture, a mask, a mirror and glass, so that every path is taken.
Scene still_life() {
    Scene scene;
    scene.ambient_radiance = vec3(0.2F);
    scene.background_radiance = vec3(0.1F, 0.2F, 0.3F);
    scene.lights.push_back({.direction = glm::normalize(vec3(0.4F, -0.5F, -1.0F)), .intensity = vec3(2.0F)});
    scene.lights.push_back({.kind = LightKind::point, .position_m = vec3(1.0F, 2.0F, 0.0F), .intensity = vec3(5.0F)});
    Material checked = test::white();
    checked.base_color_texture.image =
        test::add_image(scene, 2, 2, {250, 240, 230, 255, 20, 30, 40, 255, 20, 30, 40, 255, 250, 240, 230, 255}, true);
    Material masked = checked;
    masked.alpha_mode = AlphaMode::mask;
    masked.base_color_texture.image = test::add_image(scene, 2, 1, {90, 200, 90, 255, 90, 200, 90, 0}, true);
    test::add(scene, test::wall({0.0F, 0.0F, -4.0F}, 3.0F), checked);
    test::add(scene, test::wall({-1.0F, 0.5F, -3.0F}, 0.6F), masked);
    test::add(scene, make_sphere(0.8F), test::white(),
              glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.3F, 0, -2.5F, 1));
    Material mirror = test::white();
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    test::add(scene, test::wall({1.2F, -1.0F, -2.2F}, 0.5F), mirror);
    Material glass = test::white();
    glass.roughness = 0.0F;
    glass.transmission = 1.0F;
    glass.thickness_m = 1.0F;
    test::add(scene, make_sphere(0.4F), glass, glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.9F, -0.8F, -2.0F, 1));
    return scene;
}

TEST(Tracer, FillsEveryAddress) {
    const auto tracer = test::tracer_of(still_life());
    const EyeView view = test::square_view(37);
    const auto wanted = [](int x, int y) { return (x * 7 + y * 3) % 5 != 0; };
    const SamplePlan plan = test::raster_plan(37, 37, wanted);
    Samples samples;
    samples.color.assign(10, 7U);
    samples.inverse_depth_per_m.assign(99999, 7.0F);
    samples.keep_radiance = true;
    const TraceTask task{&view, &plan, &samples};
    tracer->trace({&task, 1});
    ASSERT_EQ(samples.color.size(), plan.address_count());
    ASSERT_EQ(samples.inverse_depth_per_m.size(), plan.address_count());
    ASSERT_EQ(samples.object_id.size(), plan.address_count());
    ASSERT_EQ(samples.radiance.size(), plan.address_count());
    const test::Traced full = test::trace(still_life(), view);
    for (int y = 0; y < 37; ++y) {
        for (int x = 0; x < 37; ++x) {
            const std::size_t a = full.address(x, y);
            if (wanted(x, y)) {
                // Neighbours in a packet change nothing.
                EXPECT_EQ(samples.color[a], full.color(x, y));
                EXPECT_EQ(samples.inverse_depth_per_m[a], full.inverse_depth(x, y));
                EXPECT_EQ(samples.object_id[a], full.object(x, y));
                EXPECT_EQ(samples.radiance[a], full.radiance(x, y));
            } else {
                EXPECT_EQ(samples.color[a], 0xFF000000U);
                EXPECT_EQ(samples.inverse_depth_per_m[a], -1.0F);
                EXPECT_EQ(samples.object_id[a], 0U);
                EXPECT_EQ(samples.radiance[a], vec3(0.0F));
            }
        }
    }
}

TEST(Tracer, EmptyPlansAndNoTasks) {
    const auto tracer = test::tracer_of(still_life());
    tracer->trace({});
    const EyeView view = test::square_view(8);
    const SamplePlan nothing = test::raster_plan(8, 8, [](int, int) { return false; });
    const SamplePlan none;
    Samples samples;
    Samples no_samples;
    const std::array tasks{TraceTask{&view, &nothing, &samples}, TraceTask{&view, &none, &no_samples}};
    tracer->trace(tasks);
    EXPECT_EQ(samples.inverse_depth_per_m, std::vector<float>(64, -1.0F));
    EXPECT_TRUE(no_samples.color.empty());
}

TEST(Tracer, AnEmptySceneShowsTheBackground) {
    Scene scene;
    scene.materials.emplace_back();
    scene.background_radiance = vec3(1.0F, 0.0F, 0.5F);
    const test::Traced traced = test::trace(scene, test::square_view(9));
    for (int i = 0; i < 9; ++i) {
        EXPECT_EQ(traced.radiance(i, i), scene.background_radiance);
        EXPECT_EQ(traced.inverse_depth(i, i), 0.0F);
        EXPECT_EQ(traced.object(i, i), 0U);
    }
}

TEST(Tracer, GuardSamplesLieOutsideTheImage) {
    // A plane at -2 is everywhere, so that pixels beyond the window are seen too.
    Scene scene;
    test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 50.0F), test::unlit());
    SamplePlan plan = test::full_plan(16, 16);
    for (SamplePosition& p : plan.position) p.x_px = static_cast<std::int16_t>(p.x_px - 16);
    const EyeView view = test::square_view(16);
    Samples samples;
    const TraceTask task{&view, &plan, &samples};
    test::tracer_of(scene)->trace({&task, 1});
    EXPECT_EQ(samples.object_id, std::vector<std::uint32_t>(256, 1U));
    for (const float inverse : samples.inverse_depth_per_m) EXPECT_FLOAT_EQ(inverse, 0.5F);
}

TEST(Tracer, RaysGoThroughThePlacesThatThePlanSays) {
    // A plane whose inverse depth tells both tangents apart: along x in one scene, along y in the other.
    constexpr int kSize = 16;
    const EyeView view = test::square_view(kSize);
    SamplePlan plan = test::full_plan(kSize, kSize);
    for (std::size_t i = 0; i < plan.position.size(); ++i) {
        plan.place.push_back({static_cast<std::uint8_t>(i * 37 % 256), static_cast<std::uint8_t>(i * 101 % 256)});
        plan.position[i].x_px = static_cast<std::int16_t>(plan.position[i].x_px - 3);  // some lie outside
    }
    for (const int axis : {0, 1}) {
        // Points p with p.z = -2 + p[axis] / 2: 1 / depth = .5 + tangent / 4.
        Scene scene;
        vec3 slope(0.0F, 0.0F, 0.5F);
        slope[axis] = 1.0F;
        vec3 level(0.0F);
        level[1 - axis] = 1.0F;
        const vec3 corner = vec3(0.0F, 0.0F, -2.0F) - 12.0F * slope - 30.0F * level;
        Material material = test::unlit();
        material.double_sided = true;
        test::add(scene, make_quad(corner, 15.0F * slope, 60.0F * level), material);
        const auto tracer = test::tracer_of(scene);
        for (const glm::vec2 sample_px : {glm::vec2(0.5F), glm::vec2(0.25F, 0.875F)}) {
            Samples samples;
            TraceTask task{&view, &plan, &samples};
            task.sample_px = sample_px;
            tracer->trace({&task, 1});
            for (std::size_t i = 0; i < plan.position.size(); ++i) {
                const SamplePosition p = plan.position[i];
                const double at_px = axis == 0 ? p.x_px + plan.place[i].x / 256.0 : p.y_px + plan.place[i].y / 256.0;
                const double edge = (at_px + double{sample_px[axis]} - 0.5) / kSize * 2.0 - 1.0;
                const double tangent = axis == 0 ? edge : -edge;
                ASSERT_NEAR(samples.inverse_depth_per_m[i], 0.5 + 0.25 * tangent, 2e-6) << i << ", axis " << axis;
            }
        }
    }
}

TEST(Tracer, APlaceAtTheCentreIsTheSameAsNone) {
    const auto tracer = test::tracer_of(still_life());
    const EyeView view = test::square_view(37);
    const test::Traced expected = test::trace(still_life(), view);
    SamplePlan plan = test::full_plan(37, 37);
    plan.place.resize(plan.position.size());
    Samples samples;
    const TraceTask task{&view, &plan, &samples};
    tracer->trace({&task, 1});
    EXPECT_EQ(samples.color, expected.samples.color);
    EXPECT_EQ(samples.inverse_depth_per_m, expected.samples.inverse_depth_per_m);
}

TEST(Tracer, SeveralTasksAndSeveralThreadsGiveTheSame) {
    const auto tracer = test::tracer_of(still_life());
    const PerEye<EyeView> views{test::square_view(101, {-0.03F, 0.0F, 0.0F}),
                                test::square_view(64, {0.03F, 0.1F, 0.2F})};
    const PerEye<SamplePlan> plans{test::full_plan(101, 101), test::full_plan(64, 64)};
    const PerEye<test::Traced> expected{test::trace(still_life(), views[0]), test::trace(still_life(), views[1])};
    std::vector<std::thread> sessions;
    for (int session = 0; session < 4; ++session) {
        sessions.emplace_back([&] {
            for (int frame = 0; frame < 5; ++frame) {
                PerEye<Samples> samples;
                const std::array tasks{TraceTask{views.data(), plans.data(), samples.data()},
                                       TraceTask{&views[1], &plans[1], &samples[1]}};
                tracer->trace(tasks);
                for (const Eye eye : {kLeftEye, kRightEye}) {
                    EXPECT_EQ(samples[eye].color, expected[eye].samples.color);
                    EXPECT_EQ(samples[eye].inverse_depth_per_m, expected[eye].samples.inverse_depth_per_m);
                    EXPECT_EQ(samples[eye].object_id, expected[eye].samples.object_id);
                }
            }
        });
    }
    for (std::thread& session : sessions) session.join();
}

TEST(Tracer, NamesEmbreeAndItsPackets) {
    const std::string name = test::tracer_of(still_life())->name();
    EXPECT_NE(name.find("Embree"), std::string::npos);
    EXPECT_NE(name.find("16"), std::string::npos);
}

}  // namespace
}  // namespace macula
