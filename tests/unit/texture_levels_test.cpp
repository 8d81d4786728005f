// Mip levels: what averaging must keep, and what it must not mix.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "scenes/texel.h"
#include "server/kernels/color.h"
#include "server/render/texture_levels.h"
#include "tests/support/texture_image.h"

namespace macula {
namespace {

using glm::vec3;
using glm::vec4;
using test::make_image;

/// The image that a level is.
TextureImage level_image(const TextureImage& of, const TextureLevel& level) {
    TextureImage image{"level", level.size_px.x, level.size_px.y, of.channels, of.type, of.srgb, {}};
    image.texels.assign(level.texels, level.texels + image.texel_count() * image.texel_bytes());
    return image;
}

float linear(float coded) {
    return kernels::linear_from_srgb(coded);
}

vec4 mean(const TextureImage& image) {
    glm::dvec4 sum(0.0);
    for (std::size_t i = 0; i < image.texel_count(); ++i) sum += glm::dvec4(stored_texel(image, i));
    return vec4(sum / static_cast<double>(image.texel_count()));
}

TEST(TextureLevels, HalveToOneTexel) {
    const TextureImage image = make_image(20, 3, 3, TexelType::u8, [](int, int) { return vec4(0.5F); });
    const TextureLevels levels(image, TextureContent::values);
    std::vector<glm::ivec2> sizes;
    for (const TextureLevel& level : levels.levels()) sizes.push_back(level.size_px);
    EXPECT_EQ(sizes, (std::vector<glm::ivec2>{{20, 3}, {10, 1}, {5, 1}, {2, 1}, {1, 1}}));
    EXPECT_EQ(levels.levels()[0].texels, image.texels.data()) << "the image itself is not copied";
    EXPECT_EQ(levels.memory_bytes(), 3U * (10 + 5 + 2 + 1));
}

TEST(TextureLevels, AConstantImageStaysConstantInEveryFormat) {
    for (const TexelType type : {TexelType::u8, TexelType::u16, TexelType::f16, TexelType::f32})
        for (int channels = 1; channels <= 4; ++channels)
            for (const bool srgb : {false, true}) {
                const TextureImage image = make_image(
                    13, 7, channels, type, [](int, int) { return vec4(0.2F, 0.4F, 0.6F, 0.8F); }, srgb);
                for (const TextureContent content : {TextureContent::values, TextureContent::covered_color}) {
                    const TextureLevels levels(image, content);
                    for (const TextureLevel& level : levels.levels()) {
                        const TextureImage small = level_image(image, level);
                        for (std::size_t i = 0; i < small.texel_count(); ++i)
                            for (int c = 0; c < 4; ++c)
                                EXPECT_NEAR(stored_texel(small, i)[c], stored_texel(image, 0)[c], 1e-4F)
                                    << static_cast<int>(type) << ' ' << channels << ' ' << srgb;
                    }
                }
            }
}

TEST(TextureLevels, KeepTheMeanOfAnySize) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    for (const glm::ivec2 size : {glm::ivec2(32, 32), glm::ivec2(31, 17), glm::ivec2(7, 64), glm::ivec2(3, 3)}) {
        const TextureImage image = make_image(size.x, size.y, 3, TexelType::f32, [&](int, int) {
            return vec4(uniform(random), uniform(random), uniform(random), 1.0F);
        });
        const TextureLevels levels(image, TextureContent::values);
        for (const TextureLevel& level : levels.levels())
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(mean(level_image(image, level))[c], mean(image)[c], 2e-6F) << size.x << " x " << size.y;
    }
}

TEST(TextureLevels, OddSizesAreWeightedByArea) {
    // A ramp is its own mean everywhere: texel i of n covers (i, i + 1) / n.
    const TextureImage image =
        make_image(11, 1, 1, TexelType::f32, [](int x, int) { return vec4((static_cast<float>(x) + 0.5F) / 11.0F); });
    const TextureLevels levels(image, TextureContent::values);
    const TextureImage half = level_image(image, levels.levels()[1]);
    ASSERT_EQ(half.width_px, 5);
    // Texel i of 5 covers 2.2 texels: of the step-wise ramp, not of the smooth one.
    for (int i = 0; i < 5; ++i) {
        double sum = 0.0;
        for (int k = 0; k < 2200; ++k) sum += std::floor(2.2 * i + (k + 0.5) / 1000.0) + 0.5;
        EXPECT_NEAR(stored_texel(half, static_cast<std::size_t>(i)).x, sum / 2200.0 / 11.0, 1e-4) << i;
    }
}

TEST(TextureLevels, ColoursAreAveragedInLinearLight) {
    const TextureImage image = make_image(
        2, 1, 3, TexelType::u8, [](int x, int) { return vec4(static_cast<float>(x)); }, true);
    const TextureLevels levels(image, TextureContent::values);
    EXPECT_NEAR(linear(stored_texel(level_image(image, levels.levels()[1]), 0).x), 0.5F, 0.003F);
}

TEST(TextureLevels, HiddenColoursDoNotBleed) {
    const TextureImage image = make_image(2, 1, 4, TexelType::f32, [](int x, int) {
        return x == 0 ? vec4(1.0F, 0.0F, 0.0F, 1.0F) : vec4(0.0F, 1.0F, 0.0F, 0.0F);
    });
    const TextureLevels covered(image, TextureContent::covered_color);
    const vec4 mixed = stored_texel(level_image(image, covered.levels()[1]), 0);
    EXPECT_NEAR(mixed.x, 1.0F, 2e-3F);
    EXPECT_NEAR(mixed.y, 0.0F, 2e-3F);
    EXPECT_NEAR(mixed.w, 0.5F, 1e-6F);
    const TextureLevels values(image, TextureContent::values);
    EXPECT_NEAR(stored_texel(level_image(image, values.levels()[1]), 0).y, 0.5F, 1e-6F)
        << "alpha is not coverage there";
    const TextureImage hidden =
        make_image(2, 2, 4, TexelType::f32, [](int x, int y) { return vec4(x, y, 1.0F, 0.0F); });
    const TextureLevels all(hidden, TextureContent::covered_color);
    EXPECT_NEAR(stored_texel(level_image(hidden, all.levels()[1]), 0).x, 0.5F, 1e-3F) << "hidden, but not undefined";
}

TEST(TextureLevels, TheCutOffShareIsKept) {
    // Thin wires: a mean alpha of .2 would cut all of them away at cutoff .5.
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    const TextureImage image = make_image(128, 128, 4, TexelType::u8, [&](int x, int y) {
        return vec4(1.0F, 1.0F, 1.0F, x % 8 == 0 || y % 11 == 0 ? 1.0F : 0.2F * uniform(random));
    });
    const auto share = [](const TextureImage& level) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < level.texel_count(); ++i) count += stored_texel(level, i).w >= 0.5F ? 1 : 0;
        return static_cast<float>(count) / static_cast<float>(level.texel_count());
    };
    const TextureLevels kept(image, TextureContent::covered_color, 0.5F);
    const TextureLevels plain(image, TextureContent::covered_color);
    const float wanted = share(image);
    EXPECT_NEAR(wanted, 0.2F, 0.02F);
    for (std::size_t i = 1; kept.levels()[i].size_px.x >= 8; ++i)
        EXPECT_NEAR(share(level_image(image, kept.levels()[i])), wanted, 0.05F) << "level " << i;
    EXPECT_EQ(share(level_image(image, plain.levels()[4])), 0.0F);
}

/// Normal and variance of a texel of a level below the image.
vec4 normal_of(const TextureLevel& level, std::size_t i) {
    const std::uint8_t* codes = level.texels + 3 * i;
    const vec3 unit = vec3(codes[0], codes[1], codes[2]) / 255.0F;
    const glm::vec2 xy = glm::vec2(unit) * 2.0F - 1.0F;
    return {xy, std::sqrt(std::max(0.0F, 1.0F - glm::dot(xy, xy))), unit.z * unit.z};
}

vec4 coded(const vec3& normal) {
    return vec4(glm::normalize(normal) * 0.5F + 0.5F, 1.0F);
}

TEST(TextureLevels, FlatAndSlantedNormalsHaveNoVariance) {
    for (const vec3 normal : {vec3(0, 0, 1), vec3(0.3F, -0.4F, 1.0F)}) {
        const TextureImage image = make_image(16, 16, 3, TexelType::f32, [&](int, int) { return coded(normal); });
        const TextureLevels levels(image, TextureContent::normals);
        for (std::size_t i = 1; i < levels.levels().size(); ++i) {
            const vec4 mean_normal = normal_of(levels.levels()[i], 0);
            EXPECT_LT(glm::distance(vec3(mean_normal), glm::normalize(normal)), 0.006F);
            EXPECT_EQ(mean_normal.w, 0.0F);
        }
    }
}

TEST(TextureLevels, TheSpreadOfNormalsBecomesVariance) {
    // Slopes of a Gaussian of standard deviation s on each axis widen a Beckmann-like lobe by alpha^2 = 2 s^2. (A slope
    // is the tangent of the angle that a mean vector's length tells of; at .2 that is 17 % in the square.)
    std::mt19937 random(3);
    for (const float s : {0.02F, 0.05F, 0.1F, 0.2F}) {
        std::normal_distribution<float> slope(0.0F, s);
        const TextureImage image = make_image(128, 128, 3, TexelType::f32, [&](int, int) {
            return coded({slope(random), slope(random), 1.0F});
        });
        const TextureLevels levels(image, TextureContent::normals);
        const vec4 top = normal_of(levels.levels().back(), 0);
        EXPECT_NEAR(top.w, 2.0F * s * s, (s < 0.15F ? 0.1F : 0.2F) * 2.0F * s * s) << "slope deviation " << s;
        EXPECT_GT(top.z, 0.999F);
    }
}

TEST(TextureLevels, LostVarianceIsMonotonicAndBounded) {
    EXPECT_EQ(lost_variance(1.0F), 0.0F);
    EXPECT_EQ(lost_variance(0.0F), 1.0F);
    float last = 0.0F;
    for (float r = 1.0F; r > 0.0F; r -= 0.01F) {
        EXPECT_GE(lost_variance(r), last);
        last = lost_variance(r);
    }
}

}  // namespace
}  // namespace macula
