#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "masks/mesh/sample_mesh.h"
#include "tests/support/triangulated.h"

namespace macula {
namespace {

SampleMesh good_mesh() {
    std::mt19937 random(20261122);
    return testing::triangulated(40, 30, testing::scattered_sites(40, 30, 0.3, random));
}

TEST(SampleMesh, GoodMeshesHaveNoDefect) {
    EXPECT_EQ(mesh_defect(good_mesh()), "");
    std::mt19937 random(1);
    EXPECT_EQ(mesh_defect(testing::triangulated(2, 2, testing::scattered_sites(2, 2, 0.0, random))), "");
    EXPECT_EQ(mesh_defect(testing::triangulated(16384, 2, testing::scattered_sites(16384, 2, 0.01, random))), "");
    EXPECT_EQ(mesh_defect(testing::triangulated(31, 57, testing::scattered_sites(31, 57, 1.0, random))), "");
}

TEST(SampleMesh, EveryDefectIsNamed) {
    struct Case {
        const char* message;
        std::function<void(SampleMesh&)> damage;
    };
    const std::vector<Case> cases = {
        {"sides are not", [](SampleMesh& m) { m.width_px = 1; }},
        {"sides are not", [](SampleMesh& m) { m.height_px = 16385; }},
        {"gaze is not on", [](SampleMesh& m) { m.gaze_px.x = 40; }},
        {"gaze is not on", [](SampleMesh& m) { m.gaze_px.y = -1; }},
        {"is not on the mask", [](SampleMesh& m) { m.site[5].x_px = -1; }},
        {"is not on the mask", [](SampleMesh& m) { m.site[5].y_px = 30; }},
        {"repeats another", [](SampleMesh& m) { m.site[5] = m.site[9]; }},
        {"a corner of the mask is not a site", [](SampleMesh& m) { m.height_px = 31; }},
        {"a corner of the mask is not a site", [](SampleMesh& m) { m.site.clear(); }},
        {"has the corner", [](SampleMesh& m) { m.triangle[7][1] = static_cast<std::uint32_t>(m.site.size()); }},
        {"wrong way", [](SampleMesh& m) { std::swap(m.triangle[7][1], m.triangle[7][2]); }},
        {"wrong way", [](SampleMesh& m) { m.triangle[7][1] = m.triangle[7][2]; }},
        {"is in no triangle",
         [](SampleMesh& m) {
             std::erase_if(m.triangle, [](const auto& t) { return std::find(t.begin(), t.end(), 17U) != t.end(); });
         }},
        {"cover", [](SampleMesh& m) { m.triangle.push_back(m.triangle[3]); }},
        {"cover", [](SampleMesh& m) { m.triangle[4] = m.triangle[3]; }},
    };
    for (const Case& c : cases) {
        SampleMesh mesh = good_mesh();
        c.damage(mesh);
        EXPECT_NE(mesh_defect(mesh).find(c.message), std::string::npos) << c.message << "; but: " << mesh_defect(mesh);
    }
}

TEST(SampleMesh, AnyOneTriangleThatIsMissingIsMissed) {
    const SampleMesh good = good_mesh();
    for (std::size_t i = 0; i < good.triangle.size(); ++i) {
        SampleMesh mesh = good;
        mesh.triangle.erase(mesh.triangle.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_NE(mesh_defect(mesh), "") << i;
    }
}

TEST(SampleMesh, ASiteInTheMiddleOfASideIsNotCover) {
    // The side from (0, 4) to (4, 0) has (2, 2) on it, a corner of the triangles on one side only. Areas add up.
    SampleMesh mesh;
    mesh.width_px = 5;
    mesh.height_px = 5;
    mesh.site = {{0, 0}, {4, 0}, {0, 4}, {4, 4}, {2, 2}};
    mesh.triangle = {{0, 2, 1}, {1, 4, 3}, {4, 2, 3}};
    EXPECT_NE(mesh_defect(mesh).find("cover"), std::string::npos) << mesh_defect(mesh);
    mesh.triangle = {{0, 4, 1}, {0, 2, 4}, {1, 4, 3}, {4, 2, 3}};
    EXPECT_EQ(mesh_defect(mesh), "");
}

}  // namespace
}  // namespace macula
