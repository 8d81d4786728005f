// Lookups through all of a texture's sizes: formats, means, detail, wrapping, normals.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "server/kernels/color.h"
#include "server/render/texture_lookup.h"
#include "tests/support/texture_image.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using kernels::UvFootprint;
using test::make_image;

/// A footprint of `u` x `v` texels along the axes.
UvFootprint texels(const TextureImage& image, float u, float v) {
    return {vec2(u / static_cast<float>(image.width_px), 0.0F), vec2(0.0F, v / static_cast<float>(image.height_px))};
}

/// A texture that is used without a transform.
struct Fixture {
    TextureImage image;
    TextureLibrary library;
    TextureView view;

    explicit Fixture(TextureImage from, TextureContent content = TextureContent::values,
                     TextureWrap wrap = TextureWrap::repeat, TextureFilter filter = TextureFilter::linear)
        : image(std::move(from)) {
        TextureUse use;
        use.image = 0;
        use.wrap_u = use.wrap_v = wrap;
        use.filter = filter;
        view = library.view(use, image, content);
    }
};

TextureImage checkerboard(int size_px) {
    return make_image(size_px, size_px, 1, TexelType::u8,
                      [](int x, int y) { return vec4((x + y) % 2 == 0 ? 1.0F : 0.0F); });
}

TEST(TextureLookup, EveryFormatReadsTheSameColours) {
    const auto color = [](int x, int y) {
        return vec4(static_cast<float>(x) / 8.0F, static_cast<float>(y) / 8.0F, 0.25F,
                    1.0F - static_cast<float>(x) / 8.0F);
    };
    const auto shown = [](vec4 v, int channels, bool srgb) {
        if (channels < 3) v = vec4(v.x, v.x, v.x, v.w);
        if (channels % 2 == 1) v.w = 1.0F;
        for (int c = 0; c < 3 && srgb; ++c) v[c] = kernels::linear_from_srgb(v[c]);
        return v;
    };
    for (const TexelType type : {TexelType::u8, TexelType::u16, TexelType::f16, TexelType::f32})
        for (int channels = 1; channels <= 4; ++channels)
            for (const bool srgb : {false, true}) {
                if (srgb && (type == TexelType::f16 || type == TexelType::f32)) continue;  // always linear
                const Fixture f(make_image(8, 8, channels, type, color, srgb));
                const float tolerance = type == TexelType::u8 ? 0.006F : 1e-3F;
                for (int y = 0; y < 7; ++y)
                    for (int x = 0; x < 7; ++x) {
                        const vec2 at = (vec2(x, y) + vec2(0.5F)) / 8.0F;
                        const vec4 here = shown(color(x, y), channels, srgb);
                        const vec4 right = shown(color(x + 1, y), channels, srgb);
                        const vec4 got = look_up(f.view, at);
                        const vec4 between = look_up(f.view, at + vec2(0.25F / 8.0F, 0.0F));
                        for (int c = 0; c < 4; ++c) {
                            EXPECT_NEAR(got[c], here[c], tolerance);
                            EXPECT_NEAR(between[c], glm::mix(here[c], right[c], 0.25F), tolerance);
                        }
                    }
            }
}

TEST(TextureLookup, SixteenBitSrgbIsExactButForRounding) {
    const Fixture f(make_image(
                        256, 256, 1, TexelType::u16,
                        [](int x, int y) { return vec4(static_cast<float>(y * 256 + x) / 65535.0F); }, true),
                    TextureContent::values, TextureWrap::repeat, TextureFilter::nearest);
    for (int code = 0; code < 65536; code += 7) {
        const vec2 at = (vec2(code % 256, code / 256) + vec2(0.5F)) / 256.0F;
        EXPECT_NEAR(look_up(f.view, at).x, kernels::linear_from_srgb(static_cast<float>(code) / 65535.0F), 4e-7F);
    }
}

TEST(TextureLookup, HalfFloatsKeepTheirWholeRange) {
    const float values[] = {0.0F, 6e-8F, 6.1e-5F, 1.0F, 2.5F, 65504.0F, -0.75F, 1000.0F};
    const Fixture f(make_image(8, 1, 1, TexelType::f16, [&](int x, int) { return vec4(values[x]); }),
                    TextureContent::values, TextureWrap::repeat, TextureFilter::nearest);
    for (int x = 0; x < 8; ++x)
        EXPECT_EQ(look_up(f.view, vec2((static_cast<float>(x) + 0.5F) / 8.0F, 0.5F)).x,
                  glm::unpackHalf1x16(glm::packHalf1x16(values[x])));
}

TEST(TextureLookup, NoFootprintReadsTheImageItself) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(-2.0F, 2.0F);
    const Fixture f(checkerboard(16));
    for (int i = 0; i < 200; ++i) {
        const vec2 at(uniform(random), uniform(random));
        EXPECT_EQ(look_up(f.view, at), look_up(f.view, at, UvFootprint{vec2(0.0F), vec2(0.0F)}));
        EXPECT_EQ(look_up(f.view, at), look_up(f.view, at, texels(f.image, 1.0F, 0.5F)));
    }
}

TEST(TextureLookup, ACheckerboardFarAwayIsItsMean) {
    const Fixture f(checkerboard(64));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    float worst_before = 1.0F;
    for (const float size : {1.0F, 1.5F, 2.0F, 4.0F, 64.0F, 1000.0F}) {
        float worst = 0.0F;
        for (int i = 0; i < 300; ++i) {
            const vec4 got = look_up(f.view, vec2(uniform(random), uniform(random)), texels(f.image, size, size));
            worst = std::max(worst, std::abs(got.x - 0.5F));
        }
        EXPECT_LE(worst, worst_before) << size;
        EXPECT_LT(worst, size < 2.0F ? 0.51F : 0.003F) << size;
        worst_before = worst;
    }
}

TEST(TextureLookup, AFootprintSeesAsMuchAsABoxOfItsSize) {
    // Noise: the lookup's deviation from the mean must fall with the footprint as that of a box filter does.
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    const Fixture f(make_image(256, 256, 1, TexelType::f32, [&](int, int) { return vec4(uniform(random)); }));
    for (const float size : {2.0F, 3.0F, 6.0F, 16.0F}) {
        double sum_sq = 0.0;
        for (int i = 0; i < 4000; ++i) {
            const float got = look_up(f.view, vec2(uniform(random), uniform(random)), texels(f.image, size, size)).x;
            sum_sq += (got - 0.5) * (got - 0.5);
        }
        const double deviation = std::sqrt(sum_sq / 4000.0);
        const double box = 1.0 / std::sqrt(12.0) / size;
        EXPECT_LT(deviation, box) << size << ": bilinear mixing smooths further";
        EXPECT_GT(deviation, 0.45 * box) << size << ": but not much";
    }
}

TEST(TextureLookup, SlantedSurfacesKeepDetailAlongTheShorterAxis) {
    // Stripes of 8 texels, seen under a footprint of 2 texels across them and 16 along.
    const Fixture f(
        make_image(256, 256, 1, TexelType::u8, [](int x, int) { return vec4(static_cast<float>(x / 8 % 2)); }));
    const vec2 white((8.0F + 4.0F) / 256.0F, 0.37F);
    const vec2 black((16.0F + 4.0F) / 256.0F, 0.37F);
    EXPECT_GT(look_up(f.view, white, texels(f.image, 2.0F, 16.0F)).x, 0.99F);
    EXPECT_LT(look_up(f.view, black, texels(f.image, 2.0F, 16.0F)).x, 0.01F);
    EXPECT_NEAR(look_up(f.view, white, texels(f.image, 16.0F, 2.0F)).x, 0.5F, 0.02F);
    EXPECT_NEAR(look_up(f.view, black, texels(f.image, 16.0F, 2.0F)).x, 0.5F, 0.02F);
}

TEST(TextureLookup, WrapModesHoldAtEveryLevel) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    const TextureImage image = make_image(24, 20, 1, TexelType::f32, [&](int, int) { return vec4(uniform(random)); });
    const Fixture repeat(image);
    const Fixture mirrored(image, TextureContent::values, TextureWrap::mirrored_repeat);
    const Fixture clamped(image, TextureContent::values, TextureWrap::clamp_to_edge);
    for (const float size : {1.7F, 4.0F, 9.0F, 30.0F})
        for (int i = 0; i < 100; ++i) {
            const vec2 at(uniform(random), uniform(random));
            const UvFootprint f = texels(image, size, size);
            const float here = look_up(repeat.view, at, f).x;
            EXPECT_NEAR(look_up(repeat.view, at + vec2(3.0F, -2.0F), f).x, here, 1e-4F);
            EXPECT_NEAR(look_up(mirrored.view, vec2(-at.x, 2.0F - at.y), f).x, look_up(mirrored.view, at, f).x, 1e-4F);
            EXPECT_EQ(look_up(clamped.view, vec2(-1.0F, 2.0F + at.y), f).x, look_up(clamped.view, vec2(0, 1), f).x);
            // No seam.
            const vec2 seam(1.0F, at.y);
            for (const TextureView& view : {repeat.view, mirrored.view, clamped.view})
                EXPECT_NEAR(look_up(view, seam - vec2(1e-5F, 0), f).x, look_up(view, seam + vec2(1e-5F, 0), f).x,
                            1e-3F);
        }
}

TEST(TextureLookup, NearestShowsTexelsAndFiltersWhatIsSmaller) {
    const Fixture f(checkerboard(8), TextureContent::values, TextureWrap::repeat, TextureFilter::nearest);
    for (int i = 0; i < 100; ++i) {
        const float u = static_cast<float>(i) / 100.0F;
        const float texel = look_up(f.view, vec2(u, 0.05F), texels(f.image, 0.2F, 0.2F)).x;
        EXPECT_TRUE(texel == 0.0F || texel == 1.0F);
        EXPECT_NEAR(look_up(f.view, vec2(u, 0.05F), texels(f.image, 3.0F, 3.0F)).x, 0.5F, 0.01F);
    }
}

TEST(TextureLookup, LevelsAreMadeOncePerContent) {
    TextureLibrary library;
    const TextureImage image = checkerboard(16);
    TextureUse use;
    use.image = 0;
    const TextureView first = library.view(use, image, TextureContent::values);
    const std::size_t bytes = library.memory_bytes();
    use.wrap_u = TextureWrap::clamp_to_edge;
    EXPECT_EQ(library.view(use, image, TextureContent::values).levels, first.levels);
    EXPECT_EQ(library.memory_bytes(), bytes);
    EXPECT_NE(library.view(use, image, TextureContent::normals).levels, first.levels);
}

/// Normals that lean left and right by turns.
TextureImage ridges(float slope) {
    return make_image(64, 64, 3, TexelType::f32, [slope](int x, int) {
        return vec4(glm::normalize(vec3(x % 2 == 0 ? slope : -slope, 0.0F, 1.0F)) * 0.5F + 0.5F, 1.0F);
    });
}

TEST(NormalLookup, MagnifiedNormalsHaveNoVariance) {
    const Fixture f(ridges(0.5F), TextureContent::normals);
    const NormalLookup at_texel = look_up_normal(f.view, vec2(0.5F / 64.0F, 0.3F), texels(f.image, 0.5F, 0.5F));
    EXPECT_LT(glm::distance(at_texel.normal, glm::normalize(vec3(0.5F, 0.0F, 1.0F))), 1e-4F);
    EXPECT_EQ(at_texel.variance, 0.0F);
    const NormalLookup between = look_up_normal(f.view, vec2(1.0F / 64.0F, 0.3F), texels(f.image, 0.5F, 0.5F));
    EXPECT_NEAR(between.normal.z, 1.0F, 1e-4F);
    EXPECT_EQ(between.variance, 0.0F) << "the surface is smooth there";
}

TEST(NormalLookup, DetailThatIsLostBecomesVariance) {
    const Fixture f(ridges(0.2F), TextureContent::normals);
    for (const float size : {4.0F, 16.0F, 200.0F}) {
        const NormalLookup got = look_up_normal(f.view, vec2(0.4F, 0.7F), texels(f.image, size, size));
        EXPECT_NEAR(got.normal.z, 1.0F, 1e-3F);
        // Slopes of +-s on one axis have the trace s^2: alpha squared grows by it.
        EXPECT_NEAR(got.variance, 0.04F, 0.004F) << size;
    }
}

TEST(NormalLookup, TapsThatDifferAddTheirSpread) {
    // Leaning by columns of 16: a footprint of 2 x 16 texels across them straddles both slopes with its taps.
    const TextureImage image = make_image(64, 64, 3, TexelType::f32, [](int x, int) {
        return vec4(glm::normalize(vec3(x / 16 % 2 == 0 ? 0.2F : -0.2F, 0.0F, 1.0F)) * 0.5F + 0.5F, 1.0F);
    });
    const Fixture f(image, TextureContent::normals);
    const NormalLookup straddling = look_up_normal(f.view, vec2(16.0F / 64.0F, 0.5F), texels(image, 16.0F, 2.0F));
    EXPECT_NEAR(straddling.variance, 0.04F, 0.012F);
    const NormalLookup within = look_up_normal(f.view, vec2(8.0F / 64.0F, 0.5F), texels(image, 2.0F, 16.0F));
    EXPECT_LT(within.variance, 1e-3F);
    EXPECT_NEAR(within.normal.x / within.normal.z, 0.2F, 0.01F);
}

}  // namespace
}  // namespace macula
