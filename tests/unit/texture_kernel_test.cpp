// Texture lookup: wrapping by glTF's rules, bilinear footprints, KHR_texture_transform.

#include <gtest/gtest.h>

#include <cmath>

#include "server/kernels/texture.h"

namespace macula {
namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec4;

kernels::Texture texture(int width, int height, int wrap, bool nearest = false) {
    return {vec4(1.0F, 0.0F, 0.0F, 1.0F), vec2(0.0F), ivec2(width, height), ivec2(wrap), nearest ? 1 : 0};
}

/// Texel of an unbounded integer index by the definition of each wrap mode.
int wrapped(int i, int size, int wrap) {
    if (wrap == kernels::kWrapClampToEdge) return std::min(std::max(i, 0), size - 1);
    const int period = wrap == kernels::kWrapRepeat ? size : 2 * size;
    const int m = (i % period + period) % period;
    return m < size ? m : period - 1 - m;
}

TEST(TextureKernel, FootprintsFollowTheDefinitionOfEveryWrapMode) {
    constexpr int kWidth = 5;
    constexpr int kHeight = 3;
    for (const int wrap : {kernels::kWrapRepeat, kernels::kWrapMirroredRepeat, kernels::kWrapClampToEdge}) {
        // Values that the columns and rows have; a lookup must interpolate them as an endless image would.
        const auto column = [&](int i) {
            return static_cast<float>(wrapped(i, kWidth, wrap) * wrapped(i, kWidth, wrap));
        };
        const auto row = [&](int i) { return static_cast<float>(7 * wrapped(i, kHeight, wrap)); };
        for (int k = -400; k <= 400; ++k) {
            const vec2 uv(static_cast<float>(k) * 0.0137F, static_cast<float>(k) * 0.0093F);
            const kernels::TexelFootprint f = kernels::texel_footprint(texture(kWidth, kHeight, wrap), uv);
            const vec2 p = uv * vec2(kWidth, kHeight) - 0.5F;
            const int x = static_cast<int>(std::floor(p.x));
            const int y = static_cast<int>(std::floor(p.y));
            const float wanted_x = glm::mix(column(x), column(x + 1), p.x - std::floor(p.x));
            const float wanted_y = glm::mix(row(y), row(y + 1), p.y - std::floor(p.y));
            for (const int i : {f.x.x, f.x.y, f.y.x, f.y.y}) ASSERT_GE(i, 0);
            for (const int i : {f.x.x, f.x.y}) ASSERT_LT(i, kWidth);
            for (const int i : {f.y.x, f.y.y}) ASSERT_LT(i, kHeight);
            const auto value = [&](int i, int j) { return vec4(i * i, 7 * j, 0.0F, 1.0F); };
            const vec4 got = kernels::mix_texels(f, value(f.x.x, f.y.x), value(f.x.y, f.y.x), value(f.x.x, f.y.y),
                                                 value(f.x.y, f.y.y));
            EXPECT_NEAR(got.x, wanted_x, 2e-4F) << "wrap " << wrap << " u " << uv.x;
            EXPECT_NEAR(got.y, wanted_y, 2e-4F) << "wrap " << wrap << " v " << uv.y;
        }
    }
}

TEST(TextureKernel, NearestReadsTheTexelThatHoldsThePosition) {
    const kernels::Texture t = texture(4, 2, kernels::kWrapRepeat, true);
    const auto at = [&](float u, float v) {
        const kernels::TexelFootprint f = kernels::texel_footprint(t, vec2(u, v));
        EXPECT_EQ(f.weight, vec2(0.0F));
        return ivec2(f.x.x, f.y.x);
    };
    EXPECT_EQ(at(0.0F, 0.0F), ivec2(0, 0));
    EXPECT_EQ(at(0.24F, 0.49F), ivec2(0, 0));
    EXPECT_EQ(at(0.26F, 0.51F), ivec2(1, 1));
    EXPECT_EQ(at(0.99F, 0.99F), ivec2(3, 1));
    EXPECT_EQ(at(1.0F, 1.0F), ivec2(0, 0));
    EXPECT_EQ(at(-0.01F, -0.01F), ivec2(3, 1));
}

TEST(TextureKernel, CoordinatesThatAreNoNumbersStayInTheImage) {
    for (const int wrap : {kernels::kWrapRepeat, kernels::kWrapMirroredRepeat, kernels::kWrapClampToEdge}) {
        for (const float u : {1e30F, -1e30F, 3e9F, -1e-9F, 16777216.0F}) {
            const kernels::TexelFootprint f = kernels::texel_footprint(texture(7, 7, wrap), vec2(u, -u));
            for (const int i : {f.x.x, f.x.y, f.y.x, f.y.y}) {
                EXPECT_GE(i, 0);
                EXPECT_LT(i, 7);
            }
        }
    }
}

TEST(TextureKernel, TransformScalesRotatesAndShifts) {
    // KHR_texture_transform: translation * rotation * scale, rotation counter-clockwise about the origin with v down.
    const float angle = 0.5F;
    kernels::Texture t = texture(4, 4, kernels::kWrapRepeat);
    const vec2 scale(2.0F, 3.0F);
    t.uv_scale_rotation = vec4(std::cos(angle) * scale.x, -std::sin(angle) * scale.x, std::sin(angle) * scale.y,
                               std::cos(angle) * scale.y);
    t.uv_offset = vec2(0.1F, 0.2F);
    const vec2 uv(0.3F, 0.7F);
    const vec2 got = kernels::transform_uv(t, uv);
    EXPECT_NEAR(got.x, std::cos(angle) * 0.6F + std::sin(angle) * 2.1F + 0.1F, 1e-6F);
    EXPECT_NEAR(got.y, -std::sin(angle) * 0.6F + std::cos(angle) * 2.1F + 0.2F, 1e-6F);
}

}  // namespace
}  // namespace macula
