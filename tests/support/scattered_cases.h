#pragma once

#include <array>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "masks/mesh/mesh_table.h"
#include "server/render/scattered_reconstructors.h"
#include "tests/support/reconstruct_cases.h"

namespace macula::test {

inline constexpr std::array kScattered = {Reconstruction::push_pull, Reconstruction::cells, Reconstruction::nearest};

/// Hides the pixels of the window for which `hidden(x, y)` holds.
template <class Hidden>
void hide(SamplePlan& plan, Hidden&& hidden) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < plan.height_px; ++y)
        for (int x = 0; x < plan.width_px; ++x) pixels.push_back(hidden(x, y) ? 1 : 0);
    plan.hidden = std::make_shared<const std::vector<std::uint8_t>>(std::move(pixels));
}

inline bool is_hidden(const SamplePlan& plan, int x, int y) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(plan.width_px) + static_cast<std::size_t>(x);
    return plan.hidden && (*plan.hidden)[pixel] != 0;
}

/// A mesh plan of scattered sites, in the window and around it, as far as kMeshReach_px; `share` of the pixels.
inline Case mesh_case(std::uint32_t seed, glm::ivec2 size, double share) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Case result;
    SamplePlan& plan = result.plan;
    plan.width_px = size.x;
    plan.height_px = size.y;
    const auto reach = static_cast<std::int16_t>(kMeshReach_px);
    plan.position = {{static_cast<std::int16_t>(-reach), static_cast<std::int16_t>(-reach)},
                     {static_cast<std::int16_t>(size.x + reach - 1), static_cast<std::int16_t>(size.y + reach - 1)}};
    for (int y = -20; y < size.y + 20; ++y)
        for (int x = -20; x < size.x + 20; ++x)
            if (uniform(random) < share)
                plan.position.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
    const std::size_t count = plan.position.size();
    for (std::size_t i = 0; i < count; ++i)
        (uniform(random) < 0.05 ? plan.untraced : plan.trace_order).push_back(static_cast<std::uint32_t>(i));
    // Which triangles there are is of no interest here, only that there are some.
    SampleMesh mesh;
    mesh.width_px = mesh.height_px = 2;
    mesh.site = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    mesh.triangle = {{0, 2, 1}, {1, 2, 3}};
    plan.mesh = std::make_shared<const MeshTable>(MeshTable::make(std::move(mesh)).value());
    result.samples = sample_picture(
        plan, [&](int, int) { return static_cast<Rgba8>(random()) | 0xFF000000U; },
        [&](int, int) { return uniform(random) < 0.1 ? 0.0F : static_cast<float>(0.5 + 0.2 * uniform(random)); });
    return result;
}

}  // namespace macula::test
