#include "masks/tile_sampler.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "tests/support/law_for_share.h"

namespace macula {
namespace {

constexpr unsigned kSeed = 20261122;

std::shared_ptr<const TileTables> shared_tables() {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    return kTables;
}

/// Sources of displays, gazes and phases.
class Chance {
public:
    explicit Chance(unsigned seed) : random_(seed) {}

    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    /// Any direction, behind the head too.
    glm::vec3 direction() {
        for (;;) {
            const glm::vec3 v(real(-1.0F, 1.0F), real(-1.0F, 1.0F), real(-1.0F, 1.0F));
            if (glm::length(v) > 0.1F && glm::length(v) <= 1.0F) return glm::normalize(v);
        }
    }
    PlanRequest request() {
        // Mostly into the image.
        const glm::vec3 ahead(real(-1.2F, 1.2F), real(-1.2F, 1.2F), -1.0F);
        return {whole(0, 3) == 0 ? direction() : glm::normalize(ahead), {whole(0, 63), whole(0, 63)}};
    }
    /// A small display of any frustum, with a round, a triangular or no outline.
    Display display() {
        Display display{"random", 4 * whole(16, 60), 4 * whole(16, 60), 90.0F, {}};
        for (EyeDisplay& eye : display.eyes) {
            eye.tangents = {real(-2.0F, -0.2F), real(0.2F, 2.0F), real(-2.0F, -0.2F), real(0.2F, 2.0F)};
            const int corners = std::array{0, 3, 40}[static_cast<std::size_t>(whole(0, 2))];
            const float radius = real(0.3F, 1.6F);
            for (int i = 0; i < corners; ++i) {
                const float angle =
                    2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(corners);
                eye.visible_outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
            }
        }
        return display;
    }
    std::optional<AcuityLaw> law() {
        if (whole(0, 9) == 0) return std::nullopt;
        AcuityLaw law;
        law.stretch = std::exp(real(-1.0F, 3.0F)) / 2.3;
        // Small displays have few pixels per degree: without this all would be traced.
        law.model = GeislerPerry{.alpha_deg = 0.106 * real(1.0F, 40.0F)};
        return law;
    }

private:
    std::mt19937 random_;
};

/// A plan with what tests look up in it.
struct Planned {
    SamplePlan plan;
    std::vector<std::uint8_t> hidden;
    std::vector<std::uint8_t> traced;  ///< per address: times it occurs in trace_order

    Planned(const Display& display, Eye eye, SamplePlan made)
        : plan(std::move(made)), hidden(hidden_pixels(display, eye)), traced(plan.address_count()) {
        for (const std::uint32_t address : plan.trace_order) ++traced.at(address);
    }

    [[nodiscard]] bool in_window(int x, int y) const {
        return x >= 0 && y >= 0 && x < plan.width_px && y < plan.height_px;
    }
    [[nodiscard]] bool visible(int x, int y) const { return in_window(x, y) && hidden[y * plan.width_px + x] == 0; }
    [[nodiscard]] glm::ivec2 origin(int tile) const {
        return plan.origin_px + 16 * glm::ivec2(tile % plan.tiles_x, tile / plan.tiles_x);
    }
    [[nodiscard]] int count(int tile) const { return kLevelCounts[plan.level[tile]]; }
    [[nodiscard]] bool guard(int tile) const {
        const int x = tile % plan.tiles_x;
        const int y = tile / plan.tiles_x;
        return x == 0 || y == 0 || x == plan.tiles_x - 1 || y == plan.tiles_y - 1;
    }
    [[nodiscard]] int visible_pixels(int tile) const {
        int n = 0;
        for (int i = 0; i < kTileArea_px; ++i) n += visible(origin(tile).x + i % 16, origin(tile).y + i / 16) ? 1 : 0;
        return n;
    }
};

void expect_grid_covers_the_window(const Planned& p) {
    const SamplePlan& plan = p.plan;
    EXPECT_EQ(plan.origin_px, -16 - plan.phase_px % 16);
    // The last inner tile touches the window, the guard does not.
    EXPECT_LT(plan.origin_px.x + 16 * (plan.tiles_x - 2), plan.width_px);
    EXPECT_GE(plan.origin_px.x + 16 * (plan.tiles_x - 1), plan.width_px);
    EXPECT_LT(plan.origin_px.y + 16 * (plan.tiles_y - 2), plan.height_px);
    EXPECT_GE(plan.origin_px.y + 16 * (plan.tiles_y - 1), plan.height_px);
    const auto tiles = static_cast<std::size_t>(plan.tiles_x) * plan.tiles_y;
    ASSERT_EQ(plan.level.size(), tiles);
    ASSERT_EQ(plan.incomplete.size(), tiles);
    ASSERT_EQ(plan.offset.size(), tiles + 1);
    ASSERT_EQ(plan.position.size(), plan.address_count());
}

void expect_addresses_hold_the_samples_of_their_tile(const Planned& p, const RankTile& ranks) {
    const SamplePlan& plan = p.plan;
    std::uint32_t next = 0;
    for (int tile = 0; tile < plan.tiles_x * plan.tiles_y; ++tile) {
        ASSERT_EQ(plan.offset[tile], next);
        next += static_cast<std::uint32_t>(p.count(tile));
        std::set<std::pair<int, int>> pixels;
        for (int k = 0; k < p.count(tile); ++k) {
            const SamplePosition at = plan.position[plan.offset[tile] + k];
            const glm::ivec2 in_tile = glm::ivec2(at.x_px, at.y_px) - p.origin(tile);
            ASSERT_TRUE(in_tile.x >= 0 && in_tile.y >= 0 && in_tile.x < 16 && in_tile.y < 16);
            const int order = plan.level[tile] == kFullLevel
                                  ? 16 * in_tile.y + in_tile.x
                                  : ranks.at((at.x_px + plan.phase_px.x) & 63, (at.y_px + plan.phase_px.y) & 63);
            ASSERT_EQ(order, k);
        }
    }
    EXPECT_EQ(plan.address_count(), next);
}

void expect_each_address_once(const Planned& p) {
    std::vector<std::uint8_t> times = p.traced;
    for (const std::uint32_t address : p.plan.untraced) ++times.at(address);
    EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
    for (int tile = 0; tile < p.plan.tiles_x * p.plan.tiles_y; ++tile) {
        const auto begin = p.traced.begin() + p.plan.offset[tile];
        const auto end = p.traced.begin() + p.plan.offset[tile + 1];
        EXPECT_EQ(p.plan.incomplete[tile] != 0, std::find(begin, end, 0) != end);
    }
}

void expect_visible_samples_traced_and_hidden_ones_not(const Planned& p, const RankTile& ranks) {
    const SamplePlan& plan = p.plan;
    std::vector<std::uint8_t> pixel_traced(p.hidden.size());
    for (const std::uint32_t address : plan.trace_order) {
        const SamplePosition at = plan.position[address];
        if (p.in_window(at.x_px, at.y_px)) ++pixel_traced[at.y_px * plan.width_px + at.x_px];
    }
    std::uint32_t total = 0;
    for (int y = 0; y < plan.height_px; ++y) {
        for (int x = 0; x < plan.width_px; ++x) {
            const bool expected = p.visible(x, y) && is_traced(plan, ranks, x, y);
            ASSERT_EQ(pixel_traced[y * plan.width_px + x], expected ? 1 : 0) << x << ", " << y;
            total += expected ? 1U : 0U;
        }
    }
    EXPECT_EQ(plan.traced_in_window, total);
}

/// The rule that the Frame message documents, from the level map without the guard ring.
void expect_the_messages_rule_agrees(const Planned& p, const RankTile& ranks) {
    const SamplePlan& plan = p.plan;
    const int tiles_x = plan.tiles_x - 2;
    std::vector<std::uint8_t> level;
    for (int y = 1; y < plan.tiles_y - 1; ++y) {
        for (int x = 1; x < plan.tiles_x - 1; ++x) level.push_back(plan.level[y * plan.tiles_x + x]);
    }
    for (int y = 0; y < plan.height_px; ++y) {
        for (int x = 0; x < plan.width_px; ++x) {
            const int rank = ranks.rank[(y + plan.phase_px.y) % 64 * 64 + (x + plan.phase_px.x) % 64];
            const int tile = (y + plan.phase_px.y % 16) / 16 * tiles_x + (x + plan.phase_px.x % 16) / 16;
            ASSERT_EQ(rank < kLevelCounts[level[tile]], is_traced(plan, ranks, x, y));
        }
    }
}

void expect_levels_where_something_is_visible(const Planned& p) {
    for (int tile = 0; tile < p.plan.tiles_x * p.plan.tiles_y; ++tile) {
        EXPECT_TRUE(p.guard(tile) || (p.plan.level[tile] != 0) == (p.visible_pixels(tile) > 0));
    }
}

/// What the pixels inside need from beyond the window's edge is traced, wherever the tile is dense enough; and
/// what is traced there is within reach of a pixel that needs it.
void expect_guard_samples(const Planned& p, const TileTables& tables) {
    const SamplePlan& plan = p.plan;
    std::vector<std::uint8_t> needed(plan.address_count());
    for (int tile = 0; tile < plan.tiles_x * plan.tiles_y; ++tile) {
        if (p.guard(tile) || plan.level[tile] == 0 || plan.level[tile] == kFullLevel) continue;
        const glm::ivec2 cell = ((p.origin(tile) + plan.phase_px) & 63) / 16;
        const CellTable& table = tables.cell(plan.level[tile], cell.x, cell.y);
        for (int i = 0; i < kTileArea_px; ++i) {
            const glm::ivec2 pixel = p.origin(tile) + glm::ivec2(i % 16, i / 16);
            if (!p.in_window(pixel.x, pixel.y)) continue;
            for (const int index : {table.a[i], table.b[i], table.c[i]}) {
                const PaletteEntry& entry = table.palette[index];
                const glm::ivec2 step(entry.neighbour % 3 - 1, entry.neighbour / 3 - 1);
                const int other = tile + step.y * plan.tiles_x + step.x;
                const glm::ivec2 sample = p.origin(other) + glm::ivec2(entry.pixel % 16, entry.pixel / 16);
                if (p.in_window(sample.x, sample.y)) continue;
                // A guard tile is as dense as the tile it guards, unless that is hidden.
                const glm::ivec2 inner = glm::clamp(glm::ivec2(other % plan.tiles_x, other / plan.tiles_x),
                                                    glm::ivec2(1), glm::ivec2(plan.tiles_x - 2, plan.tiles_y - 2));
                const int inner_count = p.count(inner.y * plan.tiles_x + inner.x);
                if (entry.rank >= inner_count) continue;
                ASSERT_LT(entry.rank, p.count(other));
                const int k = plan.level[other] == kFullLevel ? entry.pixel : entry.rank;
                ASSERT_TRUE(p.traced[plan.offset[other] + k]) << sample.x << ", " << sample.y;
                needed[plan.offset[other] + k] = 1;
            }
        }
    }
    int outside = 0;
    int superfluous = 0;
    for (const std::uint32_t address : plan.trace_order) {
        const SamplePosition at = plan.position[address];
        if (p.in_window(at.x_px, at.y_px)) continue;
        ++outside;
        superfluous += needed[address] == 0 ? 1 : 0;
    }
    // Bounding boxes overestimate, and a hidden inner tile's guard may serve the tiles beside it.
    EXPECT_LE(superfluous, 16 + outside / 2);
}

class RandomPlan : public testing::TestWithParam<unsigned> {};

TEST_P(RandomPlan, KeepsItsContract) {
    Chance chance(kSeed + GetParam());
    const auto tables = shared_tables();
    const Display display = chance.display();
    const Eye eye = chance.whole(0, 1) == 0 ? kLeftEye : kRightEye;
    TileSampler sampler(display, eye, chance.law(), tables);
    SamplePlan plan;
    // What another sampler may have left.
    plan.place.resize(5);
    plan.spacing.assign(5, 3.0F);
    plan.grids.log_polar.count = {3, 4};
    for (int frame = 0; frame < 3; ++frame) {
        const PlanRequest request = chance.request();
        sampler.plan(request, plan);
        const Planned planned(display, eye, plan);
        EXPECT_EQ(plan.phase_px, request.phase_px);
        ASSERT_NE(plan.hidden, nullptr);
        EXPECT_EQ(*plan.hidden, planned.hidden);
        EXPECT_FALSE(plan.has_mesh() || plan.has_grids());
        EXPECT_TRUE(plan.place.empty() && plan.spacing.empty());
        expect_grid_covers_the_window(planned);
        if (HasFatalFailure()) return;
        expect_addresses_hold_the_samples_of_their_tile(planned, tables->rank_tile());
        expect_each_address_once(planned);
        expect_visible_samples_traced_and_hidden_ones_not(planned, tables->rank_tile());
        expect_the_messages_rule_agrees(planned, tables->rank_tile());
        expect_levels_where_something_is_visible(planned);
        expect_guard_samples(planned, *tables);
        if (HasFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPlan, testing::Range(0U, 60U));

TEST(TileSampler, KeepsItsContractOnTheBuiltInDisplays) {
    Chance chance(kSeed);
    const auto tables = shared_tables();
    for (const char* name : {"desktop", "vive"}) {
        const Display display = load_display(name).value();
        TileSampler sampler(display, kRightEye, law_for_share(display, kRightEye, 0.27), tables);
        SamplePlan plan;
        sampler.plan(chance.request(), plan);
        const Planned planned(display, kRightEye, plan);
        expect_grid_covers_the_window(planned);
        expect_addresses_hold_the_samples_of_their_tile(planned, tables->rank_tile());
        expect_each_address_once(planned);
        expect_visible_samples_traced_and_hidden_ones_not(planned, tables->rank_tile());
        expect_guard_samples(planned, *tables);
    }
}

}  // namespace
}  // namespace macula
