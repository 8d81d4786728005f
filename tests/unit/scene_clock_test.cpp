#include "server/service/scene_clock.h"

#include <random>

#include <gtest/gtest.h>

namespace macula {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kStart_ns = 123'456'789;
/// Server clock minus client clock.
constexpr std::int64_t kOffset_ns = -987'654'321'012;

/// A Track that was measured at a time of the server's clock, to be shown `ahead_ns` later.
Track track_at(std::int64_t server_ns, std::int64_t ahead_ns) {
    Track track;
    track.pose_time_ns = server_ns - kOffset_ns;
    track.display_time_ns = track.pose_time_ns + ahead_ns;
    return track;
}

double seconds(std::int64_t server_ns) {
    return 1e-9 * static_cast<double>(server_ns - kStart_ns);
}

TEST(SceneClock, FollowsDisplayTimesWithoutTheNetworksJitter) {
    SceneClock clock(kStart_ns);
    std::mt19937 random(1);
    const std::int64_t least_delay_ns = 2 * kMillisecond_ns;
    for (int i = 0; i < 3000; ++i) {
        const std::int64_t measured_ns = kStart_ns + i * 11 * kMillisecond_ns;
        const std::int64_t ahead_ns = (30 + static_cast<int>(random() % 20)) * kMillisecond_ns;
        const bool quick = i % 100 == 0;
        const std::int64_t delay_ns = least_delay_ns + (quick ? 0 : static_cast<int>(random() % 15) * kMillisecond_ns);
        const double time_s = clock.display_time_s(track_at(measured_ns, ahead_ns), measured_ns + delay_ns);
        if (i == 0) continue;
        ASSERT_NEAR(time_s, seconds(measured_ns + ahead_ns + least_delay_ns), 1e-8) << "track " << i;
    }
}

TEST(SceneClock, SessionsSeeTheSameMoment) {
    SceneClock one(kStart_ns);
    SceneClock other(kStart_ns);
    const std::int64_t shown_ns = kStart_ns + 900 * kMillisecond_ns;
    // Clients of different clocks, rates and predictions, whose delays differ by 3 ms.
    Track a = track_at(shown_ns - 50 * kMillisecond_ns, 50 * kMillisecond_ns);
    Track b = track_at(shown_ns - 20 * kMillisecond_ns, 20 * kMillisecond_ns);
    b.pose_time_ns += 777;
    b.display_time_ns += 777;
    const double time_a_s = one.display_time_s(a, shown_ns - 49 * kMillisecond_ns);
    const double time_b_s = other.display_time_s(b, shown_ns - 16 * kMillisecond_ns);
    EXPECT_NEAR(time_b_s - time_a_s, 0.003, 1e-8);
}

TEST(SceneClock, GoesOnWhenTheClientsClockIsSet) {
    const std::int64_t second_ns = 1000 * kMillisecond_ns;
    for (const std::int64_t set_ns : {-3600 * second_ns, -second_ns, second_ns, 3600 * second_ns}) {
        SceneClock clock(kStart_ns);
        for (int i = 0; i < 200; ++i) {
            const std::int64_t server_ns = kStart_ns + i * 100 * kMillisecond_ns;
            Track track = track_at(server_ns, 0);
            if (i >= 30) track.pose_time_ns += set_ns;
            if (i >= 30) track.display_time_ns += set_ns;
            EXPECT_NEAR(clock.display_time_s(track, server_ns), seconds(server_ns), 1e-8) << set_ns << " at " << i;
        }
    }
}

TEST(SceneClock, DoesNotBelieveAbsurdTimes) {
    const std::int64_t limit_ns = std::int64_t{1} << 60;
    for (const std::int64_t pose_ns : {-limit_ns, std::int64_t{0}, limit_ns}) {
        for (const std::int64_t display_ns : {-limit_ns, std::int64_t{0}, limit_ns}) {
            SceneClock clock(kStart_ns);
            Track track;
            track.pose_time_ns = pose_ns;
            track.display_time_ns = display_ns;
            const double time_s = clock.display_time_s(track, kStart_ns + kMillisecond_ns);
            EXPECT_LE(std::abs(time_s - 0.001), 1.0 + 1e-6);
        }
    }
}

}  // namespace
}  // namespace macula
