// Planes seen at grazing angles, surfaces in the same place, and triangles as thin as needles.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/slow_trace.h"

namespace macula {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr int kSize_px = 192;
constexpr double kDegree = std::numbers::pi / 180.0;

Light sun_at(double elevation_deg) {
    Light sun;
    sun.direction = vec3(dvec3(std::cos(elevation_deg * kDegree), -std::sin(elevation_deg * kDegree), 0.0));
    return sun;
}

/// The plane y = 0, to 200 km on all sides.
Scene plain(const Light& sun) {
    Scene scene;
    scene.lights.push_back(sun);
    test::add(scene, make_quad({-2e5F, 0.0F, -2e5F}, {4e5F, 0.0F, 0.0F}, {0.0F, 0.0F, 4e5F}), test::matte());
    return scene;
}

// From 1 m above a plane, angles of incidence from 89.9 to 89.999 degrees: depths from 570 m to 57 km, against the
// height over the tangent.
TEST(StabilityOfGrazingRays, APlaneIsSeenAndLitWhereItMustBe) {
    EyeView view = test::square_view(kSize_px, {0.0F, 1.0F, 0.0F});
    view.tangents = {-1e-3F, 1e-3F, static_cast<float>(-std::tan(0.1 * kDegree)),
                     static_cast<float>(-std::tan(0.001 * kDegree))};
    for (const double elevation_deg : {90.0, 1.0, 0.1, 0.01}) {
        const test::Traced traced = test::trace(plain(sun_at(elevation_deg)), view);
        test::WrongPixels seen;
        test::WrongPixels lit;
        for (int y = 0; y < kSize_px; ++y) {
            for (int x = 0; x < kSize_px; ++x) {
                const double inverse_depth = -static_cast<double>(traced.tangents(x, y).y);
                seen.count(traced.object(x, y) != 1 ||
                           std::abs(traced.inverse_depth(x, y) - inverse_depth) > 1e-6 * inverse_depth);
                lit.count(!(traced.radiance(x, y).x > 0.0F));
            }
        }
        const std::string name = "grazing_sun_at_" + std::to_string(elevation_deg).substr(0, 5);
        seen.report(name + "_seen");
        lit.report(name + "_lit");
        EXPECT_EQ(seen.wrong, 0);
        EXPECT_EQ(lit.wrong, 0);
    }
}

/// Walls in one place, askew to all axes: a second copy, one whose diagonal runs the other way, and one that covers a
/// part, each an object of its own.
Scene coplanar_walls() {
    Scene scene;
    scene.lights.push_back({.direction = glm::normalize(vec3(0.3F, -0.5F, -0.6F))});
    const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -2.0F)), 0.4F,
                                        glm::normalize(vec3(0.6F, 0.64F, 0.48F)));
    const Mesh wall = test::wall(vec3(0.0F), 8.0F);
    Mesh other_diagonal = wall;
    other_diagonal.triangle = {{1, 2, 3}, {1, 3, 0}};
    for (const Mesh& mesh : {wall, wall, other_diagonal, test::wall({0.3F, 0.1F, 0.0F}, 0.7F)})
        test::add(scene, mesh, test::matte(), place);
    return scene;
}

TEST(StabilityOfCoplanarTriangles, NoHolesNoFalseShadowsAndTheRightDepth) {
    const EyeView view = test::square_view(kSize_px);
    const Scene scene = coplanar_walls();
    const test::Traced traced = test::trace(scene, view);
    Scene one = scene;
    one.instances.resize(1);
    const std::vector<test::SlowTriangle> triangles = test::slow_triangles(one);
    test::WrongPixels seen;
    for (int y = 0; y < kSize_px; ++y) {
        for (int x = 0; x < kSize_px; ++x) {
            const dvec3 direction(traced.tangents(x, y), -1.0);
            const test::SlowHit hit = test::slow_trace(triangles, dvec3(0.0), direction);
            ASSERT_NE(hit.object, 0U);
            const double off_plane =
                std::abs(1.0 / traced.inverse_depth(x, y) - hit.distance) * std::abs(glm::dot(direction, hit.normal));
            const dvec3 point = direction * hit.distance;
            seen.count(traced.object(x, y) == 0 || off_plane > test::rounding_m(hit, point, glm::length(point)));
        }
    }
    const test::WrongPixels shaded = test::falsely_shaded(scene, view);
    seen.report("coplanar_seen");
    shaded.report("coplanar_shadowed");
    EXPECT_EQ(seen.wrong, 0);
    EXPECT_EQ(shaded.wrong, 0);
}

// Which of them is seen is arbitrary, but the same in every frame, after every start, and for any set of neighbours.
TEST(StabilityOfCoplanarTriangles, TheSameOneIsSeenAlways) {
    const EyeView view = test::square_view(kSize_px);
    const test::Traced first = test::trace(coplanar_walls(), view);
    const test::Traced second = test::trace(coplanar_walls(), view);
    test::WrongPixels after_start;
    for (std::size_t i = 0; i < first.samples.object_id.size(); ++i)
        after_start.count(first.samples.object_id[i] != second.samples.object_id[i]);
    const SamplePlan sparse =
        test::raster_plan(kSize_px, kSize_px, [](int x, int y) { return (x * 7 + y * 3) % 5 == 0; });
    Samples samples;
    const TraceTask task{&view, &sparse, &samples};
    test::tracer_of(coplanar_walls())->trace({&task, 1});
    test::WrongPixels among_others;
    for (const std::uint32_t i : sparse.trace_order)
        among_others.count(samples.object_id[i] != first.samples.object_id[i]);
    after_start.report("coplanar_after_another_start");
    among_others.report("coplanar_among_other_rays");
    EXPECT_EQ(after_start.wrong, 0);
    EXPECT_EQ(among_others.wrong, 0);
}

/// A strip of triangles, each 2 m long and 2 um wide, around the origin in the plane z = 0, facing +Z.
Mesh needles() {
    constexpr unsigned kCount = 400;
    constexpr double kWidth_m = 2e-6;
    const dvec3 along(std::cos(0.3), std::sin(0.3), 0.0);
    const dvec3 across(-along.y, along.x, 0.0);
    Mesh mesh;
    for (unsigned i = 0; i <= kCount; ++i)
        for (const double end : {-1.0, 1.0})
            mesh.position_m.emplace_back(along * end + across * (kWidth_m * (i - 0.5 * kCount)));
    mesh.normal.assign(mesh.position_m.size(), vec3(0.0F, 0.0F, 1.0F));
    for (unsigned i = 0; i < kCount; ++i) {
        mesh.triangle.emplace_back(2 * i, 2 * i + 1, 2 * i + 2);
        mesh.triangle.emplace_back(2 * i + 1, 2 * i + 3, 2 * i + 2);
    }
    return mesh;
}

/// A view of what is 1 m ahead, 0.4 mm wide: less than the strip.
EyeView view_of_needles() {
    EyeView view = test::square_view(kSize_px);
    view.tangents = {-2e-4F, 2e-4F, -2e-4F, 2e-4F};
    return view;
}

/// Pixels of the strip that differ from a wall's in the same place, under a sun.
test::WrongPixels needles_against_wall(const glm::mat4& place, const std::string& name) {
    Scene strip;
    strip.lights.push_back({.direction = glm::normalize(vec3(0.3F, -0.5F, -0.8F))});
    Scene wall = strip;
    test::add(strip, needles(), test::matte(), place);
    test::add(wall, test::wall(vec3(0.0F), 1.0F), test::matte(), place);
    const test::Traced thin = test::trace(strip, view_of_needles());
    const test::Traced whole = test::trace(wall, view_of_needles());
    test::WrongPixels result;
    for (std::size_t i = 0; i < thin.samples.object_id.size(); ++i) {
        const vec3 difference = thin.samples.radiance[i] - whole.samples.radiance[i];
        result.count(thin.samples.object_id[i] != whole.samples.object_id[i] ||
                     std::abs(thin.samples.inverse_depth_per_m[i] - whole.samples.inverse_depth_per_m[i]) > 1e-6F ||
                     !(glm::dot(difference, difference) < 1e-10F));
    }
    result.report(name);
    return result;
}

TEST(StabilityOfNeedles, LookLikeAWall) {
    const glm::mat4 ahead = glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -1.0F));
    EXPECT_EQ(needles_against_wall(ahead, "needles").wrong, 0);
}

// Askew, rounding of the corners crumples the strip, but by too little to be seen.
TEST(StabilityOfNeedles, LookLikeATiltedWall) {
    const glm::mat4 tilted = glm::rotate(glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, -1.0F)), 0.5F,
                                         glm::normalize(vec3(0.6F, 0.64F, 0.48F)));
    EXPECT_EQ(needles_against_wall(tilted, "tilted_needles").wrong, 0);
}

TEST(StabilityOfNeedles, ShadeLikeAWall) {
    Scene scene;
    scene.lights.push_back({});
    Material material = test::matte();
    material.double_sided = true;
    test::add(scene, test::wall({0.0F, 0.0F, -1.0F}, 1.0F), material);
    test::add(scene, needles(), material, glm::translate(glm::mat4(1.0F), vec3(0.0F, 0.0F, 0.5F)));
    const test::Traced traced = test::trace(scene, view_of_needles());
    test::WrongPixels lit;
    for (const vec3& radiance : traced.samples.radiance) lit.count(radiance != vec3(0.0F));
    lit.report("light_between_needles");
    EXPECT_EQ(lit.wrong, 0);
}

// Triangles without an area, in front of a wall: points, lines there and back, and a line with a corner within.
TEST(StabilityOfNeedles, TrianglesWithoutAreaChangeNothing) {
    Scene scene;
    scene.lights.push_back({.direction = glm::normalize(vec3(0.3F, -0.5F, -0.8F))});
    test::add(scene, test::wall({0.0F, 0.0F, -2.0F}, 1.5F), test::matte());
    const test::Traced without = test::trace(scene, test::square_view(kSize_px));
    Mesh flat;
    for (int i = -8; i <= 8; ++i) {
        const auto first = static_cast<unsigned>(flat.position_m.size());
        const float x = 0.1F * static_cast<float>(i);
        for (const float y : {-1.0F, 0.0F, 1.0F}) flat.position_m.emplace_back(x, y, -1.0F);
        flat.triangle.emplace_back(first, first + 1, first + 2);
        flat.triangle.emplace_back(first, first + 2, first);
        flat.triangle.emplace_back(first, first, first);
    }
    flat.normal.assign(flat.position_m.size(), vec3(0.0F, 0.0F, 1.0F));
    test::add(scene, flat, test::matte());
    const test::Traced with = test::trace(scene, test::square_view(kSize_px));
    test::WrongPixels changed;
    for (std::size_t i = 0; i < with.samples.color.size(); ++i)
        changed.count(with.samples.object_id[i] != without.samples.object_id[i] ||
                      with.samples.radiance[i] != without.samples.radiance[i]);
    changed.report("without_area");
    EXPECT_EQ(changed.wrong, 0);
}

}  // namespace
}  // namespace macula
