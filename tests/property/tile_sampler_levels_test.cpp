#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "masks/tile_sampler.h"
#include "tests/support/law_for_share.h"

namespace macula {
namespace {

std::shared_ptr<const TileTables> shared_tables() {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    return kTables;
}

SamplePlan plan_once(TileSampler& sampler, const PlanRequest& request = {}) {
    SamplePlan plan;
    sampler.plan(request, plan);
    return plan;
}

/// A gaze that drifts in pursuit and jumps now and then, with the phases of a temporal cycle if wished.
std::vector<PlanRequest> gaze_path(unsigned seed, int frames, bool change_phase) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    glm::vec3 gaze(0.0F, 0.0F, -1.0F);
    std::vector<PlanRequest> path;
    for (int i = 0; i < frames; ++i) {
        if (i % 10 == 9) gaze = {uniform(random), uniform(random), -1.0F};
        gaze.x += 0.003F;
        const glm::ivec2 phase(static_cast<int>(random() % 64), static_cast<int>(random() % 64));
        path.push_back({glm::normalize(gaze), change_phase ? phase : glm::ivec2(0)});
    }
    return path;
}

/// What the law needs at the centre of a tile of the plan.
double need_at(const Display& display, Eye eye, const AcuityLaw& law, const SamplePlan& plan, int tile,
               const glm::vec3& gaze_eye) {
    const Tangents& edge = display.eyes[eye].tangents;
    const glm::dvec2 centre =
        glm::dvec2(plan.origin_px) + 16.0 * glm::dvec2(tile % plan.tiles_x, tile / plan.tiles_x) + 8.0;
    const glm::dvec2 tangent(edge.left + centre.x / plan.width_px * (double{edge.right} - edge.left),
                             edge.top - centre.y / plan.height_px * (double{edge.top} - edge.bottom));
    const double cosine = glm::dot(glm::normalize(glm::dvec3(tangent, -1.0)), glm::dvec3(gaze_eye));
    const double angle_deg = std::acos(glm::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
    return needed_share(law, angle_deg, pixels_per_degree(display, eye, tangent.x, tangent.y));
}

/// Calls visit(tile, level) for the inner tiles that are not hidden.
template <class Visit>
void for_each_inner_tile(const SamplePlan& plan, Visit visit) {
    for (int y = 1; y < plan.tiles_y - 1; ++y) {
        for (int x = 1; x < plan.tiles_x - 1; ++x) {
            const int tile = y * plan.tiles_x + x;
            if (plan.level[tile] > 0) visit(tile, plan.level[tile]);
        }
    }
}

double boundary(int level) {
    return std::sqrt(1.0 * kLevelCounts[level] * kLevelCounts[level + 1]) / kTileArea_px;
}

TEST(TileSamplerLevels, MeetTheNeedWithinHalfAStepAndExceedItByTheHysteresisAtMost) {
    const Display display = load_display("desktop").value();
    const AcuityLaw law = law_for_share(display, kLeftEye, 0.27);
    constexpr double kRounding = 1e-3;
    for (const bool change_phase : {false, true}) {
        TileSampler sampler(display, kLeftEye, law, shared_tables(), {.hysteresis = 0.8F});
        for (const PlanRequest& request : gaze_path(1, 40, change_phase)) {
            const SamplePlan plan = plan_once(sampler, request);
            for_each_inner_tile(plan, [&](int tile, int level) {
                const double need = need_at(display, kLeftEye, law, plan, tile, request.gaze_eye);
                ASSERT_TRUE(level == kFullLevel || need <= boundary(level) * (1.0 + kRounding));
                ASSERT_TRUE(level == 1 || need >= 0.8 * boundary(level - 1) * (1.0 - kRounding));
            });
            if (HasFailure()) return;
        }
    }
}

TEST(TileSamplerLevels, WithHysteresisAreNeverSparserThanWithout) {
    const Display display = load_display("desktop").value();
    const AcuityLaw law = law_for_share(display, kRightEye, 0.41);
    TileSampler held(display, kRightEye, law, shared_tables(), {.hysteresis = 0.8F});
    TileSampler free(display, kRightEye, law, shared_tables(), {.hysteresis = 1.0F});
    for (const PlanRequest& request : gaze_path(2, 40, true)) {
        const SamplePlan with = plan_once(held, request);
        const SamplePlan without = plan_once(free, request);
        for_each_inner_tile(with, [&](int tile, int level) { ASSERT_GE(level, without.level[tile]); });
        if (HasFailure()) return;
    }
}

TEST(TileSamplerLevels, HoldStillWhileAFixatingGazeTrembles) {
    const Display display = load_display("desktop").value();
    const AcuityLaw law = law_for_share(display, kLeftEye, 0.27);
    const auto changes = [&](float hysteresis) {
        TileSampler sampler(display, kLeftEye, law, shared_tables(), {.hysteresis = hysteresis});
        std::mt19937 random(3);
        std::normal_distribution<float> noise(0.0F, 0.0014F);  // .08 degrees, as eye trackers have
        SamplePlan before;
        int total = 0;
        for (int frame = 0; frame < 60; ++frame) {
            const glm::vec3 gaze(0.1F + noise(random), noise(random), -1.0F);
            SamplePlan plan = plan_once(sampler, {glm::normalize(gaze), glm::ivec2(0)});
            for_each_inner_tile(plan, [&](int tile, int level) {
                total += !before.level.empty() && before.level[tile] != level ? 1 : 0;
            });
            before = std::move(plan);
        }
        return total;
    };
    EXPECT_GT(changes(1.0F), 100);
    EXPECT_LT(changes(0.8F), 0.1 * changes(1.0F));
}

/// Times that each pixel of the window is traced.
std::vector<std::uint8_t> pixels_of(const SamplePlan& plan) {
    std::vector<std::uint8_t> times(static_cast<std::size_t>(plan.width_px) * plan.height_px);
    for (const std::uint32_t address : plan.trace_order) {
        const SamplePosition at = plan.position[address];
        if (at.x_px >= 0 && at.y_px >= 0 && at.x_px < plan.width_px && at.y_px < plan.height_px)
            ++times[at.y_px * plan.width_px + at.x_px];
    }
    return times;
}

TEST(TileSamplerLevels, AreNested) {
    const Display display = load_display("desktop").value();
    const PlanRequest request{glm::normalize(glm::vec3(0.3F, -0.4F, -1.0F)), {5, 38}};
    std::vector<std::uint8_t> sparser(static_cast<std::size_t>(display.eye_width_px) * display.eye_height_px);
    for (const double share : {0.18, 0.27, 0.41, 0.54}) {
        TileSampler sampler(display, kLeftEye, law_for_share(display, kLeftEye, share), shared_tables());
        std::vector<std::uint8_t> pixels = pixels_of(plan_once(sampler, request));
        EXPECT_GT(std::count(pixels.begin(), pixels.end(), 1), std::count(sparser.begin(), sparser.end(), 1));
        EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), sparser.begin(), std::greater_equal<>())) << share;
        sparser = std::move(pixels);
    }
}

TEST(TileSamplerLevels, WithoutALawEveryVisiblePixelIsTracedOnceAndNothingElse) {
    const Display display = load_display("desktop").value();
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, kLeftEye);
    const auto visible = static_cast<std::size_t>(std::count(hidden.begin(), hidden.end(), 0));
    TileSampler sampler(display, kLeftEye, std::nullopt, shared_tables());
    for (const PlanRequest& request : gaze_path(4, 3, true)) {
        const SamplePlan plan = plan_once(sampler, request);
        EXPECT_EQ(plan.trace_order.size(), visible);
        EXPECT_EQ(plan.traced_in_window, visible);
        const std::vector<std::uint8_t> pixels = pixels_of(plan);
        EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), hidden.begin(),
                               [](int times, int is_hidden) { return times == 1 - is_hidden; }));
    }
}

TEST(TileSamplerLevels, StayWithinABudget) {
    const Display display = load_display("desktop").value();
    const AcuityLaw law = law_for_share(display, kLeftEye, 0.54);
    const auto pixels = static_cast<double>(display.eye_width_px) * display.eye_height_px;
    for (const double share : {0.5, 0.3, 0.1, 0.03}) {
        const auto most = static_cast<std::uint32_t>(share * pixels);
        TileSampler sampler(display, kLeftEye, law, shared_tables(), {.max_samples = most});
        for (const PlanRequest& request : gaze_path(5, 12, true)) {
            const SamplePlan plan = plan_once(sampler, request);
            EXPECT_LE(plan.traced_in_window, most);
            EXPECT_GE(plan.traced_in_window, most * 2 / 3) << "far below what the budget allows";
        }
    }
}

TEST(TileSamplerLevels, UnderABudgetThatCannotBeMetAreTheSparsest) {
    const Display display = load_display("desktop").value();
    TileSampler sampler(display, kLeftEye, law_for_share(display, kLeftEye, 0.54), shared_tables(), {.max_samples = 1});
    const SamplePlan plan = plan_once(sampler);
    int denser = 0;
    for_each_inner_tile(plan, [&](int, int level) { denser += level > 1 ? 1 : 0; });
    EXPECT_LE(denser, 4);  // the tiles that the gaze is on
}

TEST(TileSamplerLevels, GuardSamplesAreFew) {
    const Display display = load_display("vive").value();
    for (const double share : {0.54, 0.27, 0.116}) {
        TileSampler sampler(display, kLeftEye, law_for_share(display, kLeftEye, share), shared_tables());
        const SamplePlan plan = plan_once(sampler, {{0.0F, 0.0F, -1.0F}, {21, 40}});
        const double outside = static_cast<double>(plan.trace_order.size()) - plan.traced_in_window;
        EXPECT_GT(outside, 100.0);
        EXPECT_LT(outside, 0.001 * plan.width_px * plan.height_px);
    }
}

/// Mean number of tiles that sixteen consecutive rays go through, and the mean angle that they span.
std::pair<double, double> packet_spread_deg(const Display& display, Eye eye, const SamplePlan& plan) {
    const Tangents& edge = display.eyes[eye].tangents;
    const auto direction = [&](const glm::dvec2& pixel) {
        return glm::normalize(glm::dvec3(edge.left + pixel.x / plan.width_px * (double{edge.right} - edge.left),
                                         edge.top - pixel.y / plan.height_px * (double{edge.top} - edge.bottom), -1.0));
    };
    double tiles = 0.0;
    double angle_rad = 0.0;
    int packets = 0;
    for (std::size_t first = 0; first + 16 <= plan.trace_order.size(); first += 16, ++packets) {
        std::array<int, 16> touched{};
        glm::ivec2 low(1 << 20);
        glm::ivec2 high(-(1 << 20));
        for (std::size_t i = first; i < first + 16; ++i) {
            const SamplePosition at = plan.position[plan.trace_order[i]];
            const glm::ivec2 pixel(at.x_px, at.y_px);
            const glm::ivec2 tile = (pixel - plan.origin_px) / kTileEdge_px;
            touched[i - first] = tile.y * plan.tiles_x + tile.x;
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
        std::sort(touched.begin(), touched.end());
        tiles += static_cast<double>(std::unique(touched.begin(), touched.end()) - touched.begin());
        angle_rad += std::acos(std::min(1.0, glm::dot(direction(low), direction(high))));
    }
    return {tiles / packets, angle_rad / packets * 180.0 / std::numbers::pi};
}

TEST(TileSamplerLevels, PacketsOfTheTraceOrderAreCoherent) {
    Display display = load_display("vive").value();
    const auto expect_spread = [&](std::optional<AcuityLaw> law, double most_tiles, double most_deg) {
        TileSampler sampler(display, kLeftEye, law, shared_tables());
        const auto [tiles, angle_deg] = packet_spread_deg(display, kLeftEye, plan_once(sampler));
        EXPECT_LE(tiles, most_tiles);
        EXPECT_LE(angle_deg, most_deg);
    };
    // Another implementation has 1.11 / 1.20 / 1.51 tiles and .80 / 1.06 / 1.60 degrees over the whole buffer; the
    // same number of sites in scan-line order 2.7 / 4.0 / 5.6 tiles and 3.3 / 6.4 / 12 degrees.
    expect_spread(law_for_share(display, kLeftEye, 0.54), 1.11, 0.80);
    expect_spread(law_for_share(display, kLeftEye, 0.27), 1.20, 1.06);
    expect_spread(law_for_share(display, kLeftEye, 0.116), 1.51, 1.60);
    // Blocks of 4x4 pixels have a diagonal of .43 degrees at the centre, where they are largest. Without the outline
    // none is broken up but at the window's right edge.
    display.eyes[kLeftEye].visible_outline.clear();
    expect_spread(std::nullopt, 1.01, 0.43);
}

}  // namespace
}  // namespace macula
