#include "server/service/pacing.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>
#include <utility>

namespace macula {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TEST(Phase, IsACycleOf64DifferentShiftsThatFillTheTorus) {
    std::set<std::pair<int, int>> shifts;
    std::set<std::pair<int, int>> quarters;
    for (std::uint64_t frame = 0; frame < 64; ++frame) {
        const glm::ivec2 phase = phase_of_frame(frame);
        EXPECT_GE(phase.x, 0);
        EXPECT_LT(phase.x, 64);
        EXPECT_GE(phase.y, 0);
        EXPECT_LT(phase.y, 64);
        EXPECT_EQ(phase, phase_of_frame(frame + 64));
        shifts.insert({phase.x, phase.y});
        quarters.insert({phase.x / 16, phase.y / 16});
    }
    EXPECT_EQ(shifts.size(), 64U);
    EXPECT_EQ(quarters.size(), 16U);
}

/// A frame's way through the server.
void pass(PacingState& state, std::int64_t now_ns) {
    state.begin(now_ns);
    state.rendered();
    state.taken();
    state.encoded();
}

TEST(Pacing, KeepsTheRefreshRate) {
    PacingState state(100.0, 3);
    EXPECT_LE(state.next_begin_ns(), 0);
    state.begin(500 * kMs);
    EXPECT_EQ(state.next_begin_ns(), 510 * kMs);
    state.begin(512 * kMs);  // a little late: the cadence stays
    EXPECT_EQ(state.next_begin_ns(), 520 * kMs);
    state.begin(900 * kMs);  // after a pause: no burst to catch up
    EXPECT_EQ(state.next_begin_ns(), 910 * kMs);
}

TEST(Pacing, ASlowClientGetsFewerFrames) {
    PacingState state(100.0, 2);
    EXPECT_TRUE(state.has_room());
    pass(state, 0);
    EXPECT_TRUE(state.has_room());
    pass(state, 10 * kMs);
    EXPECT_EQ(state.in_flight(), 2);
    EXPECT_FALSE(state.has_room());
    state.reported(1);
    EXPECT_TRUE(state.has_room());
    pass(state, 20 * kMs);
    EXPECT_FALSE(state.has_room());
    state.reported(3);  // speaks for frame 2 as well
    EXPECT_EQ(state.in_flight(), 0);
    state.reported(2);  // late
    EXPECT_EQ(state.in_flight(), 0);
}

TEST(Pacing, ReportsOfFramesThatWereNeverSentMakeNoRoom) {
    PacingState state(100.0, 1);
    state.begin(0);
    state.reported(1'000);
    EXPECT_EQ(state.in_flight(), 1);
    state.rendered();
    state.taken();
    EXPECT_EQ(state.encoded(), 1U);
    EXPECT_FALSE(state.has_room());
    state.reported(1'000);
    EXPECT_EQ(state.in_flight(), 0);
    pass(state, 10 * kMs);
    EXPECT_FALSE(state.has_room());
}

TEST(Pacing, RendersNothingInVain) {
    PacingState state(100.0, 5);
    state.begin(0);
    EXPECT_TRUE(state.has_room());
    state.rendered();
    EXPECT_FALSE(state.has_room());  // one waits for the encoder
    state.taken();
    EXPECT_TRUE(state.has_room());
}

TEST(Pacing, FramesInTheServerAreNotGivenUp) {
    PacingState state(100.0, 2);
    pass(state, 0);
    state.begin(10 * kMs);
    state.give_up_reports();
    EXPECT_EQ(state.in_flight(), 2);
    state.rendered();
    state.taken();
    state.encoded();
    state.give_up_reports();
    EXPECT_EQ(state.in_flight(), 0);
    state.reported(1);  // late
    EXPECT_EQ(state.in_flight(), 0);
}

TEST(Pacer, WakesWhenRoomComesAndWhenClosed) {
    Pacer pacer(1000.0, 1);
    ASSERT_TRUE(pacer.wait_for_room());
    pacer.update([](PacingState& state) { pass(state, 0); });
    {
        const std::jthread client([&pacer] { pacer.update([](PacingState& state) { state.reported(1); }); });
        EXPECT_TRUE(pacer.wait_for_room());
    }
    pacer.update([](PacingState& state) { pass(state, 0); });
    const std::jthread closer([&pacer] { pacer.close(); });
    EXPECT_FALSE(pacer.wait_for_room());
}

}  // namespace
}  // namespace macula
