// Drawing triangles, on every kind of context.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include "protocol/gl/context.h"
#include "protocol/gl/render_program.h"
#include "protocol/gl/render_target.h"

namespace macula {
namespace {

// A vertex is its place in pixels of the viewport, its red and its value.
constexpr KernelText kVertex = {"ramp_vertex.glsl", R"(
layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer View { vec4 viewport; };
layout(location = 0) out vec4 color;
layout(location = 1) out float value;
void main() {
    vec4 vertex = vertices[gl_VertexID];
    gl_Position = vec4(2.0 * vertex.xy / viewport.xy - 1.0, 0.0, 1.0);
    color = vec4(vertex.z, 0.0, 1.0, 1.0);
    value = vertex.w;
}
)"};
constexpr KernelText kFragment = {"ramp_fragment.glsl", R"(
layout(location = 0) in vec4 color;
layout(location = 1) in float value;
layout(location = 0) out vec4 drawn_color;
layout(location = 1) out float drawn_value;
void main() {
    drawn_color = color;
    drawn_value = value;
}
)"};

constexpr glm::ivec2 kSize_px = {40, 30};
constexpr Rgba8 kCleared = 0xFF000000U;

struct Drawn {
    std::vector<Rgba8> color;
    std::vector<float> value;

    [[nodiscard]] std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * kSize_px.x + x); }
};

class GlRender : public testing::TestWithParam<ContextKind> {
protected:
    void SetUp() override {
        auto made = make_gl_context(GetParam());
        ASSERT_TRUE(made) << made.error().message;
        context_ = std::move(*made);
    }

    /// Draws runs of a triangle list with `corner`, `viewport` as RenderTarget::begin takes them.
    [[nodiscard]] Drawn draw(const std::vector<glm::vec4>& vertices, const std::vector<std::uint32_t>& indices,
                             const std::vector<IndexRange>& ranges, glm::ivec2 corner = {0, 0},
                             glm::ivec2 viewport = kSize_px) const {
        const auto current = CurrentContext::enter(*context_);
        EXPECT_TRUE(current);
        auto program = RenderProgram::build(*context_, std::array{kVertex}, std::array{kFragment});
        if (!program) {
            ADD_FAILURE() << program.error().message;
            return {};
        }
        const RenderProgram moved = std::move(*program);
        StorageBuffer<glm::vec4> vertex_buffer(*context_);
        StorageBuffer<glm::vec4> view(*context_);
        StorageBuffer<std::uint32_t> index_buffer(*context_);
        vertex_buffer.write(vertices);
        view.write(glm::vec4(viewport, 0, 0));
        index_buffer.write(indices);
        RenderTarget target(*context_);
        EXPECT_TRUE(target.resize({7, 5}));
        EXPECT_TRUE(target.resize(kSize_px));
        target.begin(corner, viewport);
        vertex_buffer.bind(0);
        view.bind(1);
        moved.draw(index_buffer, ranges);
        const auto pixels = static_cast<std::size_t>(kSize_px.x * kSize_px.y);
        Drawn drawn{std::vector<Rgba8>(pixels), std::vector<float>(pixels)};
        const auto width = static_cast<std::size_t>(kSize_px.x);
        const auto copied = target.copy_to(drawn.color.data(), width, drawn.value.data(), width);
        EXPECT_TRUE(copied) << copied.error().message;
        return drawn;
    }

    std::unique_ptr<GlContext> context_;
};

/// Two triangles over a rectangle with red = x / 255 and value = x + 100 y at pixel centres.
std::vector<glm::vec4> ramp(glm::vec2 first, glm::vec2 last) {
    std::vector<glm::vec4> corners;
    for (const glm::vec2 place : {first, glm::vec2(last.x, first.y), last, glm::vec2(first.x, last.y)})
        corners.emplace_back(place.x, place.y, (place.x - 0.5F) / 255.0F, place.x - 0.5F + 100.0F * (place.y - 0.5F));
    return corners;
}
const std::vector<std::uint32_t> kTwoTriangles = {0, 1, 2, 0, 2, 3};

TEST_P(GlRender, InterpolatesBetweenCorners) {
    const Drawn drawn = draw(ramp({-10.0F, -10.0F}, {60.0F, 50.0F}), kTwoTriangles, {{0, 6}});
    for (int y = 0; y < kSize_px.y; ++y)
        for (int x = 0; x < kSize_px.x; ++x) {
            ASSERT_EQ(drawn.color[drawn.at(x, y)], 0xFFFF0000U | static_cast<Rgba8>(x)) << x << ", " << y;
            ASSERT_NEAR(drawn.value[drawn.at(x, y)], x + 100 * y, 2e-3) << x << ", " << y;
        }
}

TEST_P(GlRender, DrawsWhatIsInTheRangesAndLeavesTheRestBlack) {
    const std::vector<glm::vec4> vertices = ramp({0.0F, 0.0F}, {30.0F, 30.0F});
    const Drawn first = draw(vertices, kTwoTriangles, {{0, 3}});
    const Drawn both = draw(vertices, kTwoTriangles, {{3, 3}, {0, 3}});
    const Drawn none = draw(vertices, kTwoTriangles, {});
    // The diagonal is y = x; the first triangle is the one to its right.
    EXPECT_NE(first.color[first.at(20, 5)], kCleared);
    EXPECT_EQ(first.color[first.at(5, 20)], kCleared);
    EXPECT_EQ(first.value[first.at(5, 20)], 0.0F);
    EXPECT_NE(both.color[both.at(5, 20)], kCleared);
    EXPECT_EQ(both.color[both.at(35, 20)], kCleared);
    for (const Rgba8 color : none.color) ASSERT_EQ(color, kCleared);
}

TEST_P(GlRender, ViewportMayBeLargerThanThePicture) {
    constexpr glm::ivec2 kGuard_px = {9, 13};
    const Drawn drawn =
        draw(ramp({0.0F, 0.0F}, {58.0F, 56.0F}), kTwoTriangles, {{0, 6}}, -kGuard_px, kSize_px + 2 * kGuard_px);
    for (int y = 0; y < kSize_px.y; ++y)
        for (int x = 0; x < kSize_px.x; ++x) {
            ASSERT_EQ(drawn.color[drawn.at(x, y)], 0xFFFF0000U | static_cast<Rgba8>(x + kGuard_px.x));
            ASSERT_NEAR(drawn.value[drawn.at(x, y)], x + kGuard_px.x + 100 * (y + kGuard_px.y), 2e-3);
        }
}

TEST_P(GlRender, ReportsTheLineOfTheStageThatDoesNotCompile) {
    const auto current = CurrentContext::enter(*context_);
    ASSERT_TRUE(current);
    const KernelText broken = {"kernels/broken.glsl", "\n// two\nfloat f() { return undeclared_name; }\n"};
    const auto program = RenderProgram::build(*context_, std::array{kVertex}, std::array{broken, kFragment});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::graphics);
    EXPECT_NE(program.error().message.find("kernels/broken.glsl:3: float f() { return undeclared_name; }"),
              std::string::npos)
        << program.error().message;
}

TEST_P(GlRender, ReportsStagesThatDoNotFit) {
    const auto current = CurrentContext::enter(*context_);
    ASSERT_TRUE(current);
    const KernelText silent = {"silent.glsl", "void main() { gl_Position = vec4(0.0); }\n"};
    const auto program = RenderProgram::build(*context_, std::array{silent}, std::array{kFragment});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::graphics);
    EXPECT_NE(program.error().message.find("does not link"), std::string::npos) << program.error().message;
}

TEST_P(GlRender, RefusesAPictureOfASizeThatGlCannotDraw) {
    const auto current = CurrentContext::enter(*context_);
    ASSERT_TRUE(current);
    RenderTarget target(*context_);
    const auto resized = target.resize({1 << 20, 1});
    ASSERT_FALSE(resized);
    EXPECT_EQ(resized.error().code, ErrorCode::graphics);
    EXPECT_TRUE(target.resize({8, 8})) << "recovers";
}

std::string test_name(const testing::TestParamInfo<ContextKind>& kind) {
    return kind.param == ContextKind::osmesa ? "OsMesa" : "EglSurfaceless";
}
INSTANTIATE_TEST_SUITE_P(Any, GlRender, testing::Values(ContextKind::surfaceless, ContextKind::osmesa), test_name);

}  // namespace
}  // namespace macula
