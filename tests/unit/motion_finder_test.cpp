#include "server/service/motion_finder.h"

#include <cmath>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "protocol/message/byte_map.h"
#include "protocol/message/limits.h"

namespace macula {
namespace {

constexpr int kWidth_px = 128;
constexpr int kHeight_px = 96;
constexpr int kColumns = kWidth_px / 4;
constexpr int kRows = kHeight_px / 4;

/// Instances on nodes as given (-1: still); every node slides along X at its own speed, and node 1 turns, too.
std::shared_ptr<const Scene> animated_scene(const std::vector<int>& node_of_instance, int nodes) {
    Scene scene;
    for (const int node : node_of_instance) {
        Instance instance;
        instance.node = node;
        scene.instances.push_back(instance);
    }
    scene.animation.duration_s = 10.0F;
    for (int node = 0; node < nodes; ++node) {
        scene.animation.nodes.emplace_back();
        AnimationChannel slide;
        slide.node = node;
        slide.time_s = {0.0F, 10.0F};
        slide.value = {glm::vec4(0.0F), glm::vec4(10.0F * static_cast<float>(1 + node), 0.0F, 0.0F, 0.0F)};
        slide.period_s = 10.0F;
        scene.animation.channels.push_back(slide);
    }
    if (nodes > 1) {
        AnimationChannel turn;
        turn.node = 1;
        turn.path = AnimationPath::rotation;
        turn.time_s = {0.0F, 1.0F};
        turn.value = {glm::vec4(0.0F, 0.0F, 0.0F, 1.0F), glm::vec4(0.0F, 0.0F, std::sin(0.5F), std::cos(0.5F))};
        turn.period_s = 10.0F;
        scene.animation.channels.push_back(turn);
    }
    return std::make_shared<const Scene>(std::move(scene));
}

/// What a pixel of an eye sees: object id and inverse depth.
struct Truth {
    std::uint32_t object;
    float inverse_depth;
};

/// Samples at a random pixel of each cell, one eye alike the other, and a picture of their depth as if all pixels were
/// traced.
struct Traced {
    PerEye<SamplePlan> plans;
    PerEye<Samples> samples;
    InverseDepthImage inverse_depth{2 * kWidth_px, kHeight_px};
    std::vector<std::uint8_t> sampled;  ///< by pixel

    /// Cells are squares of this edge; a ring of guard samples around the picture sees object 1.
    template <class See>
    Traced(int cell_px, std::mt19937& random, See&& see) : sampled(kWidth_px * kHeight_px) {
        SamplePlan& plan = plans[0];
        const auto add = [&](int x, int y, const Truth& truth) {
            plan.trace_order.push_back(static_cast<std::uint32_t>(plan.position.size()));
            plan.position.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
            samples[0].object_id.push_back(truth.object);
            samples[0].inverse_depth_per_m.push_back(truth.inverse_depth);
        };
        for (int y = 0; y < kHeight_px; ++y) {
            for (int x = 0; x < kWidth_px; ++x) {
                const Truth truth = see(x, y);
                inverse_depth.at(x, y) = inverse_depth.at(x + kWidth_px, y) = truth.inverse_depth;
            }
        }
        const auto offset = [&] { return static_cast<int>(random() % static_cast<unsigned>(cell_px)); };
        for (int cell_y = 0; cell_y < kHeight_px; cell_y += cell_px) {
            for (int cell_x = 0; cell_x < kWidth_px; cell_x += cell_px) {
                const int x = cell_x + offset();
                const int y = cell_y + offset();
                sampled[static_cast<std::size_t>(y * kWidth_px + x)] = 1;
                add(x, y, see(x, y));
            }
        }
        for (int x = -16; x < kWidth_px + 16; x += 3) {
            add(x, -5, {1, 1.0F});
            add(x, kHeight_px + 5, {1, 1.0F});
        }
        for (int y = -16; y < kHeight_px + 16; y += 3) {
            add(-5, y, {1, 1.0F});
            add(kWidth_px + 5, y, {1, 1.0F});
        }
        plans[1] = plans[0];
        samples[1] = samples[0];
    }
};

std::vector<std::uint8_t> map_of(const Frame& frame) {
    auto map = unpack_map(frame.moving_map, std::size_t{2} * kColumns * kRows);
    EXPECT_TRUE(map) << map.error().message;
    return map ? *map : std::vector<std::uint8_t>(std::size_t{2} * kColumns * kRows);
}

/// A disc of object 2 before a wall of object 3, and a post of object 4 before both.
Truth disc_and_post(int x, int y) {
    if (x >= 60 && x < 70) return {4, 1.0F};
    const int dx = x - 64;
    const int dy = y - 48;
    return dx * dx + dy * dy < 30 * 30 ? Truth{2, 0.5F} : Truth{3, 0.25F};
}

TEST(MotionFinder, AStillSceneHasNothingToFind) {
    std::mt19937 random(1);
    const Traced traced(2, random, disc_and_post);
    auto still = std::make_shared<Scene>();
    still->instances.resize(4);
    MotionFinder finder(still);
    EXPECT_FALSE(finder.anything_moves());
    Frame frame;
    finder.find(1.0, traced.plans, traced.samples, traced.inverse_depth, frame);
    EXPECT_TRUE(frame.moving.empty());
    EXPECT_TRUE(frame.moving_map.empty());
}

TEST(MotionFinder, WhatMovesOutOfSightIsNotSent) {
    std::mt19937 random(1);
    const Traced traced(2, random, [](int, int) { return Truth{3, 0.25F}; });
    MotionFinder finder(animated_scene({-1, 0, -1, 1}, 2));
    EXPECT_TRUE(finder.anything_moves());
    Frame frame;
    frame.moving.resize(3);  // of a frame before
    finder.find(1.0, traced.plans, traced.samples, traced.inverse_depth, frame);
    EXPECT_TRUE(frame.moving.empty());
    EXPECT_TRUE(frame.moving_map.empty());
}

TEST(MotionFinder, PlacesAndVelocitiesAreTheAnimations) {
    std::mt19937 random(1);
    const Traced traced(2, random, disc_and_post);
    MotionFinder finder(animated_scene({-1, 1, -1, 0}, 2));
    Frame frame;
    finder.find(0.7, traced.plans, traced.samples, traced.inverse_depth, frame);
    ASSERT_EQ(frame.moving.size(), 2U);
    // The disc, on node 1, has more samples than the post, on node 0.
    const MovingObject& disc = frame.moving[0];
    const MovingObject& post = frame.moving[1];
    EXPECT_EQ(disc.id, 2U);
    EXPECT_EQ(post.id, 1U);
    EXPECT_NEAR(post.world_from_object[3].x, 0.7F, 1e-5F);
    EXPECT_NEAR(post.velocity_per_s[3].x, 1.0F, 1e-3F);
    EXPECT_NEAR(disc.world_from_object[3].x, 1.4F, 1e-5F);
    EXPECT_NEAR(disc.velocity_per_s[3].x, 2.0F, 1e-3F);
    // It turns about Z by 1 rad/s.
    EXPECT_NEAR(disc.world_from_object[0].x, std::cos(0.7F), 1e-5F);
    EXPECT_NEAR(disc.world_from_object[0].y, std::sin(0.7F), 1e-5F);
    EXPECT_NEAR(disc.velocity_per_s[0].x, -std::sin(0.7F), 1e-3F);
    EXPECT_NEAR(disc.velocity_per_s[0].y, std::cos(0.7F), 1e-3F);
    // Each side of the moment at which the animation begins anew is no velocity for the other.
    for (const double time_s : {9.9999, 10.0001}) {
        finder.find(time_s, traced.plans, traced.samples, traced.inverse_depth, frame);
        EXPECT_NEAR(frame.moving[1].velocity_per_s[3].x, 1.0F, 1e-2F) << time_s;
    }
}

TEST(MotionFinder, TheMapFollowsTheNearestSample) {
    const char* chosen = std::getenv("MACULA_SEED");
    const auto seed =
        chosen != nullptr ? static_cast<unsigned>(std::strtoul(chosen, nullptr, 10)) : std::random_device{}();
    SCOPED_TRACE("MACULA_SEED=" + std::to_string(seed));
    std::mt19937 random(seed);
    for (const int cell_px : {1, 2, 4, 8}) {  // 8: the sparsest tiles
        const Traced traced(cell_px, random, disc_and_post);
        MotionFinder finder(animated_scene({0, 1, -1, -1}, 2));
        Frame frame;
        finder.find(0.7, traced.plans, traced.samples, traced.inverse_depth, frame);
        const std::vector<std::uint8_t> map = map_of(frame);
        int slot_of_disc = 0;
        for (std::size_t i = 0; i < frame.moving.size(); ++i) {
            if (frame.moving[i].id == 2) slot_of_disc = static_cast<int>(i) + 1;
        }
        ASSERT_GT(slot_of_disc, 0);
        int wrong = 0;
        for (int row = 0; row < kRows; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                Truth nearest{0, -1.0F};
                bool sampled = false;
                bool seen_disc = false;
                bool seen_other = false;
                for (int y = 4 * row; y < 4 * row + 4; ++y) {
                    for (int x = 4 * column; x < 4 * column + 4; ++x) {
                        const bool counts = traced.sampled[static_cast<std::size_t>(y * kWidth_px + x)] != 0;
                        sampled = sampled || counts;
                        const Truth truth = disc_and_post(x, y);
                        (truth.object == 2 ? seen_disc : seen_other) = true;
                        if (counts && truth.inverse_depth > nearest.inverse_depth) nearest = truth;
                    }
                }
                const int left = map[static_cast<std::size_t>(row * 2 * kColumns + column)];
                const int right = map[static_cast<std::size_t>((row * 2 + 1) * kColumns + column)];
                ASSERT_EQ(left, right) << column << " " << row;
                if (sampled) {
                    ASSERT_EQ(left, nearest.object == 2 ? slot_of_disc : 0) << column << " " << row;
                } else if (!(left == slot_of_disc ? seen_disc : seen_other)) {
                    ++wrong;
                }
            }
        }
        // Between samples the depth tells which surface it is, unless no sample of that surface is near.
        EXPECT_LE(wrong, kColumns * kRows / 25) << "cells of " << cell_px;
    }
}

TEST(MotionFinder, ListsThoseWithTheMostSamplesAndCallsTheRestStill) {
    std::mt19937 random(1);
    const int objects = 300;
    const Traced traced(1, random, [](int x, int y) {
        // Object i covers a strip of rows; later ones are seen in fewer pixels.
        const int index = (y * kWidth_px + x) * objects / (kWidth_px * kHeight_px);
        const bool covered = (x + y) % 300 >= index / 2;
        return Truth{covered ? static_cast<std::uint32_t>(index + 1) : 0U, covered ? 0.5F : 0.0F};
    });
    std::vector<int> nodes;
    for (int i = 0; i < objects; ++i) nodes.push_back(i);
    MotionFinder finder(animated_scene(nodes, objects));
    Frame frame;
    finder.find(0.5, traced.plans, traced.samples, traced.inverse_depth, frame);
    ASSERT_EQ(frame.moving.size(), kMaxMovingObjects);
    std::vector<int> count(objects + 1);
    for (const std::uint32_t object : traced.samples[0].object_id) ++count[object];
    for (std::size_t i = 1; i < frame.moving.size(); ++i) {
        EXPECT_GE(count[frame.moving[i - 1].id], count[frame.moving[i].id]);
    }
    for (const std::uint8_t slot : map_of(frame)) ASSERT_LE(slot, kMaxMovingObjects);
}

TEST(MotionFinder, WhatNoClientWouldAcceptCountsAsStill) {
    std::mt19937 random(1);
    const Traced traced(2, random, disc_and_post);
    Scene scene = *animated_scene({-1, 0, -1, 1}, 2);
    scene.animation.channels[0].value[1].x = 2e7F;
    MotionFinder finder(std::make_shared<const Scene>(std::move(scene)));
    Frame frame;
    finder.find(9.0, traced.plans, traced.samples, traced.inverse_depth, frame);
    ASSERT_EQ(frame.moving.size(), 1U);
    EXPECT_EQ(frame.moving[0].id, 2U);
}

}  // namespace
}  // namespace macula
