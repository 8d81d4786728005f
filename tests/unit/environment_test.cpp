// Prefiltered environments against sums over the whole map.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>

#include "server/render/environment.h"
#include "tests/support/texture_image.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using test::make_image;

constexpr double kPi = std::numbers::pi;

/// Direction of the middle of texel (x, y), by the definition in scene.h.
dvec3 direction_of(double x, double y, int width, int height) {
    const double phi = 2.0 * kPi * (x + 0.5) / width;
    const double theta = kPi * (y + 0.5) / height;
    return {-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta)};
}

/// Calls `use(direction, solid angle, radiance)` for grid x grid points of every bright texel of a grey map.
template <class Use>
void for_each_direction(const TextureImage& image, int grid, Use&& use) {
    const double area = 2.0 * kPi * kPi / (image.width_px * image.height_px * grid * grid);
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            float value = 0.0F;
            std::memcpy(&value, image.texels.data() + image.texel_bytes() * (y * image.width_px + x), sizeof(value));
            if (value == 0.0F) continue;
            for (int j = 0; j < grid; ++j)
                for (int i = 0; i < grid; ++i) {
                    const double sub_y = y + (j + 0.5) / grid - 0.5;
                    const dvec3 d = direction_of(x + (i + 0.5) / grid - 0.5, sub_y, image.width_px, image.height_px);
                    use(d, area * std::sin(kPi * (sub_y + 0.5) / image.height_px), double{value});
                }
        }
}

/// GGX of half vectors around a normal that is also the view, times the cosine: what a direction counts.
double lobe_weight(double cosine, double roughness) {
    if (cosine <= 0.0) return 0.0;
    const double alpha_sq = std::pow(roughness, 4.0);
    const double d = (alpha_sq - 1.0) * (1.0 + cosine) / 2.0 + 1.0;
    return alpha_sq / (kPi * d * d) * cosine;
}

/// Integral of lobe_weight over the hemisphere.
double lobe_total(double roughness) {
    double sum = 0.0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps;  // dense where the lobe is: cosine = 1 - t^4
        sum += lobe_weight(1.0 - t * t * t * t, roughness) * 4.0 * t * t * t / kSteps;
    }
    return 2.0 * kPi * sum;
}

TextureImage constant_map(TexelType type, int channels, float value) {
    return make_image(64, 32, channels, type, [value](int, int) { return vec4(value); });
}

/// A sky: bright above, a soft sun, a dark ground.
TextureImage sky() {
    return make_image(256, 128, 1, TexelType::f32, [](int x, int y) {
        const dvec3 d = direction_of(x, y, 256, 128);
        const double sun = std::exp(-60.0 * (1.0 - glm::dot(d, glm::normalize(dvec3(0.5, 0.6, -0.6)))));
        return vec4(static_cast<float>((d.y > 0.0 ? 1.0 + d.y : 0.2) + 8.0 * sun));
    });
}

vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

TEST(Environment, AConstantMapIsTheSameForAllDirectionsAndRoughness) {
    std::mt19937 random(1);
    for (const TexelType type : {TexelType::u8, TexelType::u16, TexelType::f16, TexelType::f32})
        for (const int channels : {1, 3}) {
            const TextureImage image = constant_map(type, channels, 0.6F);
            const EnvironmentMap map(image, 2.0F, 0.7F);
            for (int i = 0; i < 200; ++i) {
                const vec3 d = i == 0 ? vec3(0, 1, 0) : (i == 1 ? vec3(0, -1, 0) : random_direction(random));
                const float size = static_cast<float>(i) / 199.0F;
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(map.radiance(d, 3.0F * size)[c], 1.2F, 1.2e-3F);
                    EXPECT_NEAR(map.glossy_radiance(d, size)[c], 1.2F, 1.2e-3F);
                    EXPECT_NEAR(map.irradiance(d)[c], 1.2F * static_cast<float>(kPi), 4e-3F);
                }
            }
        }
}

TEST(Environment, DirectionsLieWhereTheSceneSaysAndTurnWithTheMap) {
    // Quarters of the horizon: +Z, -X, -Z, +X, each around its middle.
    const TextureImage image = make_image(64, 32, 3, TexelType::f32, [](int x, int y) {
        const int quarter = (x + 8) / 16 % 4;
        return vec4(static_cast<float>(quarter), y < 16 ? 1.0F : 0.0F, 0.0F, 1.0F);
    });
    const EnvironmentMap map(image, 1.0F, 0.0F);
    const vec3 quarters[] = {vec3(0, 0, 1), vec3(-1, 0, 0), vec3(0, 0, -1), vec3(1, 0, 0)};
    for (int q = 0; q < 4; ++q) {
        EXPECT_NEAR(map.radiance(quarters[q] + vec3(0, 0.3F, 0), 0.0F).x, static_cast<float>(q), 1e-5F);
        EXPECT_NEAR(map.radiance(quarters[q] + vec3(0, 0.3F, 0), 0.0F).y, 1.0F, 1e-5F);
        EXPECT_NEAR(map.radiance(quarters[q] * 5.0F - vec3(0, 0.3F, 0), 0.0F).y, 0.0F, 1e-5F) << "of any length";
    }
    // A quarter turn counter-clockwise from above takes +Z to +X.
    const EnvironmentMap turned(image, 1.0F, static_cast<float>(kPi / 2));
    EXPECT_NEAR(turned.radiance(vec3(1, 0.3F, 0), 0.0F).x, 0.0F, 1e-5F);
    EXPECT_NEAR(turned.radiance(vec3(0, 0.3F, 1), 0.0F).x, 1.0F, 1e-5F);
    EXPECT_NEAR(turned.irradiance(vec3(1, 0, 0)).x, map.irradiance(vec3(0, 0, 1)).x, 1e-4F);
    EXPECT_NEAR(turned.irradiance(vec3(0, 0, -1)).x, map.irradiance(vec3(1, 0, 0)).x, 1e-4F);
    EXPECT_NEAR(turned.glossy_radiance(vec3(1, 0, 0), 0.5F).x, map.glossy_radiance(vec3(0, 0, 1), 0.5F).x, 1e-3F);
}

TEST(Environment, AnglesAreExactEnough) {
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        const vec3 d = random_direction(random) * (i % 2 == 0 ? 1.0F : 37.0F);
        const vec2 uv = kernels::lat_long_uv(d, 0.3F);
        double u = (std::atan2(-double{d.x}, double{d.z}) + 0.3) / (2.0 * kPi);
        u -= std::floor(u);
        const double v = std::atan2(std::hypot(double{d.x}, double{d.z}), double{d.y}) / kPi;
        EXPECT_LT(std::abs(std::remainder(uv.x - u, 1.0)), 1e-6);
        EXPECT_NEAR(uv.y, v, 2e-6);
    }
    for (const vec3 d : {vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 0), vec3(-1e-30F, 0, 1), vec3(1e-30F, 0, 1)}) {
        const vec2 uv = kernels::lat_long_uv(d, 0.0F);
        EXPECT_TRUE(uv.x >= 0.0F && uv.x < 1.0F && uv.y >= 0.0F && uv.y <= 1.0F) << uv.x << ' ' << uv.y;
    }
}

TEST(Environment, OneBrightTexelIsSpreadAsTheLobeIs) {
    const TextureImage image =
        make_image(128, 64, 1, TexelType::f32, [](int x, int y) { return vec4(x == 40 && y == 25 ? 1000.0F : 0.0F); });
    const EnvironmentMap map(image, 1.0F, 0.0F);
    const dvec3 bright = direction_of(40, 25, 128, 64);
    const dvec3 side = glm::normalize(glm::cross(bright, dvec3(0, 1, 0)));
    for (const double roughness : {0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0}) {
        const double total = lobe_total(roughness);
        double peak = 0.0;
        double worst = 0.0;
        for (int step = 0; step < 20; ++step) {
            const double angle = step * 0.08;
            const dvec3 at = bright * std::cos(angle) + side * std::sin(angle);
            double wanted = 0.0;
            for_each_direction(image, 8, [&](const dvec3& d, double solid_angle, double value) {
                wanted += lobe_weight(glm::dot(d, at), roughness) * solid_angle * value / total;
            });
            peak = std::max(peak, wanted);
            worst = std::max(worst, std::abs(map.glossy_radiance(vec3(at), static_cast<float>(roughness)).x - wanted));
        }
        RecordProperty("error_percent_of_peak_at_" + std::to_string(roughness), std::to_string(100.0 * worst / peak));
        EXPECT_LT(worst, 0.07 * peak) << "roughness " << roughness;
    }
}

TEST(Environment, ASkyIsReflectedAsTheIntegralSays) {
    const TextureImage image = sky();
    const EnvironmentMap map(image, 1.0F, 0.0F);
    std::mt19937 random(3);
    for (const double roughness : {0.1, 0.15, 0.3, 0.5, 0.7, 1.0}) {
        const double total = lobe_total(roughness);
        for (int i = 0; i < 3; ++i) {
            const vec3 at = random_direction(random);
            double wanted = 0.0;
            for_each_direction(image, 1, [&](const dvec3& d, double solid_angle, double value) {
                wanted += lobe_weight(glm::dot(d, dvec3(at)), roughness) * solid_angle * value / total;
            });
            EXPECT_NEAR(map.glossy_radiance(at, static_cast<float>(roughness)).x, wanted, 0.03 * wanted + 0.01)
                << "roughness " << roughness;
        }
    }
}

TEST(Environment, IrradianceIsWithinTheBoundsOfNineHarmonics) {
    struct Case {
        const char* what;
        TextureImage image;
        double bound;  ///< of the largest irradiance
    };
    // The terms of a cosine beyond order 2 reach 9.4 % (at its edge) of what faces a distant point of light.
    const Case cases[] = {
        {"sky", sky(), 0.03},
        {"one bright texel",
         make_image(128, 64, 1, TexelType::f32, [](int x, int y) { return vec4(x == 40 && y == 25 ? 1000.0F : 0.0F); }),
         0.096}};
    std::mt19937 random(4);
    for (const Case& c : cases) {
        const EnvironmentMap map(c.image, 1.0F, 0.0F);
        double worst = 0.0;
        double largest = 0.0;
        for (int i = 0; i < 12; ++i) {
            const dvec3 n(i == 0 ? dvec3(direction_of(40, 25, 128, 64)) : dvec3(random_direction(random)));
            double wanted = 0.0;
            for_each_direction(c.image, 1, [&](const dvec3& d, double solid_angle, double value) {
                wanted += std::max(glm::dot(n, d), 0.0) * solid_angle * value;
            });
            largest = std::max(largest, wanted);
            worst = std::max(worst, std::abs(map.irradiance(vec3(n)).x - wanted));
            EXPECT_GE(map.irradiance(vec3(n)).x, 0.0F);
        }
        RecordProperty(std::string("error_percent of ") + c.what, std::to_string(100.0 * worst / largest));
        EXPECT_LT(worst, c.bound * largest) << c.what;
    }
}

TEST(Environment, ConesKeepTheLightOfTheMap) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    for (const glm::ivec2 size : {glm::ivec2(128, 64), glm::ivec2(100, 50)}) {
        const TextureImage image =
            make_image(size.x, size.y, 1, TexelType::f32, [&](int, int) { return vec4(uniform(random)); });
        const EnvironmentMap map(image, 1.0F, 0.0F);
        const auto light = [&](float width) {
            double sum = 0.0;
            double area = 0.0;
            for (int y = 0; y < 100; ++y)
                for (int x = 0; x < 200; ++x) {
                    const double weight = std::sin(kPi * (y + 0.5) / 100.0);
                    sum += weight * map.radiance(vec3(direction_of(x, y, 200, 100)), width).x;
                    area += weight;
                }
            return sum / area;
        };
        const double whole = light(0.0F);
        for (const float width : {0.1F, 0.3F, 0.7F}) EXPECT_NEAR(light(width), whole, 0.005) << width;
    }
}

TEST(Environment, HasNeitherSeamNorPole) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    const TextureImage image = make_image(64, 32, 1, TexelType::f32, [&](int, int) { return vec4(uniform(random)); });
    const EnvironmentMap map(image, 1.0F, 0.2F);
    for (const float size : {0.0F, 0.15F, 0.35F, 0.7F, 1.0F})
        for (int i = 0; i < 300; ++i) {
            const float angle = static_cast<float>(i) * 0.021F;
            const vec3 around(std::sin(angle), 0.0F, std::cos(angle));
            for (const vec3 pole : {vec3(0, 1, 0), vec3(0, -1, 0)}) {
                EXPECT_NEAR(map.radiance(pole + around * 1e-5F, size).x, map.radiance(pole, size).x, 1e-3F);
                EXPECT_NEAR(map.glossy_radiance(pole + around * 1e-5F, size).x, map.glossy_radiance(pole, size).x,
                            1e-3F);
            }
            // Once around, at any height, no step is larger than a texel's slope allows.
            const vec3 next(std::sin(angle + 1e-4F), 0.0F, std::cos(angle + 1e-4F));
            const vec3 height(0.0F, std::tan(angle - 3.0F), 0.0F);
            EXPECT_NEAR(map.radiance(around + height, size).x, map.radiance(next + height, size).x, 4e-3F);
            EXPECT_NEAR(map.glossy_radiance(around + height, size).x, map.glossy_radiance(next + height, size).x,
                        4e-3F);
        }
}

TEST(Environment, IsReadySoon) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    const TextureImage image =
        make_image(1024, 512, 3, TexelType::f16, [&](int, int) { return vec4(uniform(random)); });
    const auto start = std::chrono::steady_clock::now();
    const EnvironmentMap map(image, 1.0F, 0.0F);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    RecordProperty("seconds", std::to_string(seconds));
    EXPECT_LT(seconds, 30.0) << "sanitizers and busy machines included";
    EXPECT_LT(map.memory_bytes(), std::size_t{5} << 20U);
}

}  // namespace
}  // namespace macula
