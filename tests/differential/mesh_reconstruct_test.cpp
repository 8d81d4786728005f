// Reconstruction of mesh plans on the CPU: table and raster against each other, against the rule in other words and
// against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "server/render/mesh_reconstructors.h"
#include "server/render/raster_mesh.h"
#include "tests/support/mesh_cases.h"

namespace macula {
namespace {

using test::Case;
using test::channel_difference;
using test::make_mesh;
using test::Picture;
using test::random_mesh_case;
using test::reconstruct;
using test::sample_picture;
using test::whole_mesh_plan;

void expect_equal(const Picture& expected, const Picture& result, const std::string& name) {
    if (expected.color.texels != result.color.texels || expected.inverse_depth.texels != result.inverse_depth.texels)
        ADD_FAILURE() << name << " differs: " << test::write_three_pictures(name, expected.color, result.color);
}

// The reconstructors are used again from case to case, so that what a frame leaves behind would be seen in the next.
TEST(MeshReconstruct, FastTableEqualsReferenceToTheBit) {
    const auto reference = make_reference_table_reconstructor();
    const auto fast = make_cpu_table_reconstructor();
    for (std::uint32_t seed = 1; seed <= 120 && !testing::Test::HasFailure(); ++seed) {
        const Case random = random_mesh_case(seed);
        expect_equal(reconstruct(*reference, random.plan, random.samples),
                     reconstruct(*fast, random.plan, random.samples), "table-seed-" + std::to_string(seed));
    }
}

/// What a pixel interpolates, by triangles instead of tables and in real numbers.
class RuleByTriangles {
public:
    explicit RuleByTriangles(const Case& from) : plan_(from.plan), samples_(from.samples) {
        const glm::ivec2 mask(plan_.mesh->mesh().width_px, plan_.mesh->mesh().height_px);
        address_.assign(static_cast<std::size_t>(mask.x * mask.y), -1);
        for (const std::uint32_t address : plan_.trace_order) {
            const SamplePosition at = plan_.position[address];
            address_[index(plan_.mesh_origin_px + glm::ivec2(at.x_px, at.y_px))] = static_cast<int>(address);
        }
    }

    struct Weighted {
        int address;
        double weight;
    };

    /// Samples whose weight is not 0, the largest weight first.
    [[nodiscard]] std::vector<Weighted> samples_of(glm::ivec2 pixel) const {
        const SampleMesh& mesh = plan_.mesh->mesh();
        const glm::ivec2 p = plan_.mesh_origin_px + pixel;
        for (const SampleMesh::Triangle& triangle : mesh.triangle) {
            std::array<glm::ivec2, 3> corner;
            for (std::size_t i = 0; i < 3; ++i) corner[i] = {mesh.site[triangle[i]].x_px, mesh.site[triangle[i]].y_px};
            const std::array<int, 3> edge = {cross(corner[1], corner[2], p), cross(corner[2], corner[0], p),
                                             cross(corner[0], corner[1], p)};
            if (std::max({edge[0], edge[1], edge[2]}) > 0) continue;
            std::vector<Weighted> found;
            for (std::size_t i = 0; i < 3; ++i)
                if (edge[i] != 0)
                    found.push_back({address_[index(corner[i])],
                                     static_cast<double>(edge[i]) / cross(corner[0], corner[1], corner[2])});
            std::stable_sort(found.begin(), found.end(),
                             [](const Weighted& a, const Weighted& b) { return a.weight > b.weight; });
            return found;
        }
        return {};
    }

private:
    /// (b - a) x (p - a): not positive inside, as SampleMesh orients its triangles.
    static int cross(glm::ivec2 a, glm::ivec2 b, glm::ivec2 p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    }
    [[nodiscard]] std::size_t index(glm::ivec2 in_mask) const {
        return static_cast<std::size_t>(in_mask.y * plan_.mesh->mesh().width_px + in_mask.x);
    }

    const SamplePlan& plan_;
    const Samples& samples_;
    std::vector<int> address_;  ///< per pixel of the mask; -1: not traced
};

// Weights in 1/256 are off by half of that each, which moves a channel by less than one code value; what is shown is
// rounded once more.
TEST(MeshReconstruct, TableAndRasterFollowTheRule) {
    const auto table = make_reference_table_reconstructor();
    const auto raster = make_cpu_raster_reconstructor();
    for (std::uint32_t seed = 1000; seed <= 1040; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Case random = random_mesh_case(seed);
        const Picture by_table = reconstruct(*table, random.plan, random.samples);
        const Picture by_raster = reconstruct(*raster, random.plan, random.samples);
        const RuleByTriangles rule(random);
        for (int y = 0; y < random.plan.height_px; y += 2)
            for (int x = 0; x < random.plan.width_px; x += 3) {
                SCOPED_TRACE("pixel " + std::to_string(x) + ", " + std::to_string(y));
                if (random.plan.hidden &&
                    (*random.plan.hidden)[static_cast<std::size_t>(y * random.plan.width_px + x)] != 0) {
                    for (const Picture* picture : {&by_table, &by_raster}) {
                        ASSERT_EQ(picture->color.at(x, y), 0xFF000000U);
                        ASSERT_EQ(picture->inverse_depth.at(x, y), 0.0F);
                    }
                    continue;
                }
                const auto parts = rule.samples_of({x, y});
                ASSERT_FALSE(parts.empty());
                std::array<double, 4> channel{};
                double depth = 0.0;
                double nearest = 0.0;
                double farthest = 1e9;
                for (const auto& [address, weight] : parts) {
                    ASSERT_GE(address, 0) << "the case does not trace what the pixel needs";
                    const auto i = static_cast<std::size_t>(address);
                    for (unsigned c = 0; c < 4; ++c)
                        channel[c] += weight * ((random.samples.color[i] >> (8 * c)) & 255U);
                    const double sample = random.samples.inverse_depth_per_m[i];
                    depth += weight * sample;
                    nearest = std::max(nearest, sample);
                    farthest = std::min(farthest, sample);
                }
                for (unsigned c = 0; c < 4; ++c) {
                    ASSERT_NEAR((by_table.color.at(x, y) >> (8 * c)) & 255U, channel[c], 1.5);
                    ASSERT_NEAR((by_raster.color.at(x, y) >> (8 * c)) & 255U, channel[c], 0.5 + 1e-4);
                }
                ASSERT_NEAR(by_raster.inverse_depth.at(x, y), depth, 1e-6 * nearest);
                // The table does not interpolate between surfaces (1.25: server/kernels/blend.h).
                if (nearest <= 1.2499 * farthest) {
                    ASSERT_NEAR(by_table.inverse_depth.at(x, y), depth, (nearest - farthest) / 256.0 + 1e-6 * nearest);
                } else if (nearest > 1.2501 * farthest &&
                           (parts.size() == 1 || parts[0].weight > parts[1].weight + 1e-9)) {
                    ASSERT_EQ(by_table.inverse_depth.at(x, y),
                              random.samples.inverse_depth_per_m[static_cast<std::size_t>(parts[0].address)]);
                }
            }
    }
}

TEST(MeshReconstruct, RasterIsWithinTwoCodeValuesOfTable) {
    const auto table = make_cpu_table_reconstructor();
    const auto raster = make_cpu_raster_reconstructor();
    for (std::uint32_t seed = 2000; seed <= 2100; ++seed) {
        const Case random = random_mesh_case(seed);
        const Picture by_table = reconstruct(*table, random.plan, random.samples);
        const Picture by_raster = reconstruct(*raster, random.plan, random.samples);
        int largest = 0;
        for (std::size_t i = 0; i < by_table.color.texels.size(); ++i)
            largest = std::max(largest, channel_difference(by_table.color.texels[i], by_raster.color.texels[i]));
        ASSERT_LE(largest, 2) << "seed " << seed << ": "
                              << test::write_three_pictures("raster-seed-" + std::to_string(seed), by_table.color,
                                                            by_raster.color);
    }
}

TEST(MeshReconstruct, FullMeshShowsTheSamplesToTheBit) {
    const SamplePlan plan = whole_mesh_plan(make_mesh({91, 67}, [](int, int) { return true; }));
    const auto color = [](int x, int y) { return 0xFF000000U | static_cast<Rgba8>(x * 54321 ^ y * 777); };
    const auto depth = [](int x, int y) { return static_cast<float>((x * x + y) % 17) / 3.0F; };
    const Samples samples = sample_picture(plan, color, depth);
    for (const auto& made :
         {make_reference_table_reconstructor, make_cpu_table_reconstructor, make_cpu_raster_reconstructor}) {
        const auto reconstructor = made();
        const Picture picture = reconstruct(*reconstructor, plan, samples);
        for (int y = 0; y < plan.height_px; ++y)
            for (int x = 0; x < plan.width_px; ++x) {
                ASSERT_EQ(picture.color.at(x, y), color(x, y)) << x << ", " << y;
                ASSERT_EQ(picture.inverse_depth.at(x, y), depth(x, y)) << x << ", " << y;
            }
    }
}

// A ramp is what any triangulation reproduces, but for rounding: weights are off by at most half of 1/256 each, times
// the difference of corners that are at most the mask's width apart.
TEST(MeshReconstruct, RampIsReproducedByEveryTriangulation) {
    const auto red = [](int x, int y) { return 40.0 + 0.9 * x + 0.7 * y; };
    const auto depth = [](int x, int y) {
        return 4.0F + 0.002F * static_cast<float>(x) - 0.003F * static_cast<float>(y);
    };
    const auto table = make_cpu_table_reconstructor();
    const auto raster = make_cpu_raster_reconstructor();
    double interpolated = 0.0;
    for (std::uint32_t seed = 3000; seed <= 3040; ++seed) {
        Case random = random_mesh_case(seed);
        const glm::ivec2 origin = random.plan.mesh_origin_px;
        random.samples = sample_picture(
            random.plan,
            [&](int x, int y) {
                return 0xFF000000U | static_cast<Rgba8>(std::lround(red(x + origin.x, y + origin.y)));
            },
            [&](int x, int y) { return depth(x + origin.x, y + origin.y); });
        const Picture by_table = reconstruct(*table, random.plan, random.samples);
        const Picture by_raster = reconstruct(*raster, random.plan, random.samples);
        for (int y = 0; y < random.plan.height_px; ++y)
            for (int x = 0; x < random.plan.width_px; ++x) {
                if (random.plan.hidden &&
                    (*random.plan.hidden)[static_cast<std::size_t>(y * random.plan.width_px + x)] != 0)
                    continue;
                const double expected_red = red(x + origin.x, y + origin.y);
                const float expected_depth = depth(x + origin.x, y + origin.y);
                // Samples are rounded, then their mean; the table's weights add 120 px * .9 / 256.
                ASSERT_NEAR(by_raster.color.at(x, y) & 255U, expected_red, 1.01) << "seed " << seed;
                ASSERT_NEAR(by_table.color.at(x, y) & 255U, expected_red, 1.8) << "seed " << seed;
                ASSERT_NEAR(by_raster.inverse_depth.at(x, y), expected_depth, 3e-6) << "seed " << seed;
                ASSERT_NEAR(by_table.inverse_depth.at(x, y), expected_depth, 120 * 0.005 / 256.0) << "seed " << seed;
                interpolated = std::max(
                    interpolated, std::abs(static_cast<double>(by_table.inverse_depth.at(x, y) - expected_depth)));
            }
    }
    EXPECT_GT(interpolated, 0.0) << "nothing was interpolated";
}

TEST(MeshReconstruct, ColourAndDepthMayHaveRowsOfDifferentLength) {
    const Case random = random_mesh_case(4000);
    const auto width = static_cast<std::size_t>(random.plan.width_px);
    for (const auto& made :
         {make_reference_table_reconstructor, make_cpu_table_reconstructor, make_cpu_raster_reconstructor}) {
        const auto reconstructor = made();
        const Picture expected = reconstruct(*reconstructor, random.plan, random.samples);
        ColorImage color(random.plan.width_px + 5, random.plan.height_px);
        InverseDepthImage depth(random.plan.width_px + 11, random.plan.height_px);
        ASSERT_TRUE(reconstructor->reconstruct(random.plan, random.samples,
                                               {color.texels.data(), width + 5, depth.texels.data(), width + 11}));
        for (int y = 0; y < random.plan.height_px; ++y)
            for (int x = 0; x < random.plan.width_px; ++x) {
                ASSERT_EQ(color.at(x, y), expected.color.at(x, y));
                ASSERT_EQ(depth.at(x, y), expected.inverse_depth.at(x, y));
            }
    }
}

TEST(MeshReconstruct, PlanWithoutAMeshIsRefused) {
    SamplePlan plan;
    plan.width_px = plan.height_px = 1;
    plan.position.resize(1);
    Rgba8 color = 0;
    float depth = 0.0F;
    for (const auto& made :
         {make_reference_table_reconstructor, make_cpu_table_reconstructor, make_cpu_raster_reconstructor}) {
        const auto refused = made()->reconstruct(plan, {}, {&color, 1, &depth, 1});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::option);
        EXPECT_NE(refused.error().message.find("mesh"), std::string::npos) << refused.error().message;
    }
}

/// Whether a triangle's bounding box has a part in a rectangle.
bool touches(const RasterMesh& mesh, std::size_t first_index, glm::ivec2 first_px, glm::ivec2 size_px) {
    glm::ivec2 least(INT32_MAX);
    glm::ivec2 most(INT32_MIN);
    for (std::size_t i = first_index; i < first_index + 3; ++i) {
        const RasterVertex& vertex = mesh.vertices()[mesh.indices()[i]];
        least = glm::min(least, glm::ivec2(vertex.x_px, vertex.y_px));
        most = glm::max(most, glm::ivec2(vertex.x_px, vertex.y_px));
    }
    return most.x >= first_px.x && most.y >= first_px.y && least.x < first_px.x + size_px.x &&
           least.y < first_px.y + size_px.y;
}

TEST(RasterMesh, RangesHoldWhatIsNearAWindowAndLittleElse) {
    std::mt19937 random(5);
    const glm::ivec2 mask(700, 500);
    const auto table = make_mesh(mask, [&](int x, int y) {
        const bool border = x == 0 || y == 0 || x == mask.x - 1 || y == mask.y - 1;
        return random() % (border ? 4 : 20) == 0;
    });
    const RasterMesh mesh(table->mesh());
    std::vector<IndexRange> ranges;
    for (int round = 0; round < 50; ++round) {
        const auto draw = [&random](int first, int last) { return std::uniform_int_distribution(first, last)(random); };
        const glm::ivec2 size(draw(1, mask.x), draw(1, mask.y));
        const glm::ivec2 first(draw(0, mask.x - size.x), draw(0, mask.y - size.y));
        mesh.find_ranges(first, size, ranges);
        EXPECT_LE(ranges.size(), 8U) << "one for each 64 rows";
        std::vector<std::uint8_t> in_range(mesh.indices().size() / 3, 0);
        for (const IndexRange& range : ranges)
            for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) ++in_range[i / 3];
        // Blocks of 64 px, in which triangles begin that reach some 40 px.
        const glm::ivec2 margin(64 + 40);
        for (std::size_t i = 0; i < in_range.size(); ++i) {
            if (touches(mesh, 3 * i, first, size)) {
                ASSERT_EQ(in_range[i], 1) << "round " << round;
            } else if (!touches(mesh, 3 * i, first - margin, size + 2 * margin)) {
                ASSERT_EQ(in_range[i], 0) << "round " << round;
            }
        }
    }
}

}  // namespace
}  // namespace macula
