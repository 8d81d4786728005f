#include "masks/level_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace macula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// The same quantisation, written the slow way.
int nearest_level(double need) {
    int nearest = 1;
    for (int level = 2; level <= kFullLevel; ++level) {
        const auto distance = [need](int l) { return std::abs(std::log(kLevelCounts[l] / 256.0 / need)); };
        if (distance(level) < distance(nearest)) nearest = level;
    }
    return nearest;
}

TEST(LevelMap, IsTheNearestLevelInLogOfTheNeedAtTheTilesCentre) {
    const auto seed = std::random_device{}();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Display vive = load_display("vive").value();
    const Tangents& edge = vive.eyes[kLeftEye].tangents;
    for (int round = 0; round < 24; ++round) {
        AcuityLaw law;
        law.model = named_laws()[static_cast<std::size_t>(round) % named_laws().size()].model;
        law.stretch = std::exp(1.0 + uniform(random));
        law.exponent = 1.5 + 0.5 * uniform(random);
        law.full_acuity_deg = round / 6 % 2 == 0 ? 0.0 : 1.5;
        const glm::dvec3 gaze =
            glm::normalize(glm::dvec3(uniform(random), uniform(random), round < 15 ? -1.0 : uniform(random)));
        const glm::ivec2 phase(static_cast<int>(random() % 64), static_cast<int>(random() % 64));
        const TileGrid grid({1512, 1680}, phase);
        std::vector<std::uint8_t> levels(static_cast<std::size_t>(grid.tiles.x) * grid.tiles.y);
        LevelMap(vive, kLeftEye, law).update(grid, glm::vec3(gaze), levels.data(), grid.tiles.x);
        for (int y = 0; y < grid.tiles.y; ++y) {
            for (int x = 0; x < grid.tiles.x; ++x) {
                const glm::dvec2 centre = glm::dvec2(grid.origin_px) + 16.0 * glm::dvec2(x, y) + 8.0;
                const glm::dvec2 tangent(edge.left + centre.x / 1512 * (double{edge.right} - edge.left),
                                         edge.top - centre.y / 1680 * (double{edge.top} - edge.bottom));
                const glm::dvec3 direction = glm::normalize(glm::dvec3(tangent, -1.0));
                const double angle = std::acos(glm::clamp(glm::dot(direction, gaze), -1.0, 1.0)) / kDegree;
                const int level = levels[y * grid.tiles.x + x];
                const double ppd = pixels_per_degree(vive, kLeftEye, tangent.x, tangent.y);
                // On a boundary single precision may choose either side. Near the end of sight castleCSF falls faster
                // than a table of 1/4 degree follows, which keeps between its entries.
                const bool steep = std::holds_alternative<CastleCsf>(law.model);
                const double step_deg = steep ? 0.25 * law.stretch : 0.0;
                const double least = 0.999 * needed_share(law, angle + step_deg, ppd);
                const double most = 1.001 * needed_share(law, angle - step_deg, ppd);
                ASSERT_GE(level, nearest_level(least)) << "need " << least << ", seed " << seed;
                ASSERT_LE(level, nearest_level(most)) << "need " << most << ", seed " << seed;
            }
        }
    }
}

TEST(LevelMap, WithItsStretchChangedIsThatOfTheLaw) {
    const Display vive = load_display("vive").value();
    const TileGrid grid({1512, 1680}, {3, 9});
    const auto levels_of = [&](LevelMap& map) {
        std::vector<std::uint8_t> levels(static_cast<std::size_t>(grid.tiles.x) * grid.tiles.y);
        map.update(grid, {0.0F, 0.0F, -1.0F}, levels.data(), grid.tiles.x);
        return levels;
    };
    for (const NamedLaw& named : named_laws()) {
        AcuityLaw law;
        law.model = named.model;
        law.full_acuity_deg = 1.0;
        LevelMap changed(vive, kLeftEye, law);
        const auto before = levels_of(changed);
        law.stretch = 4.0;
        changed.set_stretch(4.0);
        LevelMap made(vive, kLeftEye, law);
        EXPECT_EQ(levels_of(changed), levels_of(made)) << named.name;
        EXPECT_NE(levels_of(changed), before) << named.name;
    }
}

}  // namespace
}  // namespace macula
