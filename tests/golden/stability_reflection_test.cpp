// Reflected rays that meet the mirror they leave. A flat or convex mirror sees nothing but the sky, and where that is
// the same everywhere, it is as bright.

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/slow_trace.h"

namespace macula {
namespace {

using glm::vec3;

constexpr int kSize_px = 160;

Material mirror() {
    Material material;
    material.roughness = 0.0F;
    return material;
}

/// Reflected rays beyond the first of each pixel: only those that met the mirror again are reflected again.
test::WrongPixels self_reflections(Mesh mesh, const glm::mat4& place, const EyeView& view) {
    auto scene = std::make_shared<Scene>();
    scene->background_radiance = vec3(1.0F);
    test::add(*scene, std::move(mesh), mirror(), place);
    TracerOptions options;
    options.bounces = 4;
    options.bounce_bound = 0.0F;
    const auto tracer = make_embree_tracer(scene, options);
    if (!tracer) throw std::runtime_error(tracer.error().message);  // a test that cannot go on
    test::Traced traced{view, {}};
    traced.samples.keep_radiance = true;
    const SamplePlan plan = test::full_plan(view.width_px, view.height_px);
    const TraceTask task{&traced.view, &plan, &traced.samples};
    const TraceCounts counts = (*tracer)->trace({&task, 1});
    test::WrongPixels result;
    for (std::size_t i = 0; i < traced.samples.radiance.size(); ++i) {
        if (traced.samples.object_id[i] == 0) continue;
        const vec3 difference = traced.samples.radiance[i] - vec3(1.0F);
        result.count(!(glm::dot(difference, difference) < 1e-6F));
    }
    EXPECT_GE(counts.reflection, static_cast<std::uint64_t>(result.compared));
    result.wrong += static_cast<int>(counts.reflection) - result.compared;
    return result;
}

void add(test::WrongPixels& sum, const test::WrongPixels& more) {
    sum.wrong += more.wrong;
    sum.compared += more.compared;
}

TEST(StabilityOfReflections, FlatMirrorsDoNotMeetThemselves) {
    test::WrongPixels sum;
    for (const vec3 place : {vec3(0.0F), vec3(10000.0F, -300.0F, 4000.0F)}) {
        for (const float height_m : {1e-3F, 1.0F, 1e3F}) {
            for (const float tilt_rad : {0.0F, 0.02F, 0.4F}) {
                EyeView view = test::square_view(kSize_px, place + vec3(0.0F, height_m, 0.0F));
                view.tangents = {-1.0F, 1.0F, -2.0F, -0.01F};
                if (view.world_from_eye.position_m.y - place.y < 0.5F * height_m) continue;  // lost in the last digit
                const float half = 20.0F * height_m;
                const Mesh plane =
                    make_quad({-half, 0.0F, -half}, {2.0F * half, 0.0F, 0.0F}, {0.0F, 0.0F, 2.0F * half});
                const glm::mat4 tilt = glm::rotate(glm::translate(glm::mat4(1.0F), place), tilt_rad,
                                                   glm::normalize(vec3(0.6F, 0.64F, 0.48F)));
                add(sum, self_reflections(plane, tilt, view));
            }
        }
    }
    sum.report("flat_mirrors");
    EXPECT_EQ(sum.wrong, 0);
    EXPECT_GT(sum.compared, 150000);
}

TEST(StabilityOfReflections, MirrorBallsDoNotMeetThemselves) {
    test::WrongPixels sum;
    for (const float radius : {1e-3F, 1.0F, 1e4F})
        for (const int segments : {16, 64, 256})
            add(sum, self_reflections(make_sphere(radius, segments), glm::mat4(1.0F),
                                      test::square_view(kSize_px, vec3(0.0F, 0.0F, 1.8F * radius))));
    sum.report("mirror_balls");
    EXPECT_EQ(sum.wrong, 0);
    EXPECT_GT(sum.compared, 60000);
}

}  // namespace
}  // namespace macula
