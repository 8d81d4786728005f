// Mirrors, glass, coverage and rectangular lights together, in random scenes, against a slow recursive tracer.

#include <gtest/gtest.h>

#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/support/slow_radiance.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec3;

/// Nearer to an edge than this, floats may see another surface.
constexpr double kMargin = 2e-3;

class SceneMaker {
public:
    explicit SceneMaker(std::uint32_t seed) : random_(seed) {}

    /// `unlit`: surfaces that shine in graded colours; otherwise matt ones below a luminous square.
    Scene make(bool unlit) {
        Scene scene;
        scene.background_radiance = vec3(0.05F, 0.1F, 0.2F);
        const auto matt = [&] { return unlit ? test::unlit() : lambertian(); };
        add_chart(scene, make_quad({-8.0F, -1.5F, -8.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 12.0F}), matt());
        add_chart(scene, make_quad({-8.0F, 5.0F, -7.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, -7.0F, 0.0F}), matt());
        for (int i = 0; i < 3; ++i) add_chart(scene, box(), matt(), anywhere());
        Material metal = test::white();
        metal.metallic = 1.0F;
        metal.roughness = 0.0F;
        metal.base_color = glm::vec4(0.9F, 0.7F, 0.4F, 1.0F);
        for (int i = 0; i < 2; ++i) test::add(scene, box(), metal, anywhere());
        Material glass = test::white();
        glass.roughness = 0.0F;
        glass.transmission = 1.0F;
        glass.thickness_m = 1.0F;
        glass.ior = 1.5F;
        test::add(scene, make_box({2.0F, 1.5F, 0.4F}), glass, anywhere());
        for (int i = 0; i < 2; ++i) {
            Material film = matt();
            film.base_color = glm::vec4(0.5F, 0.9F, 0.3F, 0.4F);
            film.alpha_mode = AlphaMode::blend;
            film.double_sided = true;
            test::add(scene, test::wall(vec3(0.0F), 0.8F), film, anywhere());
        }
        if (!unlit) add_luminous_square(scene);
        return scene;
    }

private:
    float unit() { return std::uniform_real_distribution<float>(-1.0F, 1.0F)(random_); }
    vec3 vector() {
        const float x = unit();
        const float y = unit();
        return {x, y, unit()};
    }
    Mesh box() { return make_box(vec3(0.9F) + 0.4F * vector()); }
    glm::mat4 anywhere() {
        const vec3 place = vec3(0.0F, -0.4F, -4.2F) + vec3(2.2F, 1.0F, 1.5F) * vector();
        const vec3 axis = glm::normalize(vector() + vec3(0.0F, 1.5F, 0.0F));
        return glm::rotate(glm::translate(glm::mat4(1.0F), place), 3.0F * unit(), axis);
    }
    static Material lambertian() {
        Material material = test::white();
        material.specular = 0.0F;
        return material;
    }
    void add_chart(Scene& scene, Mesh mesh, const Material& material, const glm::mat4& place = glm::mat4(1.0F)) {
        for (std::size_t i = 0; i < mesh.position_m.size(); ++i)
            mesh.color.emplace_back(vec3(0.5F) + 0.4F * vector(), 1.0F);
        test::add(scene, std::move(mesh), material, place);
    }
    static void add_luminous_square(Scene& scene) {
        Material lamp = test::white();
        lamp.base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        lamp.specular = 0.0F;
        lamp.emissive = vec3(80.0F, 70.0F, 60.0F);
        const auto object =
            test::add(scene, make_quad({-0.7F, 3.0F, -2.8F}, {1.4F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.4F}), lamp);
        Light light;
        light.kind = LightKind::rectangle;
        light.position_m = vec3(0.0F, 3.0F, -3.5F);
        light.direction = vec3(0.0F, -1.0F, 0.0F);
        light.half_u_m = vec3(0.7F, 0.0F, 0.0F);
        light.half_v_m = vec3(0.0F, 0.0F, 0.7F);
        light.intensity = lamp.emissive;
        light.instance = static_cast<int>(object) - 1;
        scene.lights.push_back(light);
    }

    std::mt19937 random_;
};

TracerOptions all_rays(int bounces) {
    TracerOptions options;
    options.bounces = bounces;
    options.bounce_bound = 0.0F;
    options.light_samples = 64;
    return options;
}

TEST(SecondaryRaysAgainstRecursion, SeeTheSame) {
    constexpr int kSize = 40;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Scene scene = SceneMaker(seed).make(true);
        const int bounces = 1 + static_cast<int>(seed % 3);
        TraceCounts counts;
        const test::Traced traced = test::trace(scene, test::square_view(kSize), all_rays(bounces), 0.0, &counts);
        EXPECT_GT(counts.reflection, 50U);
        EXPECT_GT(counts.transmission, 50U);
        const test::SlowRadiance slow(scene, 1);
        int checked = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const test::SlowSight sight = slow.along(dvec3(0.0), dvec3(traced.tangents(x, y), -1.0F), bounces);
                if (sight.margin < kMargin) continue;
                ++checked;
                // The largest part is the tracer's curve for the mean of Schlick's reflectance over a narrow lobe.
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(traced.radiance(x, y)[c], sight.radiance[c], 8e-4) << x << ", " << y;
            }
        }
        EXPECT_GT(checked, kSize * kSize * 9 / 10);
    }
}

TEST(SecondaryRaysAgainstRecursion, AreLitTheSame) {
    constexpr int kSize = 16;
    for (std::uint32_t seed = 11; seed <= 14; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Scene scene = SceneMaker(seed).make(false);
        const test::Traced traced = test::trace(scene, test::square_view(kSize), all_rays(1));
        const test::SlowRadiance slow(scene, 32);
        int checked = 0;
        double sum_of_error = 0.0;
        double sum_of_light = 0.0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const test::SlowSight sight = slow.along(dvec3(0.0), dvec3(traced.tangents(x, y), -1.0F), 1);
                if (sight.margin < kMargin) continue;
                ++checked;
                // 64 shadow rays tell where an edge crosses the light to a few hundredths.
                const double error = static_cast<double>(traced.radiance(x, y).y) - sight.radiance.y;
                ASSERT_NEAR(error, 0.0, 0.05 * sight.open.y + 0.01) << x << ", " << y;
                sum_of_error += error;
                sum_of_light += sight.open.y;
            }
        }
        EXPECT_GT(checked, kSize * kSize * 9 / 10);
        EXPECT_NEAR(sum_of_error / sum_of_light, 0.0, 0.001);
    }
}

}  // namespace
}  // namespace macula
