#include "server/service/statistics.h"

#include <gtest/gtest.h>

namespace macula {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TEST(DurationHistogram, PercentilesAreExactWithinABin) {
    DurationHistogram histogram;
    EXPECT_EQ(histogram.percentile_ms(0.5), 0.0);
    for (int ms = 1; ms <= 100; ++ms) histogram.add(ms * kMs);
    EXPECT_NEAR(histogram.percentile_ms(0.5), 50.0, 0.045 * 50.0);
    EXPECT_NEAR(histogram.percentile_ms(0.99), 99.0, 0.045 * 99.0);
}

TEST(DurationHistogram, TakesAnyDuration) {
    DurationHistogram histogram;
    histogram.add(-5);
    histogram.add(0);
    EXPECT_NEAR(histogram.percentile_ms(0.5), 0.001, 0.0001);
    histogram.add(std::int64_t{1} << 60);
    histogram.add(std::int64_t{1} << 60);
    histogram.add(std::int64_t{1} << 60);
    EXPECT_GT(histogram.percentile_ms(0.5), 10'000.0);
}

TEST(SessionStatistics, LinesSayWhatHappened) {
    SessionStatistics statistics(0, 1'000);
    for (int frame = 0; frame < 20; ++frame) {
        StageTimes times;
        times.track_received_ns = 0;
        times.begin_ns = 1 * kMs;
        times.plan_ns = 2 * kMs;
        times.trace_ns = 12 * kMs;
        times.reconstruct_ns = 15 * kMs;
        times.encode_ns = 20 * kMs;
        statistics.add_frame(times, 250, 12'500, 21 * kMs);
    }
    FrameReport report;
    report.frame_id = 3;
    report.decode_failed = true;
    statistics.add_report(report);

    const std::string first = statistics.interval_line(2'000 * kMs);
    EXPECT_NE(first.find("20 frames in 2.0 s (10.0/s), traced 25.0 %, 1.00 Mb/s"), std::string::npos) << first;
    EXPECT_NE(first.find("trace 9.96"), std::string::npos) << first;
    EXPECT_NE(first.find("1 not shown, 1 not decoded"), std::string::npos) << first;
    EXPECT_NE(statistics.interval_line(3'000 * kMs).find("no frames in 1.0 s"), std::string::npos);
    const std::string all = statistics.summary_line(4'000 * kMs);
    EXPECT_NE(all.find("20 frames in 4.0 s (5.0/s)"), std::string::npos) << all;
}

}  // namespace
}  // namespace macula
