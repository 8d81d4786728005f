// What a mesh sampler traces, against a look at every pixel of the window.

#include "masks/mesh/mesh_sampler.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "tests/support/meshes.h"

namespace macula {
namespace {

constexpr unsigned kSeed = 20261122;

using glm::ivec2;

/// Sources of displays, masks and gazes.
class Chance {
public:
    explicit Chance(unsigned seed) : random_(seed) {}

    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    /// A small display of any frustum, with a round, a triangular, a ring-like or no outline.
    Display display() {
        Display display{"random", 4 * whole(16, 30), 4 * whole(16, 30), 90.0F, {}};
        for (EyeDisplay& eye : display.eyes) {
            eye.tangents = {real(-2.0F, -0.2F), real(0.2F, 2.0F), real(-2.0F, -0.2F), real(0.2F, 2.0F)};
            const int kind = whole(0, 3);
            const float radius = real(0.3F, 1.6F);
            add_circle(eye.visible_outline, radius, std::array{0, 3, 40, 40}[static_cast<std::size_t>(kind)]);
            // Around once more within: by the even-odd rule the middle is hidden.
            if (kind == 3) add_circle(eye.visible_outline, 0.3F * radius, 8);
        }
        return display;
    }
    /// A mask that covers it: of its size, or larger by any number of pixels.
    std::shared_ptr<const MeshTable> table(const Display& display) {
        const ivec2 size_px = ivec2(display.eye_width_px, display.eye_height_px) + ivec2(whole(0, 90), whole(0, 90));
        const ivec2 gaze_px(whole(0, size_px.x - 1), whole(0, size_px.y - 1));
        const float least = std::array{0.002F, 0.02F, 0.3F, 1.0F}[static_cast<std::size_t>(whole(0, 3))];
        return std::make_shared<const MeshTable>(
            MeshTable::make(test::foveal_mesh(random_, size_px.x, size_px.y, gaze_px, real(0.0F, 20.0F), least))
                .value());
    }
    /// Mostly into the image, sometimes in any direction.
    glm::vec3 gaze() {
        if (whole(0, 3) > 0) return glm::normalize(glm::vec3(real(-2.0F, 2.0F), real(-2.0F, 2.0F), -1.0F));
        for (;;) {
            const glm::vec3 v(real(-1.0F, 1.0F), real(-1.0F, 1.0F), real(-1.0F, 1.0F));
            if (glm::length(v) > 0.1F) return glm::normalize(v);
        }
    }

private:
    static void add_circle(std::vector<glm::vec2>& outline, float radius, int corners) {
        for (int i = 0; i < corners; ++i) {
            const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(corners);
            outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        }
    }

    std::mt19937 random_;
};

/// A plan with what tests look up in it.
struct Planned {
    const SamplePlan& plan;
    std::vector<std::uint8_t> hidden;

    [[nodiscard]] bool in_window(ivec2 p) const {
        return p.x >= 0 && p.y >= 0 && p.x < plan.width_px && p.y < plan.height_px;
    }
    [[nodiscard]] bool visible(ivec2 p) const {
        return in_window(p) && hidden[static_cast<std::size_t>(p.y * plan.width_px + p.x)] == 0;
    }
    [[nodiscard]] const MeshPixel& entry(ivec2 p) const {
        const ivec2 in_mask = p + plan.mesh_origin_px;
        return plan.mesh->pixels()[static_cast<std::size_t>(in_mask.y * plan.mesh->mesh().width_px + in_mask.x)];
    }
    /// Sites that some visible pixel interpolates; a visible site is among them, for itself.
    [[nodiscard]] std::set<std::pair<int, int>> needed() const {
        std::set<std::pair<int, int>> sites;
        for (int y = 0; y < plan.height_px; ++y) {
            for (int x = 0; x < plan.width_px; ++x) {
                if (!visible({x, y})) continue;
                const MeshPixel& p = entry({x, y});
                sites.emplace(x + p.ax, y + p.ay);
                sites.emplace(x + p.bx, y + p.by);
                sites.emplace(x + p.cx, y + p.cy);
            }
        }
        return sites;
    }
};

void expect_contract(const SamplePlan& plan, const Display& display, Eye eye, const MeshTable& table) {
    const Planned planned{plan, hidden_pixels(display, eye)};
    ASSERT_EQ(plan.width_px, display.eye_width_px);
    ASSERT_EQ(plan.height_px, display.eye_height_px);
    ASSERT_EQ(plan.mesh.get(), &table);
    ASSERT_NE(plan.hidden, nullptr);
    EXPECT_EQ(*plan.hidden, planned.hidden);
    EXPECT_FALSE(plan.has_tiles() || plan.has_grids());
    EXPECT_TRUE(plan.place.empty() && plan.untraced.empty());
    const ivec2 last_origin =
        ivec2(table.mesh().width_px, table.mesh().height_px) - ivec2(plan.width_px, plan.height_px);
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(plan.mesh_origin_px, ivec2(0))));
    ASSERT_TRUE(glm::all(glm::lessThanEqual(plan.mesh_origin_px, last_origin)));

    ASSERT_EQ(plan.spacing.size(), plan.address_count());
    ASSERT_EQ(plan.trace_order.size(), plan.address_count());
    std::set<std::pair<int, int>> traced;
    std::set<std::uint32_t> addresses;
    std::uint32_t inside = 0;
    for (const std::uint32_t address : plan.trace_order) {
        ASSERT_LT(address, plan.address_count());
        const ivec2 at(plan.position[address].x_px, plan.position[address].y_px);
        EXPECT_TRUE(addresses.insert(address).second && traced.emplace(at.x, at.y).second) << "traced twice";
        inside += planned.in_window(at) ? 1U : 0U;
        const ivec2 beyond = glm::max(-at, at - ivec2(plan.width_px - 1, plan.height_px - 1));
        EXPECT_LE(std::max(beyond.x, beyond.y), kMeshReach_px);
    }
    EXPECT_EQ(plan.traced_in_window, inside);
    EXPECT_EQ(traced, planned.needed());

    std::vector<float> spacing_at(table.pixels().size());
    for (std::size_t i = 0; i < table.mesh().site.size(); ++i) {
        const SamplePosition& p = table.mesh().site[i];
        spacing_at[static_cast<std::size_t>(p.y_px * table.mesh().width_px + p.x_px)] = table.spacing_px()[i];
    }
    for (std::uint32_t address = 0; address < plan.address_count(); ++address) {
        const SamplePosition& p = plan.position[address];
        const ivec2 in_mask = ivec2(p.x_px, p.y_px) + plan.mesh_origin_px;
        ASSERT_EQ(plan.spacing_px(address),
                  spacing_at[static_cast<std::size_t>(in_mask.y * table.mesh().width_px + in_mask.x)]);
    }
}

class RandomMeshPlan : public testing::TestWithParam<unsigned> {};

TEST_P(RandomMeshPlan, TracesWhatVisiblePixelsInterpolateAndNothingElse) {
    Chance chance(kSeed + GetParam());
    const Display display = chance.display();
    const auto table = chance.table(display);
    const Eye eye = chance.whole(0, 1) == 0 ? kLeftEye : kRightEye;
    MeshSampler sampler(display, eye, table, chance.whole(1, 20));
    SamplePlan plan;
    // What another sampler may have left.
    plan.level.assign(9, 3);
    plan.offset.assign(10, 7);
    plan.untraced.assign(2, 0);
    plan.place.resize(5);
    plan.grids.log_polar.count = {3, 4};
    for (int frame = 0; frame < 4; ++frame) {
        sampler.plan({chance.gaze(), {chance.whole(0, 63), chance.whole(0, 63)}}, plan);
        expect_contract(plan, display, eye, *table);
        if (HasFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMeshPlan, testing::Range(0U, 60U));

TEST(EdgeDistance, IsThatToTheNearestPixelOfTheOtherKind) {
    std::mt19937 random(kSeed);
    for (const double share : {0.02, 0.5, 0.98}) {
        const ivec2 size_px(37, 23);
        std::vector<std::uint8_t> hidden(static_cast<std::size_t>(size_px.x * size_px.y));
        for (std::uint8_t& h : hidden) h = std::bernoulli_distribution(share)(random) ? 1 : 0;
        const EdgeDistance edge(size_px, hidden);
        const auto is_seen = [&](ivec2 p) {
            return p.x >= 0 && p.y >= 0 && p.x < size_px.x && p.y < size_px.y &&
                   hidden[static_cast<std::size_t>(p.y * size_px.x + p.x)] == 0;
        };
        for (int y = -20; y < size_px.y + 20; ++y) {
            for (int x = -20; x < size_px.x + 20; ++x) {
                int nearest = 1000;
                for (int v = -1; v <= size_px.y; ++v) {
                    for (int u = -1; u <= size_px.x; ++u) {
                        if (is_seen({u, v}) != is_seen({x, y}))
                            nearest = std::min(nearest, std::max(std::abs(u - x), std::abs(v - y)));
                    }
                }
                ASSERT_EQ(edge.at({x, y}), is_seen({x, y}) ? nearest : 1 - nearest) << x << ", " << y;
            }
        }
        EXPECT_EQ(edge.at({-128, 5}), -127);
    }
}

/// A display of 128x96 pixels whose tangents are pixels / 100 off pixel (40, 50), and a mask around it.
struct Fixture {
    Display display{"fixture", 128, 96, 90.0F, {}};
    std::shared_ptr<const MeshTable> table;

    Fixture() {
        for (EyeDisplay& eye : display.eyes) eye.tangents = {-0.4F, 0.88F, -0.46F, 0.5F};
        std::mt19937 random(kSeed);
        table = std::make_shared<const MeshTable>(
            MeshTable::make(test::foveal_mesh(random, 256, 192, {128, 96}, 12.0F, 0.03F)).value());
    }
    /// Where the mask's gaze pixel comes to lie in the window for a gaze at the middle of a pixel.
    [[nodiscard]] ivec2 gaze_pixel(int step_px, glm::vec2 looked_at_px) const {
        const glm::vec2 tangents((looked_at_px.x + 0.5F) / 100.0F - 0.4F, 0.5F - (looked_at_px.y + 0.5F) / 100.0F);
        return gaze_pixel(step_px, glm::normalize(glm::vec3(tangents, -1.0F)));
    }
    [[nodiscard]] ivec2 gaze_pixel(int step_px, const glm::vec3& gaze_eye) const {
        MeshSampler sampler(display, kLeftEye, table, step_px);
        SamplePlan plan;
        sampler.plan({gaze_eye, ivec2(0)}, plan);
        return table->mesh().gaze_px - plan.mesh_origin_px;
    }
};

TEST(MeshSampler, FollowsTheGazePixelByPixel) {
    const Fixture f;
    for (int y = 0; y < 96; y += 7) {
        for (int x = 0; x < 128; x += 9) EXPECT_EQ(f.gaze_pixel(1, glm::vec2(x, y)), ivec2(x, y));
    }
}

TEST(MeshSampler, FollowsTheGazeInStepsFromTheWindowsEdge) {
    const Fixture f;
    for (int x = 0; x < 128; x += 3) {
        const int y = x / 2;
        EXPECT_EQ(f.gaze_pixel(16, glm::vec2(x, y)), ivec2(x / 16 * 16 + 8, y / 16 * 16 + 8));
        const ivec2 off = glm::abs(f.gaze_pixel(5, glm::vec2(x, y)) - ivec2(x, y));
        EXPECT_LE(std::max(off.x, off.y), 2);
    }
}

TEST(MeshSampler, StaysInsideTheMaskForEveryGaze) {
    const Fixture f;
    // The mask is twice the window, so that the gaze pixel reaches the window's edges and no farther.
    EXPECT_EQ(f.gaze_pixel(1, glm::vec2(500.0F, -300.0F)), ivec2(128, 0));
    EXPECT_EQ(f.gaze_pixel(1, glm::vec2(-500.0F, 40.0F)), ivec2(0, 40));
    EXPECT_EQ(f.gaze_pixel(1, glm::vec3(1.0F, 0.0F, 0.0F)), ivec2(128, 50)) << "to the right";
    EXPECT_EQ(f.gaze_pixel(1, glm::normalize(glm::vec3(-1.0F, 1.0F, 1.0F))), ivec2(0, 0)) << "behind, left, above";
    EXPECT_EQ(f.gaze_pixel(1, glm::vec3(0.0F, 0.0F, 1.0F)), ivec2(40, 50)) << "straight behind";
}

TEST(MeshSampler, AMaskOfTheWindowsSizeNeverMoves) {
    Chance chance(kSeed);
    const Display display = chance.display();
    const auto table = std::make_shared<const MeshTable>(
        MeshTable::make(test::make_mesh(display.eye_width_px, display.eye_height_px, {5, 5}, [](int, int) {
            return true;
        })).value());
    for (const Eye eye : {kLeftEye, kRightEye}) {
        MeshSampler sampler(display, eye, table);
        const std::vector<std::uint8_t> hidden = hidden_pixels(display, eye);
        const auto visible = static_cast<std::uint32_t>(std::count(hidden.begin(), hidden.end(), 0));
        SamplePlan plan;
        for (int frame = 0; frame < 5; ++frame) {
            sampler.plan({chance.gaze(), ivec2(0)}, plan);
            EXPECT_EQ(plan.mesh_origin_px, ivec2(0));
            // Full: each visible pixel is a sample of its own.
            EXPECT_EQ(plan.trace_order.size(), visible);
            EXPECT_EQ(plan.traced_in_window, visible);
            for (const SamplePosition& p : plan.position)
                ASSERT_EQ(hidden[static_cast<std::size_t>(p.y_px * plan.width_px + p.x_px)], 0);
            for (const float spacing_px : plan.spacing) ASSERT_EQ(spacing_px, 1.0F);
        }
    }
}

TEST(MeshSampler, TracesTheMasksShareOfAWindowWithoutHiddenPixels) {
    const Fixture f;
    MeshSampler sampler(f.display, kLeftEye, f.table);
    SamplePlan plan;
    sampler.plan({{0.0F, 0.0F, -1.0F}, ivec2(0)}, plan);
    std::uint32_t sampled = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 128; ++x)
            sampled += test::is_site(*f.table, x + plan.mesh_origin_px.x, y + plan.mesh_origin_px.y) ? 1U : 0U;
    }
    EXPECT_EQ(plan.traced_in_window, sampled);
    EXPECT_GT(plan.trace_order.size(), sampled) << "pixels at the edge interpolate sites beyond it";
}

TEST(MeshSampler, NeighboursInTheOrderAreNeighboursInThePlane) {
    const Fixture f;
    MeshSampler sampler(f.display, kLeftEye, f.table);
    SamplePlan plan;
    sampler.plan({glm::normalize(glm::vec3(0.24F, 0.02F, -1.0F)), ivec2(0)}, plan);
    // Of all packets, those of full blocks come first and are 4x4 pixels. Elsewhere 16 samples cover, on the average,
    // an area that is not much more than their own.
    double covered_px = 0.0;
    double own_px = 0.0;
    for (std::size_t first = 0; first + 16 <= plan.position.size(); first += 16) {
        ivec2 low(1 << 20);
        ivec2 high(-(1 << 20));
        for (std::size_t i = first; i < first + 16; ++i) {
            const ivec2 at(plan.position[i].x_px, plan.position[i].y_px);
            low = glm::min(low, at);
            high = glm::max(high, at);
            own_px += double{plan.spacing[i]} * plan.spacing[i];
        }
        covered_px += 1.0 * (high.x - low.x + 1) * (high.y - low.y + 1);
    }
    EXPECT_LT(covered_px, 4.0 * own_px);
}

TEST(MeshSampler, RefusesAMaskThatDoesNotCoverTheWindow) {
    const Fixture f;
    Display display = f.display;
    EXPECT_TRUE(check_mask_covers(f.table->mesh(), display).has_value());
    display.eye_width_px = 260;
    const auto refused = check_mask_covers(f.table->mesh(), display);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::input_file);
    EXPECT_NE(refused.error().message.find("256x192"), std::string::npos);
    EXPECT_NE(refused.error().message.find("260x96"), std::string::npos);
    EXPECT_THROW(MeshSampler(display, kLeftEye, f.table), std::invalid_argument);
    EXPECT_THROW(MeshSampler(f.display, kLeftEye, f.table, 0), std::invalid_argument);
}

}  // namespace
}  // namespace macula
