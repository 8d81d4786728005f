// Scenes of a millimetre, of 100 kilometres, ten kilometres away, and of both sizes at once: pixels that differ from
// what double precision says of the very same triangles.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/slow_trace.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr int kSize_px = 192;

/// Moves a mesh's corners. Each is rounded to floats once, so that the scene's corners are exactly what is traced.
Mesh placed(Mesh mesh, const glm::dmat4& turn, double scale = 1.0, const dvec3& place = dvec3(0.0)) {
    for (vec3& p : mesh.position_m) p = vec3(place + scale * dvec3(turn * glm::dvec4(dvec3(p), 1.0)));
    for (vec3& n : mesh.normal) n = vec3(glm::dmat3(turn) * dvec3(n));
    return mesh;
}

glm::dmat4 turned(const dvec3& at, double angle_rad, const dvec3& axis) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), at), angle_rad, glm::normalize(axis));
}

Light sun() {
    Light light;
    light.direction = glm::normalize(vec3(0.45F, -0.8F, -0.4F));
    return light;
}

/// Blocks, tilted and upright, on a floor before a wall, all within a cube of edge `scale` whose middle is `place`.
Scene blocks(double scale, const dvec3& place, const Light& light) {
    Scene scene;
    scene.lights.push_back(light);
    const auto add = [&](const Mesh& mesh, const glm::dmat4& turn) {
        test::add(scene, placed(mesh, turn, scale, place), test::matte());
    };
    const glm::dmat4 still(1.0);
    add(make_quad({-0.49F, -0.3F, -0.49F}, {0.98F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.98F}), still);
    add(make_quad({-0.49F, 0.45F, -0.48F}, {0.98F, 0.0F, 0.0F}, {0.0F, -0.7F, -0.01F}), still);
    add(make_box({0.2F, 0.3F, 0.2F}), turned({-0.2, -0.3, 0.0}, 0.6, {0, 1, 0}));
    add(make_box({0.15F, 0.15F, 0.15F}), turned({0.2, -0.2, 0.1}, 0.9, {0.4, 0.3, 0.8}));
    add(make_box({0.1F, 0.5F, 0.02F}), turned({0.1, -0.25, -0.25}, -0.4, {0.1, 0.9, 0.3}));
    return scene;
}

/// A square view with tangents up to `tangent` on each side.
EyeView narrow_view(const vec3& position_m, float tangent) {
    EyeView view = test::square_view(kSize_px, position_m);
    view.tangents = {-tangent, tangent, -tangent, tangent};
    return view;
}

/// The blocks seen from half their edge before them, under a sun and under a lamp.
test::Comparison compare_blocks(const std::string& name, double scale, const dvec3& place) {
    const EyeView view = narrow_view(vec3(place + dvec3(0.0, 0.1, 1.0) * scale), 0.5F);
    Light lamp{.kind = LightKind::point, .position_m = vec3(place + dvec3(-0.1, 0.45, 0.4) * scale)};
    lamp.intensity = vec3(static_cast<float>(scale * scale));
    test::Comparison sum;
    for (const Light& light : {sun(), lamp}) sum.add(test::compare_with_slow(blocks(scale, place, light), view));
    sum.seen.report(name + "_seen");
    sum.shadowed.report(name + "_shadowed");
    EXPECT_GT(sum.compared_lit, 9000);
    EXPECT_GT(sum.shadowed.compared - sum.compared_lit, 3000);
    return sum;
}

TEST(StabilityOfScale, AMetre) {
    const test::Comparison wrong = compare_blocks("metre", 1.0, dvec3(0.0));
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.shadowed.wrong, 0);
}

TEST(StabilityOfScale, AMillimetre) {
    const test::Comparison wrong = compare_blocks("millimetre", 1e-3, dvec3(0.0));
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.shadowed.wrong, 0);
}

TEST(StabilityOfScale, HundredKilometres) {
    const test::Comparison wrong = compare_blocks("100_km", 1e5, dvec3(0.0));
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.shadowed.wrong, 0);
}

// Ten kilometres from the origin floats are 1 mm apart, and shadow rays start 5 mm above their surface, so that the
// edges of shadows move by up to 6 mm, which is as much as a pixel covers here. Each picture has some 1.5 m of shadow
// edges: at most 250 pixels along them, and nothing elsewhere.
TEST(StabilityOfScale, AMetreTenKilometresAway) {
    const test::Comparison wrong = compare_blocks("metre_10_km_away", 1.0, dvec3(10000.0, 0.0, 0.0));
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.beyond_rounding, 0);
    EXPECT_LE(wrong.shadowed.wrong, 2 * 250);
}

// At ten times the size a pixel covers ten times as much.
TEST(StabilityOfScale, TenMetresTenKilometresAway) {
    const test::Comparison wrong = compare_blocks("10_metres_10_km_away", 10.0, dvec3(6000.0, 3000.0, -7000.0));
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.beyond_rounding, 0);
    EXPECT_LE(wrong.shadowed.wrong, 2 * 25);
}

/// A square frame in the plane y = 0 between two half edges.
Mesh frame(float inner, float outer) {
    Mesh mesh;
    for (const float half : {inner, outer})
        for (const vec3 corner : {vec3(-1, 0, 1), vec3(1, 0, 1), vec3(1, 0, -1), vec3(-1, 0, -1)})
            mesh.position_m.push_back(corner * half);
    mesh.normal.assign(8, vec3(0.0F, 1.0F, 0.0F));
    for (unsigned i = 0; i < 4; ++i) {
        const unsigned next = (i + 1) % 4;
        mesh.triangle.emplace_back(i, i + 4, next + 4);
        mesh.triangle.emplace_back(i, next + 4, next);
    }
    return mesh;
}

/// A box of 1 mm on a ground of 100 km, seen from 3 mm. The ground is made of frames, each `finer` times smaller than
/// the one around it, down to `least_m`, and a square in the middle.
test::Comparison compare_box_on_ground(const std::string& name, double tilt_rad, float finer, float least_m) {
    Scene scene;
    scene.lights.push_back(sun());
    const glm::dmat4 tilt = turned(dvec3(0.0), tilt_rad, {0.6, 0.1, 0.75});
    float half = 5e4F;
    for (; half > least_m; half /= finer) test::add(scene, placed(frame(half / finer, half), tilt), test::matte());
    test::add(scene,
              placed(make_quad({-half, 0.0F, -half}, {2.0F * half, 0.0F, 0.0F}, {0.0F, 0.0F, 2.0F * half}), tilt),
              test::matte());
    test::add(scene, placed(make_box(vec3(1e-3F)), tilt * turned(dvec3(0.0), 0.5, {0, 1, 0})), test::matte());
    const test::Comparison wrong = test::compare_with_slow(scene, narrow_view({0.3e-3F, 1.5e-3F, 2.5e-3F}, 0.6F));
    wrong.seen.report(name + "_seen");
    wrong.shadowed.report(name + "_shadowed");
    EXPECT_GT(wrong.compared_lit, 10000);
    EXPECT_GT(wrong.shadowed.compared - wrong.compared_lit, 300);
    return wrong;
}

TEST(StabilityOfScale, AMillimetreOnHundredKilometres) {
    const test::Comparison wrong = compare_box_on_ground("millimetre_on_100_km", 0.0, 2.0F, 1e5F);
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.shadowed.wrong, 0);
}

// Floats place a tilted triangle of 100 km with an error of millimetres. Around the small box it must be cut finer.
TEST(StabilityOfScale, AMillimetreOnTiltedHundredKilometres) {
    const test::Comparison wrong = compare_box_on_ground("millimetre_on_tilted_100_km", 0.1, 4.0F, 5e-3F);
    EXPECT_EQ(wrong.seen.wrong, 0);
    EXPECT_EQ(wrong.shadowed.wrong, 0);
}

}  // namespace
}  // namespace macula
