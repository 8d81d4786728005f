#include <gtest/gtest.h>

#include <array>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "scenes/mesh_attributes.h"
#include "scenes/shapes.h"

namespace macula {
namespace {

glm::vec3 face_normal(const Mesh& mesh, const glm::uvec3& t) {
    return glm::cross(mesh.position_m[t.y] - mesh.position_m[t.x], mesh.position_m[t.z] - mesh.position_m[t.x]);
}

/// Volume by the divergence theorem: positive if the fronts are outside.
double signed_volume(const Mesh& mesh) {
    double six = 0.0;
    for (const glm::uvec3& t : mesh.triangle)
        six += glm::dot(glm::dvec3(mesh.position_m[t.x]),
                        glm::cross(glm::dvec3(mesh.position_m[t.y]), glm::dvec3(mesh.position_m[t.z])));
    return six / 6.0;
}

/// Whether each edge, by place, is walked once in each direction.
bool is_closed(const Mesh& mesh) {
    const auto key = [&mesh](unsigned i) {
        const glm::ivec3 p = glm::ivec3(glm::round(mesh.position_m[i] * 1e4F));
        return std::array{p.x, p.y, p.z};
    };
    std::map<std::pair<std::array<int, 3>, std::array<int, 3>>, int> edges;
    for (const glm::uvec3& t : mesh.triangle)
        for (int c = 0; c < 3; ++c) {
            const auto a = key(t[c]);
            const auto b = key(t[(c + 1) % 3]);
            ++edges[{a, b}];
            --edges[{b, a}];
        }
    for (const auto& [edge, balance] : edges)
        if (balance != 0) return false;
    return !edges.empty();
}

struct Shape {
    const char* name;
    Mesh mesh;
    double volume;
    double tolerance;
};

std::vector<Shape> shapes() {
    constexpr double kPi = std::numbers::pi;
    std::vector<Shape> all;
    all.push_back({"box", make_box({2, 3, 4}), 24.0, 1e-5});
    all.push_back({"sphere", make_sphere(1.0F), 4.0 / 3.0 * kPi, 1e-2});
    all.push_back({"cylinder", make_cylinder(1.0F, 1.0F, 2.0F), 2.0 * kPi, 2e-2});
    all.push_back({"cone", make_cylinder(1.0F, 0.0F, 3.0F), kPi, 2e-2});
    all.push_back({"torus", make_torus(2.0F, 0.5F), 2.0 * kPi * kPi * 2.0 * 0.25, 0.1});
    all.push_back({"knot", make_torus_knot(2, 3, 1.0F, 0.1F), 0.0, 0.0});
    return all;
}

TEST(Shapes, AreClosedAndFaceOutwards) {
    for (const Shape& shape : shapes()) {
        EXPECT_TRUE(is_closed(shape.mesh)) << shape.name;
        if (shape.tolerance > 0.0) {
            EXPECT_NEAR(signed_volume(shape.mesh), shape.volume, shape.tolerance) << shape.name;
        }
        EXPECT_GT(signed_volume(shape.mesh), 0.0) << shape.name;
        for (const glm::uvec3& t : shape.mesh.triangle)
            for (int c = 0; c < 3; ++c)
                ASSERT_GE(glm::dot(face_normal(shape.mesh, t), shape.mesh.normal[t[c]]), 0.0F) << shape.name;
        for (const glm::vec3& n : shape.mesh.normal) ASSERT_NEAR(glm::length(n), 1.0F, 1e-5F) << shape.name;
        for (const glm::vec2& uv : shape.mesh.uv0) {
            ASSERT_GE(std::min(uv.x, uv.y), -1e-6F) << shape.name;
            ASSERT_LE(std::max(uv.x, uv.y), 1.0F + 1e-6F) << shape.name;
        }
    }
}

TEST(Shapes, AQuadShowsItsImageUpright) {
    const Mesh mesh = make_quad({-1, 2, 0}, {2, 0, 0}, {0, -2, 0});
    EXPECT_EQ(mesh.normal[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.uv0[0], glm::vec2(0, 0));
    EXPECT_EQ(mesh.position_m[0], glm::vec3(-1, 2, 0)) << "the image's corner (0, 0) is on top, left";
}

TEST(MeshAttributes, SmoothNormalsDoNotDependOnTheCut) {
    // A cube whose faces are cut along either diagonal: corners look along the space diagonals.
    Mesh cube;
    for (int i = 0; i < 8; ++i) cube.position_m.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    cube.triangle = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2},
                     {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
    add_smooth_normals(cube);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(glm::dot(cube.normal[i], glm::normalize(cube.position_m[i])), 1.0F, 1e-6F) << i;
}

TEST(MeshAttributes, FlatNormalsAreTheTriangles) {
    Mesh mesh = make_sphere(1.0F, 16);
    const Mesh before = mesh;
    add_flat_normals(mesh);
    ASSERT_EQ(mesh.position_m.size(), 3 * before.triangle.size());
    ASSERT_EQ(mesh.uv0.size(), mesh.position_m.size());
    for (std::size_t i = 0; i < before.triangle.size(); ++i) {
        const glm::vec3 normal = glm::normalize(face_normal(before, before.triangle[i]));
        for (int c = 0; c < 3; ++c) {
            const unsigned vertex = mesh.triangle[i][c];
            EXPECT_EQ(mesh.position_m[vertex], before.position_m[before.triangle[i][c]]);
            EXPECT_EQ(mesh.uv0[vertex], before.uv0[before.triangle[i][c]]);
            EXPECT_NEAR(glm::dot(mesh.normal[vertex], normal), 1.0F, 1e-5F);
        }
    }
}

TEST(MeshAttributes, TangentsOfRandomPlanesFollowU) {
    const auto seed = static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed());
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(-1.0F, 1.0F);
    for (int round = 0; round < 500; ++round) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
        const auto vector = [&] { return glm::vec3(number(random), number(random), number(random)); };
        const glm::vec3 du = vector();
        const glm::vec3 dv = vector();
        const glm::vec3 normal = glm::cross(du, dv);
        if (glm::length(normal) < 0.05F) continue;
        // The surface p = u du + v dv.
        Mesh mesh;
        for (int i = 0; i < 3; ++i) {
            mesh.uv0.emplace_back(number(random), number(random));
            mesh.position_m.push_back(mesh.uv0.back().x * du + mesh.uv0.back().y * dv);
        }
        mesh.triangle = {{0, 1, 2}};
        const glm::vec3 face = face_normal(mesh, mesh.triangle[0]);
        if (glm::length(face) < 1e-3F) continue;
        mesh.normal.assign(3, glm::normalize(face));
        add_tangents(mesh, mesh.uv0);
        const glm::vec3 tangent(mesh.tangent[0]);
        EXPECT_NEAR(glm::dot(tangent, glm::normalize(du)), 1.0F, 1e-3F);
        EXPECT_NEAR(glm::dot(tangent, mesh.normal[0]), 0.0F, 1e-5F);
        const glm::vec3 bitangent = mesh.tangent[0].w * glm::cross(mesh.normal[0], tangent);
        EXPECT_LT(glm::dot(bitangent, dv), 0.0F) << "the bitangent points to the top of the image, against v";
    }
}

TEST(MeshAttributes, DegenerateCoordinatesStillGiveUnitTangents) {
    Mesh mesh = make_sphere(1.0F, 16);
    add_tangents(mesh, std::vector<glm::vec2>(mesh.position_m.size(), glm::vec2(0.5F)));
    for (std::size_t i = 0; i < mesh.tangent.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::vec3(mesh.tangent[i])), 1.0F, 1e-5F);
        EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangent[i]), mesh.normal[i]), 0.0F, 1e-5F);
    }
}

}  // namespace
}  // namespace macula
