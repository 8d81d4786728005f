#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/openness.h"
#include "scenes/pattern_glyph.h"
#include "scenes/scene_builder.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"
#include "scenes/shapes_wire.h"

namespace macula {
namespace {

/// Enclosed volume by the divergence theorem: positive where the corners turn counter-clockwise outside.
double volume_of(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangle)
        sum += glm::dot(glm::dvec3(mesh.position_m[t.x]),
                        glm::cross(glm::dvec3(mesh.position_m[t.y]), glm::dvec3(mesh.position_m[t.z])));
    return sum / 6.0;
}

TEST(MadeShapes, SolidsAreClosedAndHaveTheirVolume) {
    const Mesh block = make_block({2.0F, 3.0F, 0.5F});
    EXPECT_TRUE(is_closed(block));
    EXPECT_NEAR(volume_of(block), 3.0, 1e-6);
    const Mesh bevelled = make_bevelled_block({2.0F, 3.0F, 0.5F}, 0.1F);
    EXPECT_TRUE(is_closed(bevelled));
    // The twelve edges, 22 m long together, lose at most half the square of the bevel.
    EXPECT_LT(volume_of(bevelled), 3.0);
    EXPECT_GT(volume_of(bevelled), 3.0 - 0.5 * 0.01 * 22.0);
    const std::vector<glm::vec3> lower = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::vec3> upper = {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
    const Mesh prism = make_prism(lower, upper);
    EXPECT_TRUE(is_closed(prism));
    EXPECT_NEAR(volume_of(prism), 1.0, 1e-6);
    const Mesh turned_cone = make_turned({{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 3.0F}}, 96);
    EXPECT_TRUE(is_closed(turned_cone));
    EXPECT_NEAR(volume_of(turned_cone), 3.14159265, 0.01);
    EXPECT_FALSE(is_closed(make_quad({0, 0, 0}, {1, 0, 0}, {0, -1, 0})));
}

TEST(MadeShapes, PipesKeepTheirRadiusAroundCorners) {
    // Consecutive right angles in one plane and out of it.
    const std::vector<glm::vec3> path = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 1}};
    const Mesh pipe = make_pipe(path, 0.1F, 24);
    EXPECT_TRUE(is_closed(pipe));
    // The mitred pieces are prisms of the same section whose mean length is that of the path.
    EXPECT_NEAR(volume_of(pipe), 4.0 * 0.5 * 24.0 * std::sin(2.0 * 3.14159265 / 24.0) * 0.01, 1e-4);
    for (const glm::vec3& n : pipe.normal) EXPECT_NEAR(glm::length(n), 1.0F, 1e-4F);
    const Mesh ring = make_ring(1.0F, 0.1F, 64, 24);
    EXPECT_NEAR(volume_of(ring), 2.0 * 3.14159265 * 3.14159265 * 0.01, 0.005);
}

TEST(MadeShapes, MirroredPartsKeepTheirOutside) {
    Mesh both = make_block({1.0F, 1.0F, 1.0F});
    append(both, make_block({1.0F, 1.0F, 1.0F}), glm::mat4(-1.0F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5.0F, 0, 0, 1));
    EXPECT_NEAR(volume_of(both), 2.0, 1e-5);
}

TEST(MadeShapes, NoiseFieldsRepeatAndFillTheirRange) {
    const NoiseField field(64, 4, 8, 3, 5);
    float low = 1.0F;
    float high = 0.0F;
    for (int i = 0; i < 2000; ++i) {
        const float u = hash01(i, 1, 2);
        const float v = hash01(i, 2, 2);
        const float value = field.at(u, v);
        EXPECT_NEAR(value, field.at(u + 1.0F, v - 2.0F), 2e-3F);
        low = std::min(low, value);
        high = std::max(high, value);
    }
    EXPECT_GE(low, 0.0F);
    EXPECT_LE(high, 1.0F);
    EXPECT_LT(low, 0.2F);
    EXPECT_GT(high, 0.8F);
}

TEST(MadeShapes, LettersHaveInkWhereTheirStrokesAre) {
    // T: a bar above and a stem in the middle, nothing beside the stem.
    EXPECT_EQ(text_ink("T", {0.33F, 0.5F}, 0.08F, 0.01F, false), 1.0F);
    EXPECT_EQ(text_ink("T", {0.1F, 1.0F}, 0.08F, 0.01F, false), 1.0F);
    EXPECT_EQ(text_ink("T", {0.1F, 0.4F}, 0.08F, 0.01F, false), 0.0F);
    // O closes above; as a stencil it has a bridge there.
    EXPECT_EQ(text_ink("O", {0.333F, 1.0F}, 0.08F, 0.01F, false), 1.0F);
    EXPECT_EQ(text_ink("O", {0.333F, 1.0F}, 0.08F, 0.01F, true), 0.0F);
    for (const char letter : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789")) {
        float ink = 0.0F;
        for (int i = 0; i < 400; ++i)
            ink += text_ink(std::string(1, letter), {0.67F * hash01(i, 1, 9), hash01(i, 2, 9)}, 0.08F, 0.01F, false);
        EXPECT_GT(ink, 20.0F) << letter;
        EXPECT_LT(ink, 300.0F) << letter;
    }
}

TEST(MadeShapes, CornersAreDarkerThanOpenFloor) {
    SceneBuilder builder;
    const int material = builder.plain("grey", 0x808080);
    Mesh floor =
        make_surface(20, 20, false, [](float u, float v) { return glm::vec3(4.0F * u - 2.0F, 0.0F, 2.0F - 4.0F * v); });
    builder.place_mesh("floor", builder.add_mesh(floor, material));
    builder.place_mesh("wall", builder.add_mesh(make_quad({-2, 3, -2}, {4, 0, 0}, {0, -3, 0}), material));
    OpennessOptions options;
    options.low = glm::vec3(-3.0F, -0.5F, -3.0F);
    options.high = glm::vec3(3.0F, 4.0F, 3.0F);
    darken_corners(builder.scene(), options);
    const Mesh& result = builder.scene().meshes[0];
    float at_wall = 1.0F;
    float far = 1.0F;
    for (std::size_t i = 0; i < result.position_m.size(); ++i) {
        if (result.position_m[i].x != 0.0F) continue;
        if (result.position_m[i].z < -1.7F) at_wall = std::min(at_wall, result.color[i].r);
        if (result.position_m[i].z > 1.0F) far = std::min(far, result.color[i].r);
    }
    EXPECT_LT(at_wall, 0.85F);
    EXPECT_GT(far, 0.95F);
}

}  // namespace
}  // namespace macula
