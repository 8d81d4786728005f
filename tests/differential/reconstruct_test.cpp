// Reconstruction on the CPU: the reference against the rule in other words, the fast path against the reference, and
// what must hold for any plan.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "tests/support/reconstruct_cases.h"

namespace macula {
namespace {

using test::Case;
using test::Picture;
using test::random_case;
using test::reconstruct;
using test::sample_picture;
using test::shared_tables;
using test::tile_plan;

Picture reference_of(const SamplePlan& plan, const Samples& samples) {
    return reconstruct(*make_reference_reconstructor(shared_tables()), plan, samples);
}
Picture fast_of(const SamplePlan& plan, const Samples& samples) {
    return reconstruct(*make_cpu_reconstructor(shared_tables()), plan, samples);
}

void expect_equal(const Picture& expected, const Picture& result, const std::string& name) {
    if (expected.color.texels != result.color.texels || expected.inverse_depth.texels != result.inverse_depth.texels)
        ADD_FAILURE() << name << " differs: " << test::write_three_pictures(name, expected.color, result.color);
}

TEST(Reconstruct, FastPathEqualsReferenceToTheBit) {
    for (std::uint32_t seed = 1; seed <= 150 && !testing::Test::HasFailure(); ++seed) {
        const Case random = random_case(seed);
        expect_equal(reference_of(random.plan, random.samples), fast_of(random.plan, random.samples),
                     "reconstruct-cpu-seed-" + std::to_string(seed));
    }
}

/// The rule by places instead of addresses: a sample exists if the plan traced its pixel for its tile.
class RuleByPlaces {
public:
    explicit RuleByPlaces(const Case& from) : plan_(from.plan), samples_(from.samples) {
        for (const std::uint32_t address : plan_.trace_order)
            traced_[{plan_.position[address].x_px, plan_.position[address].y_px}] = address;
    }

    struct Weighted {
        std::uint32_t address;
        int weight;
    };

    /// The samples that a pixel is made of, the largest weight first; empty: none reaches it.
    [[nodiscard]] std::vector<Weighted> samples_of(int x, int y) const {
        if (plan_.hidden != nullptr && (*plan_.hidden)[static_cast<std::size_t>(y * plan_.width_px + x)] != 0)
            return {};
        const glm::ivec2 place = (glm::ivec2(x, y) - plan_.origin_px) / kTileEdge_px;
        const glm::ivec2 corner = plan_.origin_px + kTileEdge_px * place;
        const int pixel = kTileEdge_px * (y - corner.y) + x - corner.x;
        const int level = plan_.level[static_cast<std::size_t>(place.y * plan_.tiles_x + place.x)];
        if (level == kFullLevel) {
            const auto own = at({x, y});
            return own ? std::vector<Weighted>{{*own, 256}} : std::vector<Weighted>{};
        }
        std::vector<Weighted> found;
        for (int l = level; l >= 1; --l) {
            const glm::ivec2 torus = (corner + plan_.phase_px + 64) % 64;
            const CellTable& cell = shared_tables()->cell(l, torus.x / kTileEdge_px, torus.y / kTileEdge_px);
            const auto p = static_cast<std::size_t>(pixel);
            const std::array<std::pair<std::uint8_t, int>, 3> corners = {
                {{cell.a[p], 256 - cell.weight_b[p] - cell.weight_c[p]},
                 {cell.b[p], cell.weight_b[p]},
                 {cell.c[p], cell.weight_c[p]}}};
            found.clear();
            for (const auto& [index, weight] : corners) {
                const PaletteEntry& entry = cell.palette[index];
                const glm::ivec2 site = corner +
                                        kTileEdge_px * glm::ivec2(entry.neighbour % 3 - 1, entry.neighbour / 3 - 1) +
                                        glm::ivec2(entry.pixel % kTileEdge_px, entry.pixel / kTileEdge_px);
                if (const auto address = at(site)) found.push_back({*address, weight});
            }
            if (found.size() == 3) return found;
        }
        std::erase_if(found, [](const Weighted& w) { return w.weight == 0; });
        if (level == 0 || !found.empty()) return renormalised(found);
        return nearest_in_tile(corner, {x, y});
    }

private:
    [[nodiscard]] std::optional<std::uint32_t> at(glm::ivec2 site) const {
        const auto found = traced_.find({site.x, site.y});
        return found == traced_.end() ? std::nullopt : std::optional(found->second);
    }
    static std::vector<Weighted> renormalised(std::vector<Weighted> found) {
        if (found.empty()) return found;
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
        double total = 0.0;
        for (const Weighted& w : found) total += w.weight;
        int lesser = 0;
        for (std::size_t i = 1; i < found.size(); ++i)
            lesser += found[i].weight = static_cast<int>(std::floor(256.0 * found[i].weight / total + 0.5));
        found[0].weight = 256 - lesser;
        return found;
    }
    [[nodiscard]] std::vector<Weighted> nearest_in_tile(glm::ivec2 corner, glm::ivec2 pixel) const {
        int shortest = 1 << 20;
        std::vector<Weighted> nearest;
        for (int y = corner.y; y < corner.y + kTileEdge_px; ++y)
            for (int x = corner.x; x < corner.x + kTileEdge_px; ++x) {
                const auto address = at({x, y});
                const int distance = (x - pixel.x) * (x - pixel.x) + (y - pixel.y) * (y - pixel.y);
                if (!address || distance > shortest) continue;
                if (distance < shortest || *address < nearest.front().address) nearest = {{*address, 256}};
                shortest = distance;
            }
        return nearest;
    }

    const SamplePlan& plan_;
    const Samples& samples_;
    std::map<std::pair<int, int>, std::uint32_t> traced_;
};

TEST(Reconstruct, ReferenceFollowsTheRule) {
    for (std::uint32_t seed = 1000; seed <= 1060; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Case random = random_case(seed);
        const Picture picture = reference_of(random.plan, random.samples);
        const RuleByPlaces rule(random);
        for (int y = 0; y < random.plan.height_px; ++y)
            for (int x = 0; x < random.plan.width_px; ++x) {
                const auto parts = rule.samples_of(x, y);
                std::array<double, 4> channel = {0.0, 0.0, 0.0, parts.empty() ? 255.0 : 0.0};
                double depth = 0.0;
                float nearest = 0.0F;
                float farthest = parts.empty() ? 0.0F : 1e9F;
                for (const auto& [address, weight] : parts) {
                    for (unsigned c = 0; c < 4; ++c)
                        channel[c] += weight / 256.0 * ((random.samples.color[address] >> (8 * c)) & 255U);
                    const float sample = random.samples.inverse_depth_per_m[address];
                    depth += weight / 256.0 * sample;
                    nearest = std::max(nearest, sample);
                    farthest = std::min(farthest, sample);
                }
                // 1.25: documented in server/kernels/reconstruct.h
                if (nearest > 1.25F * farthest) depth = random.samples.inverse_depth_per_m[parts[0].address];
                for (unsigned c = 0; c < 4; ++c)
                    ASSERT_EQ((picture.color.at(x, y) >> (8 * c)) & 255U, std::floor(channel[c] + 0.5))
                        << "pixel " << x << ", " << y << " channel " << c;
                ASSERT_NEAR(picture.inverse_depth.at(x, y), depth, 1e-6 * nearest) << "pixel " << x << ", " << y;
            }
    }
}

/// A plan whose levels fall off in rings, all samples traced.
SamplePlan ring_plan(glm::ivec2 phase) {
    return tile_plan(
        shared_tables()->rank_tile(), 301, 203, phase,
        [](int x, int y) {
            return std::clamp(kFullLevel + 2 - 2 * (std::abs(x - 8) + std::abs(y - 6)), 1, kFullLevel);
        },
        [](int, int) { return true; });
}

TEST(Reconstruct, ConstantPictureStaysConstant) {
    for (const glm::ivec2 phase : {glm::ivec2(0, 0), glm::ivec2(13, 50), glm::ivec2(63, 16)}) {
        const SamplePlan plan = ring_plan(phase);
        const Samples samples = sample_picture(
            plan, [](int, int) { return 0xFF37C8FEU; }, [](int, int) { return 0.371F; });
        for (const Picture& picture : {reference_of(plan, samples), fast_of(plan, samples)})
            for (std::size_t i = 0; i < picture.color.texels.size(); ++i) {
                ASSERT_EQ(picture.color.texels[i], 0xFF37C8FEU);
                ASSERT_EQ(picture.inverse_depth.texels[i], 0.371F);
            }
    }
}

// Inverse depth is affine over a plane, and so is the interpolation: what is left is the rounding of the weights to
// 1/256, each by at most half of it, times the difference of samples that are at most a few spacings apart.
TEST(Reconstruct, PlaneIsReconstructed) {
    const SamplePlan plan = ring_plan({5, 41});
    const auto plane = [](int x, int y) {
        return 0.4F + 0.0004F * static_cast<float>(x) - 0.0003F * static_cast<float>(y);
    };
    const Samples samples = sample_picture(
        plan, [](int, int) { return 0xFF000000U; }, plane);
    const Picture picture = fast_of(plan, samples);
    double worst = 0.0;
    for (int y = 0; y < plan.height_px; ++y)
        for (int x = 0; x < plan.width_px; ++x)
            worst = std::max(worst, std::abs(static_cast<double>(picture.inverse_depth.at(x, y) - plane(x, y))));
    constexpr double kLargestSpacing_px = 24.0;  // at level 1, four samples a tile
    EXPECT_LE(worst, 2.0 * 0.5 / 256.0 * kLargestSpacing_px * 0.0005);
    EXPECT_GT(worst, 0.0) << "nothing was interpolated";
}

TEST(Reconstruct, FullLevelIsACopyToTheBit) {
    const SamplePlan plan = tile_plan(
        shared_tables()->rank_tile(), 75, 61, {9, 30}, [](int, int) { return kFullLevel; },
        [](int x, int y) { return (x * 7 + y * 3) % 11 != 0; });
    const auto color = [](int x, int y) { return 0xFF000000U | static_cast<Rgba8>(x * 54321 ^ y * 777); };
    const auto depth = [](int x, int y) { return static_cast<float>((x * x + y) % 17) / 3.0F; };
    const Samples samples = sample_picture(plan, color, depth);
    for (const Picture& picture : {reference_of(plan, samples), fast_of(plan, samples)})
        for (int y = 0; y < plan.height_px; ++y)
            for (int x = 0; x < plan.width_px; ++x) {
                const bool traced = (x * 7 + y * 3) % 11 != 0;
                ASSERT_EQ(picture.color.at(x, y), traced ? color(x, y) : 0xFF000000U);
                ASSERT_EQ(picture.inverse_depth.at(x, y), traced ? depth(x, y) : 0.0F);
            }
}

TEST(Reconstruct, HiddenTilesAreBlack) {
    const SamplePlan plan = tile_plan(
        shared_tables()->rank_tile(), 100, 40, {0, 0}, [](int x, int) { return x < 4 ? 0 : 7; },
        [](int, int) { return true; });
    const Samples samples = sample_picture(
        plan, [](int, int) { return 0xFFFFFFFFU; }, [](int, int) { return 1.0F; });
    for (const Picture& picture : {reference_of(plan, samples), fast_of(plan, samples)})
        for (int x = 0; x < plan.width_px; ++x) {
            const bool hidden = x < 3 * kTileEdge_px;
            ASSERT_EQ(picture.color.at(x, 20), hidden ? 0xFF000000U : 0xFFFFFFFFU) << x;
            ASSERT_EQ(picture.inverse_depth.at(x, 20), hidden ? 0.0F : 1.0F) << x;
        }
}

}  // namespace
}  // namespace macula
