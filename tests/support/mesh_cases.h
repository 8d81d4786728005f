#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "masks/mesh/mesh_table.h"
#include "masks/mesh/triangulate.h"
#include "tests/support/reconstruct_cases.h"

namespace macula::test {

/// A mesh whose sites are the pixels for which `sampled(x, y)` holds, and the mask's corners.
template <class Sampled>
std::shared_ptr<const MeshTable> make_mesh(glm::ivec2 size_px, Sampled&& sampled) {
    SampleMesh mesh;
    mesh.width_px = size_px.x;
    mesh.height_px = size_px.y;
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            const bool corner = (x == 0 || x == size_px.x - 1) && (y == 0 || y == size_px.y - 1);
            if (corner || sampled(x, y))
                mesh.site.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
        }
    mesh.triangle = triangulate(mesh.site);
    auto table = MeshTable::make(std::move(mesh));
    EXPECT_TRUE(table) << table.error().message;
    return table ? std::make_shared<const MeshTable>(std::move(*table)) : nullptr;
}

/// A mesh plan made from the definition in sample_plan.h, independently of the sampler: sites that visible pixels
/// interpolate are traced, in any order of addresses, with untraced addresses among them.
inline SamplePlan mesh_plan(const std::shared_ptr<const MeshTable>& table, glm::ivec2 origin_px, glm::ivec2 size_px,
                            std::shared_ptr<const std::vector<std::uint8_t>> hidden, std::mt19937& random) {
    SamplePlan plan;
    plan.width_px = size_px.x;
    plan.height_px = size_px.y;
    plan.mesh = table;
    plan.mesh_origin_px = origin_px;
    plan.hidden = std::move(hidden);
    const int mask_width = table->mesh().width_px;
    std::vector<std::uint8_t> needed(table->pixels().size(), 0);
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            if (plan.hidden && (*plan.hidden)[static_cast<std::size_t>(y * size_px.x + x)] != 0) continue;
            const int pixel = (origin_px.y + y) * mask_width + origin_px.x + x;
            const MeshPixel& entry = table->pixels()[static_cast<std::size_t>(pixel)];
            for (const int offset :
                 {entry.ay * mask_width + entry.ax, entry.by * mask_width + entry.bx, entry.cy * mask_width + entry.cx})
                needed[static_cast<std::size_t>(pixel + offset)] = 1;
        }
    std::vector<SamplePosition> places;
    for (const SamplePosition& site : table->mesh().site)
        if (needed[static_cast<std::size_t>(site.y_px * mask_width + site.x_px)] != 0)
            places.push_back({static_cast<std::int16_t>(site.x_px - origin_px.x),
                              static_cast<std::int16_t>(site.y_px - origin_px.y)});
    std::shuffle(places.begin(), places.end(), random);
    for (const SamplePosition& place : places) {
        if (random() % 8 == 0) {
            plan.untraced.push_back(static_cast<std::uint32_t>(plan.position.size()));
            plan.position.push_back({0, 0});
        }
        plan.trace_order.push_back(static_cast<std::uint32_t>(plan.position.size()));
        plan.position.push_back(place);
    }
    return plan;
}

/// The whole mask as the window, all of it visible.
inline SamplePlan whole_mesh_plan(const std::shared_ptr<const MeshTable>& table) {
    std::mt19937 random(1);
    return mesh_plan(table, {0, 0}, {table->mesh().width_px, table->mesh().height_px}, nullptr, random);
}

/// A mesh from a full grid to its four corners alone, with a window of any size that touches any or none of the mask's
/// edges, with pixels hidden or not, and samples of any colours and depths with misses among them.
inline Case random_mesh_case(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto draw = [&random](int first, int last) { return std::uniform_int_distribution(first, last)(random); };
    const glm::ivec2 mask(draw(2, 120), draw(2, 120));
    constexpr std::array kSampledPercent = {100, 54, 27, 8, 2, 0};
    const int percent = kSampledPercent[static_cast<std::size_t>(draw(0, 5))];
    const int full_radius = draw(0, 40);
    const auto table = make_mesh(mask, [&](int x, int y) {
        const glm::ivec2 away = 2 * glm::ivec2(x, y) - mask;
        return away.x * away.x + away.y * away.y < full_radius * full_radius || draw(1, 100) <= percent;
    });
    glm::ivec2 size(draw(1, mask.x), draw(1, mask.y));
    if (draw(0, 4) == 0) size = mask;
    glm::ivec2 origin(0);
    for (int axis = 0; axis < 2; ++axis) {
        const int room = mask[axis] - size[axis];
        const std::array choices = {0, room, draw(0, room)};
        origin[axis] = choices[static_cast<std::size_t>(draw(0, 2))];
    }
    std::shared_ptr<std::vector<std::uint8_t>> hidden;
    if (draw(0, 2) != 0) {
        hidden = std::make_shared<std::vector<std::uint8_t>>();
        const int radius = draw(0, 100);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::ivec2 away = 2 * glm::ivec2(x, y) - size;
                hidden->push_back(away.x * away.x + away.y * away.y > radius * radius ? 1 : 0);
            }
    }
    Case result;
    result.plan = mesh_plan(table, origin, size, hidden, random);
    std::uniform_real_distribution<float> depth(0.01F, 4.0F);
    const int steadiness = draw(0, 3);
    float last_depth = 1.0F;
    result.samples = sample_picture(
        result.plan, [&](int, int) { return static_cast<Rgba8>(random()) | 0xFF000000U; },
        [&](int, int) {
            if (draw(0, 9) == 0) return 0.0F;
            if (draw(0, 3) >= steadiness) last_depth = depth(random);
            return last_depth * (1.0F + 0.1F * depth(random) / 4.0F);
        });
    return result;
}

/// Largest difference of a channel, in code values.
inline int channel_difference(Rgba8 a, Rgba8 b) {
    int largest = 0;
    for (unsigned shift = 0; shift < 32; shift += 8)
        largest =
            std::max(largest, std::abs(static_cast<int>(a >> shift & 255U) - static_cast<int>(b >> shift & 255U)));
    return largest;
}

}  // namespace macula::test
