// A sample reads as much of a texture as it stands for.

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/texture_image.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec3;

constexpr int kSize = 64;

/// Unlit squares of two colours whose mean is 1/2, `period_m` wide together, on a wall of 2 `half_m` edges.
void add_checks(Scene& scene, float half_m, float period_m, TextureFilter filter,
                const glm::mat4& place = glm::mat4(1.0F)) {
    constexpr int kTexels = 16;
    Material checks = test::unlit();
    checks.base_color_texture.image = static_cast<int>(scene.images.size());
    checks.base_color_texture.filter = filter;
    const float periods = 2.0F * half_m / period_m;
    checks.base_color_texture.uv_scale_rotation = glm::vec4(periods, 0.0F, 0.0F, periods);
    scene.images.push_back(test::make_image(kTexels, kTexels, 3, TexelType::f32, [](int x, int y) {
        return glm::vec4((x < kTexels / 2) == (y < kTexels / 2) ? 1.0F : 0.0F);
    }));
    test::add(scene, test::wall(vec3(0.0F), half_m), checks, place);
}

Scene wall_of_checks(float distance_m, float half_m, float period_m, TextureFilter filter = TextureFilter::linear) {
    Scene scene;
    add_checks(scene, half_m, period_m, filter, glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -distance_m)));
    return scene;
}

std::vector<vec3> radiance(const Scene& scene, const SamplePlan& plan, float footprint_scale) {
    const EyeView view = test::square_view(kSize);
    Samples samples;
    samples.keep_radiance = true;
    TraceTask task{&view, &plan, &samples};
    task.footprint_scale = footprint_scale;
    test::tracer_of(scene)->trace({&task, 1});
    return samples.radiance;
}

/// A plan of every pixel that says of its samples what one of 16 a tile says: they stand for 4 x 4 pixels.
SamplePlan sparse_plan() {
    SamplePlan plan = test::full_plan(kSize, kSize);
    plan.tiles_x = kSize / kTileEdge_px;
    plan.tiles_y = plan.tiles_x;
    constexpr std::uint8_t kSixteen = 7;
    static_assert(kLevelCounts[kSixteen] == 16);
    plan.level.assign(std::size_t{kSize / kTileEdge_px} * (kSize / kTileEdge_px), kSixteen);
    return plan;
}

double contrast(const std::vector<vec3>& radiance) {
    double sum = 0.0;
    for (const vec3& r : radiance) sum += std::pow(static_cast<double>(r.x) - 0.5, 2.0);
    return std::sqrt(sum / static_cast<double>(radiance.size()));
}

TEST(Footprint, FarChecksBecomeTheirMean) {
    // A pixel is .3 m wide, a period .05.
    const Scene scene = wall_of_checks(10.0F, 10.0F, 0.05F);
    for (const vec3& r : radiance(scene, test::full_plan(kSize, kSize), 1.0F)) ASSERT_NEAR(r.x, 0.5F, 1e-3F);
}

TEST(Footprint, OfScaleZeroReadsTheTextureItself) {
    const Scene scene = wall_of_checks(10.0F, 10.0F, 0.0437F, TextureFilter::nearest);
    int bright = 0;
    for (const vec3& r : radiance(scene, test::full_plan(kSize, kSize), 0.0F)) {
        ASSERT_TRUE(r.x == 0.0F || r.x == 1.0F) << r.x;
        bright += r.x == 1.0F ? 1 : 0;
    }
    EXPECT_GT(bright, kSize * kSize / 4);
    EXPECT_LT(bright, kSize * kSize * 3 / 4);
}

TEST(Footprint, NearChecksStayAsTheyAre) {
    // A period is 32 pixels wide.
    const Scene scene = wall_of_checks(1.0F, 1.0F, 1.0F);
    const SamplePlan plan = test::full_plan(kSize, kSize);
    const auto found = radiance(scene, plan, 1.0F);
    const auto exact = radiance(scene, plan, 0.0F);
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i].x, exact[i].x, 0.02F);
    EXPECT_GT(contrast(found), 0.4);
}

TEST(Footprint, IsAsWideAsSamplesAreApart) {
    // A period is 5 pixels wide: one pixel tells its halves apart, 4 do not.
    const Scene scene = wall_of_checks(1.0F, 1.0F, 2.0F * 5.0F / kSize);
    const SamplePlan full = test::full_plan(kSize, kSize);
    const auto dense = radiance(scene, full, 1.0F);
    const auto sparse = radiance(scene, sparse_plan(), 1.0F);
    EXPECT_GT(contrast(dense), 0.3);
    EXPECT_LT(contrast(sparse), 0.3 * contrast(dense));
    // The tracer's factor counts as the plan's spacing does.
    EXPECT_EQ(sparse, radiance(scene, full, 4.0F));
    EXPECT_EQ(dense, radiance(scene, sparse_plan(), 0.25F));
}

TEST(Footprint, WidensOnItsWayThroughAMirror) {
    Scene scene;
    Material mirror = test::white();
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    test::add(scene, test::wall({0.0F, 0.0F, -1.0F}, 3.0F), mirror);
    const glm::mat4 behind = glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, 9.0F)), glm::radians(180.0F),
                                         vec3(0.0F, 1.0F, 0.0F));
    add_checks(scene, 15.0F, 0.07F, TextureFilter::linear, behind);
    const SamplePlan plan = test::full_plan(kSize, kSize);
    for (const vec3& r : radiance(scene, plan, 1.0F)) ASSERT_NEAR(r.x, 0.5F, 3e-3F);
    EXPECT_GT(contrast(radiance(scene, plan, 0.0F)), 0.3);
}

TEST(Footprint, IsWiderTheRougherAMirrorIs) {
    const auto seen = [](float roughness) {
        Scene scene;
        Material metal = test::white();
        metal.metallic = 1.0F;
        metal.roughness = roughness;
        test::add(scene, test::wall({0.0F, 0.0F, -1.0F}, 3.0F), metal);
        const glm::mat4 behind = glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, 3.0F)),
                                             glm::radians(180.0F), vec3(0.0F, 1.0F, 0.0F));
        add_checks(scene, 6.0F, 1.0F, TextureFilter::linear, behind);
        return contrast(radiance(scene, test::full_plan(kSize, kSize), 1.0F));
    };
    EXPECT_GT(seen(0.0F), 0.3);
    EXPECT_GT(seen(0.0F), 1.1 * seen(0.12F));
    EXPECT_GT(seen(0.12F), 1.5 * seen(0.2F));
    EXPECT_GT(seen(0.12F), 0.05);
}

}  // namespace
}  // namespace macula
