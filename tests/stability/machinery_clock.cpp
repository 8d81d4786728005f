// Clocks that are set while a session runs, by 1 s or an hour, forwards or back: the client's, whose times are in its
// Tracks, and the server's. Monotonic clocks do not do that; a suspended machine, a virtual one, or a client with
// another idea of time does.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "client/report.h"
#include "client/stream/clock_offset.h"
#include "server/service/prediction.h"
#include "server/service/scene_clock.h"
#include "server/service/statistics.h"
#include "tests/stability/case.h"

namespace macula::test {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond_ns = 1000 * kMs;
constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
constexpr std::int64_t kPeriod_ns = 11 * kMs;
constexpr std::int64_t kStart_ns = 77 * kHour_ns;  ///< of the server's clock
constexpr int kFrames = 2000;
constexpr int kEvent = 500;

struct Jump {
    std::string name;
    std::int64_t by_ns;
};

const std::vector<Jump>& jumps() {
    static const std::vector<Jump> all = {
        {"-1h", -kHour_ns}, {"-1s", -kSecond_ns}, {"+1s", kSecond_ns}, {"+1h", kHour_ns}};
    return all;
}

/// A Track of frame `i` of a walk at 1 m/s and 1 rad/s, whose clock is set by `jump_ns` at kEvent.
Track track_at(int i, std::int64_t jump_ns) {
    Track track;
    track.id = static_cast<std::uint64_t>(i) + 1;
    track.pose_time_ns = track.gaze_time_ns = 5 * kSecond_ns + i * kPeriod_ns + (i < kEvent ? 0 : jump_ns);
    track.display_time_ns = track.pose_time_ns + 40 * kMs;
    track.linear_velocity_m_s = {1.0F, 0.0F, 0.0F};
    track.angular_velocity_rad_s = {0.0F, 1.0F, 0.0F};
    track.start_from_head.position_m.x = 1e-9F * static_cast<float>(i * kPeriod_ns);
    return track;
}

/// Delay of the network: 2 ms and up to 6 ms of jitter, the same on every machine.
std::int64_t delay_ns(int i) {
    return 2 * kMs + (i * 7919 % 13) * kMs / 2;
}

struct SceneTimes {
    double worst_step_s = 0.0;  ///< largest difference from one frame's period
    double steps_back_s = 0.0;  ///< largest step back
    double late_s = 0.0;        ///< largest difference, after the jump, from what would be shown without it
};

SceneTimes scene_times(std::int64_t client_jump_ns, std::int64_t server_jump_ns) {
    SceneClock clock(kStart_ns);
    SceneClock undisturbed(kStart_ns);
    SceneTimes times;
    double before_s = 0.0;
    for (int i = 0; i < kFrames; ++i) {
        const std::int64_t received_ns = kStart_ns + 40 * kSecond_ns + i * kPeriod_ns + delay_ns(i);
        const std::int64_t set_ns = i < kEvent ? 0 : server_jump_ns;
        const double time_s = clock.display_time_s(track_at(i, client_jump_ns), received_ns + set_ns);
        const double expected_s = undisturbed.display_time_s(track_at(i, 0), received_ns);
        if (i > 10) {
            const double step_s = time_s - before_s;
            times.worst_step_s = std::max(times.worst_step_s, std::abs(step_s - 1e-9 * kPeriod_ns));
            times.steps_back_s = std::max(times.steps_back_s, -step_s);
            times.late_s = std::max(times.late_s, std::abs(time_s - expected_s - 1e-9 * static_cast<double>(set_ns)));
        }
        before_s = time_s;
    }
    return times;
}

TEST(SceneTime, GoesOnWhenTheClientsClockIsSet) {
    for (const Jump& jump : jumps()) {
        const std::string name = "machinery/client-clock" + jump.name;
        const SceneTimes times = scene_times(jump.by_ns, 0);
        check({name, "jump of scene time (ms)", 1e3 * times.worst_step_s, Side::at_most, 6.5,
               "the offset of the clocks is learned anew, from Tracks whose delays differ by 6 ms"});
        check({name, "animation goes back by (ms)", 1e3 * times.steps_back_s, Side::at_most, 0.0,
               "frames are 11 ms apart, which is more than the delays differ by"});
        check({name, "scene time off by (ms)", 1e3 * times.late_s, Side::at_most, 6.5,
               "the least delay is found again; until then it is wrong by the jitter"});
    }
}

TEST(SceneTime, FollowsTheServersClock) {
    // It only goes forward: now_ns() is monotonic. Scene time is its seconds, so it leaps along.
    for (const Jump& jump : {jumps()[2], jumps()[3]}) {
        const SceneTimes times = scene_times(0, jump.by_ns);
        const std::string name = "machinery/server-clock" + jump.name;
        check({name, "animation goes back by (ms)", 1e3 * times.steps_back_s, Side::at_most, 0.0,
               "scene time follows the server's clock"});
        check({name, "scene time off by (ms)", 1e3 * times.late_s, Side::at_most, 1001.0,
               "SceneClock::kMaxAhead_ns: a Track that was a second on its way looks the same, so for the filter's 10 "
               "s the "
               "offset before the leap is believed"});
    }
}

TEST(Prediction, StaysFiniteAndBoundedWhenTheClientsClockIsSet) {
    for (const Jump& jump : jumps()) {
        float farthest_m = 0.0F;
        float unit_error = 0.0F;
        bool finite = true;
        for (int i = 0; i < kFrames; ++i) {
            Track track = track_at(i, jump.by_ns);
            // The clock may be set between the measurement and the estimate of when it is shown.
            if (i == kEvent) track.pose_time_ns -= jump.by_ns;
            if (i == kEvent + 1) track.display_time_ns -= jump.by_ns;
            const Pose head = predict_head(track);
            const Pose& measured = track.start_from_head;
            farthest_m = std::max(farthest_m, glm::length(head.position_m - measured.position_m));
            unit_error = std::max(unit_error, std::abs(glm::length(head.orientation) - 1.0F));
            finite = finite && std::isfinite(head.position_m.x) && std::isfinite(head.orientation.w);
        }
        const std::string name = "machinery/prediction" + jump.name;
        check({name, "head predicted away from its pose (mm)", 1e3 * farthest_m, Side::at_most, 101.0,
               "1 m/s for at most kMaxPrediction_ns, 100 ms"});
        check({name, "orientation's length less 1", finite ? unit_error : std::numeric_limits<double>::quiet_NaN(),
               Side::at_most, 1e-6, "a rotation, in single precision"});
    }
}

TEST(Gaze, IsNotHeldForLongerThoughTheClockIsSetBack) {
    const glm::vec3 aside = glm::normalize(glm::vec3(-1.0F, 0.0F, -1.0F));
    for (const Jump& jump : jumps()) {
        GazeHold hold;
        hold.update({aside, 1.0F}, kHour_ns);
        // The eye is lost and the clock set: how long the old direction is held from then on.
        std::int64_t held_ns = 0;
        for (std::int64_t after_ns = 0; after_ns < 2 * kSecond_ns; after_ns += kPeriod_ns) {
            const glm::vec3 gaze = hold.update({aside, 0.0F}, kHour_ns + jump.by_ns + after_ns);
            if (gaze == aside) held_ns = after_ns;
        }
        check({"machinery/lost-gaze" + jump.name, "gaze held for (ms)", 1e-6 * static_cast<double>(held_ns),
               Side::at_most, 1e-6 * static_cast<double>(GazeHold::kMaxHold_ns),
               "GazeHold::kMaxHold_ns; a leap forwards ends it, a step back counts it anew"});
    }
}

/// Exchanges until the client's estimate of the server's clock is right to 1 ms again.
TEST(ClockOffset, IsFoundAgainWhenAClockIsSet) {
    for (const Jump& jump : jumps()) {
        for (const bool clients : {true, false}) {
            ClockFilter filter;
            int wrong = 0;
            for (int i = 0; i < 100; ++i) {
                const std::int64_t client_ns = kHour_ns * 2 + i * 250 * kMs + (clients && i >= 50 ? jump.by_ns : 0);
                const std::int64_t offset_ns = 9 * kHour_ns + (i < 50 ? 0 : clients ? -jump.by_ns : jump.by_ns);
                // Those before the jump happened to be quick ones.
                const std::int64_t way_ns = i < 50 ? kMs : 2 * kMs;
                filter.add({client_ns, client_ns + way_ns + offset_ns}, client_ns + 2 * way_ns);
                if (i >= 50 && std::abs(filter.best()->offset_ns - offset_ns) > kMs) ++wrong;
            }
            check({"machinery/offset-of-" + std::string(clients ? "client" : "server") + "-clock" + jump.name,
                   "exchanges until right", static_cast<double>(wrong), Side::at_most,
                   static_cast<double>(ClockFilter::kExchanges),
                   "ClockFilter forgets after 16 exchanges, 4 s; only the statistics use it"});
        }
    }
}

TEST(Statistics, StayFiniteWhenTheClientsClockIsSet) {
    for (const Jump& jump : jumps()) {
        Report report = Report::open("", 2 * 188 * 208).value();
        SessionStatistics statistics(0, 2 * 188 * 208);
        ClientSessionCounters counters;
        std::int64_t longest_ns = 0;
        std::int64_t shortest_ns = std::numeric_limits<std::int64_t>::max();
        for (int i = 0; i < kFrames; ++i) {
            ReceivedFrame received;
            Frame& frame = received.frame;
            // Measured before the clock was set, shown after.
            const Track track = track_at(i < kEvent + 3 ? std::min(i, kEvent - 1) : i, jump.by_ns);
            frame.pose_time_ns = track.pose_time_ns;
            frame.gaze_time_ns = track.gaze_time_ns;
            PresentTimes times;
            const std::int64_t now_ns = 5 * kSecond_ns + i * kPeriod_ns + 30 * kMs + (i < kEvent ? 0 : jump.by_ns);
            received.received_ns = received.decoded_ns = times.taken_ns = times.accumulated_ns = now_ns;
            times.reprojected_ns = times.displayed_ns = times.written_ns = now_ns;
            report.add(received, times, ClockOffset{kHour_ns, kMs}, counters);
            frame.times.begin_ns = frame.times.track_received_ns + jump.by_ns;
            statistics.add_frame(frame.times, 1000, 5000, frame.times.encode_ns);
            longest_ns = std::max(longest_ns, report.pipeline_ns());
            shortest_ns = std::min(shortest_ns, report.pipeline_ns());
        }
        const std::string name = "machinery/statistics" + jump.name;
        check({name, "longest estimate of the pipeline (ms)", 1e-6 * static_cast<double>(longest_ns), Side::at_most,
               300.0, "Report does not believe more; it is what display times are made of"});
        check({name, "shortest estimate of the pipeline (ms)", 1e-6 * static_cast<double>(shortest_ns), Side::at_least,
               0.0, "a picture is not shown before its pose was measured"});
        check({name, "estimate at the end (ms)", 1e-6 * static_cast<double>(report.pipeline_ns()), Side::at_most, 31.0,
               "30 ms in truth: the estimate comes back"});
        const std::string text =
            report.summary(counters) + report.summary_values(counters) + statistics.summary_line(100 * kSecond_ns);
        const bool finite = text.find("nan") == std::string::npos && text.find("inf") == std::string::npos;
        check({name, "numbers in summaries that are none", finite ? 0.0 : 1.0, Side::at_most, 0.0,
               "every line of the summaries is read by people and scripts"});
    }
}

}  // namespace
}  // namespace macula::test
