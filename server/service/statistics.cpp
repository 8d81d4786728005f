#include "server/service/statistics.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace macula {

namespace {

constexpr std::array<const char*, 6> kStageNames = {"wait", "plan", "trace", "reconstruct", "encode", "send"};

}  // namespace

void DurationHistogram::add(std::int64_t duration_ns) {
    const double octaves = std::log2(std::max(static_cast<double>(duration_ns) * 1e-3, 1.0));
    const auto bin = static_cast<std::size_t>(octaves * kBinsPerOctave);
    ++bins_[std::min(bin, bins_.size() - 1)];
    ++total_;
}

double DurationHistogram::percentile_ms(double share) const {
    if (total_ == 0) return 0.0;
    const double wanted = share * total_;
    double below = 0.0;
    std::size_t bin = 0;
    for (; bin + 1 < bins_.size(); ++bin) {
        below += bins_[bin];
        if (below >= wanted && below > 0.0) break;
    }
    return std::exp2((static_cast<double>(bin) + 0.5) / kBinsPerOctave) * 1e-3;
}

SessionStatistics::SessionStatistics(std::int64_t now_ns, std::uint64_t frame_pixels)
    : frame_pixels_(frame_pixels), interval_(now_ns), total_(now_ns) {}

void SessionStatistics::add_frame(const StageTimes& times, std::uint32_t traced, std::size_t size_bytes,
                                  std::int64_t sent_ns) {
    const std::array<std::int64_t, 6> durations_ns = {
        times.begin_ns - times.track_received_ns, times.plan_ns - times.begin_ns,
        times.trace_ns - times.plan_ns,           times.reconstruct_ns - times.trace_ns,
        times.encode_ns - times.reconstruct_ns,   sent_ns - times.encode_ns};
    const std::lock_guard lock(mutex_);
    for (Tally* tally : {&interval_, &total_}) {
        ++tally->frames;
        tally->traced += traced;
        tally->size_bytes += size_bytes;
        for (std::size_t stage = 0; stage < durations_ns.size(); ++stage) tally->stages[stage].add(durations_ns[stage]);
    }
}

void SessionStatistics::add_report(const FrameReport& report) {
    const std::lock_guard lock(mutex_);
    for (Tally* tally : {&interval_, &total_}) {
        if (report.displayed_ns == 0) ++tally->not_shown;
        if (report.decode_failed) ++tally->not_decoded;
    }
}

std::string SessionStatistics::interval_line(std::int64_t now_ns) {
    const std::lock_guard lock(mutex_);
    std::string line = interval_.line(now_ns, frame_pixels_);
    interval_ = Tally(now_ns);
    return line;
}

std::string SessionStatistics::summary_line(std::int64_t now_ns) const {
    const std::lock_guard lock(mutex_);
    return total_.line(now_ns, frame_pixels_);
}

std::string SessionStatistics::Tally::line(std::int64_t end_ns, std::uint64_t frame_pixels) const {
    const double seconds = std::max(static_cast<double>(end_ns - begin_ns) * 1e-9, 1e-9);
    if (frames == 0) return fmt::format("no frames in {:.1f} s", seconds);
    const auto count = static_cast<double>(frames);
    std::string text =
        fmt::format("{} frames in {:.1f} s ({:.1f}/s), traced {:.1f} %, {:.2f} Mb/s; ms p50/p99:", frames, seconds,
                    count / seconds, 100.0 * static_cast<double>(traced) / (count * static_cast<double>(frame_pixels)),
                    8e-6 * static_cast<double>(size_bytes) / seconds);
    for (std::size_t stage = 0; stage < kStageNames.size(); ++stage)
        text += fmt::format(" {} {:.2f}/{:.2f}", kStageNames[stage], stages[stage].percentile_ms(0.5),
                            stages[stage].percentile_ms(0.99));
    return text + fmt::format("; {} not shown, {} not decoded", not_shown, not_decoded);
}

}  // namespace macula
