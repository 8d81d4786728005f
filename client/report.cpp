#include "client/report.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace macula {
namespace {

constexpr double kMillisecond_ns = 1e6;

/// Missing stages are not numbers.
using StageRow = std::array<double, kStageCount>;

StageRow stages_of(const ReceivedFrame& received, const PresentTimes& times, const std::optional<ClockOffset>& clock) {
    const Frame& frame = received.frame;
    const StageTimes& server = frame.times;
    StageRow row;
    row.fill(std::nan(""));
    const auto set = [&](Stage stage, std::int64_t begin_ns, std::int64_t end_ns) {
        row[static_cast<std::size_t>(stage)] = static_cast<double>(end_ns - begin_ns) / kMillisecond_ns;
    };
    if (clock) {
        set(Stage::uplink, frame.pose_time_ns, server.track_received_ns - clock->offset_ns);
        set(Stage::downlink, server.send_ns - clock->offset_ns, received.received_ns);
    }
    set(Stage::wait, server.track_received_ns, server.begin_ns);
    set(Stage::plan, server.begin_ns, server.plan_ns);
    set(Stage::trace, server.plan_ns, server.trace_ns);
    set(Stage::reconstruct, server.trace_ns, server.reconstruct_ns);
    set(Stage::encode, server.reconstruct_ns, server.encode_ns);
    set(Stage::send, server.encode_ns, server.send_ns);
    set(Stage::decode, received.received_ns, received.decoded_ns);
    set(Stage::hold, received.decoded_ns, times.taken_ns);
    set(Stage::accumulate, times.taken_ns, times.accumulated_ns);
    set(Stage::reproject, times.accumulated_ns, times.reprojected_ns);
    set(Stage::display, times.displayed_ns, times.written_ns);
    set(Stage::gaze_to_frame, frame.gaze_time_ns, times.displayed_ns);
    return row;
}

std::string format(const char* pattern, auto... values) {
    std::array<char, 256> text;
    std::snprintf(text.data(), text.size(), pattern, values...);
    return text.data();
}

}  // namespace

Expected<Report> Report::open(const std::string& stats_path, std::uint64_t frame_pixels) {
    Report report(frame_pixels);
    report.path_ = stats_path;
    if (stats_path.empty()) return report;
    report.file_.open(stats_path, std::ios::binary | std::ios::trunc);
    if (!report.file_) return fail(ErrorCode::output, stats_path + ": cannot be written: " + std::strerror(errno));
    report.file_ << "frame,track,connection,shown_ms,keyframe,bytes,traced_share,clock_offset_ms,round_trip_ms,"
                    "frames_dropped,tracks_dropped,frames_undecodable";
    for (const char* name : kStageNames) report.file_ << ',' << name << "_ms";
    report.file_ << '\n';
    return report;
}

void Report::add(const ReceivedFrame& received, const PresentTimes& times, const std::optional<ClockOffset>& clock,
                 const ClientSessionCounters& counters) {
    if (frames_++ == 0) first_ns_ = times.displayed_ns;
    last_ns_ = times.displayed_ns;
    traced_ += received.frame.traced;
    bytes_ += received.bytes;
    pipeline_ns_ += (times.displayed_ns - received.frame.pose_time_ns - pipeline_ns_) / 8;
    pipeline_ns_ = std::clamp<std::int64_t>(pipeline_ns_, 0, 300'000'000);
    const StageRow row = stages_of(received, times, clock);
    for (std::size_t i = 0; i < kStageCount; ++i) {
        if (!std::isnan(row[i])) stages_ms_[i].push_back(static_cast<float>(row[i]));
    }
    if (!file_.is_open()) return;
    file_ << received.frame.id << ',' << received.frame.track_id << ',' << received.connection << ','
          << format("%.3f", static_cast<double>(times.displayed_ns - first_ns_) / kMillisecond_ns) << ','
          << (received.frame.keyframe ? 1 : 0) << ',' << received.bytes << ','
          << format("%.4f", static_cast<double>(received.frame.traced) / static_cast<double>(frame_pixels_)) << ',';
    if (clock) file_ << format("%.3f", static_cast<double>(clock->offset_ns) / kMillisecond_ns);
    file_ << ',';
    if (clock) file_ << format("%.3f", static_cast<double>(clock->round_trip_ns) / kMillisecond_ns);
    file_ << ',' << counters.frames_dropped << ',' << counters.tracks_dropped << ',' << counters.frames_undecodable;
    for (const double value : row) file_ << ',' << (std::isnan(value) ? std::string() : format("%.3f", value));
    file_ << '\n';
}

double Report::seconds() const {
    return static_cast<double>(last_ns_ - first_ns_) * 1e-9;
}

double Report::frames_per_second() const {
    return frames_ < 2 || last_ns_ == first_ns_ ? 0.0 : static_cast<double>(frames_ - 1) / seconds();
}

double Report::megabits_per_second() const {
    return frames_ < 2 || last_ns_ == first_ns_ ? 0.0 : static_cast<double>(bytes_) * 8e-6 / seconds();
}

double Report::traced_share() const {
    return frames_ == 0
               ? 0.0
               : static_cast<double>(traced_) / (static_cast<double>(frames_) * static_cast<double>(frame_pixels_));
}

double Report::stage_ms(std::size_t stage, double quantile) const {
    std::vector<float> values = stages_ms_[stage];
    if (values.empty()) return 0.0;
    const auto at = std::lround(quantile * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + at);
    return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

std::string Report::summary(const ClientSessionCounters& counters) const {
    std::string text = format("frames shown          %llu in %.1f s, %.1f a second\n",
                              static_cast<unsigned long long>(frames_), seconds(), frames_per_second());
    text += format("pixels traced         %.1f %%\n", 100.0 * traced_share());
    text += format("bit rate              %.1f Mbit/s\n", megabits_per_second());
    text += format("gaze to frame         p50 %.1f ms, p99 %.1f ms\n",
                   stage_ms(static_cast<std::size_t>(Stage::gaze_to_frame), 0.5),
                   stage_ms(static_cast<std::size_t>(Stage::gaze_to_frame), 0.99));
    text += format("dropped               %llu frames, %llu tracks; %llu frames not decodable\n",
                   static_cast<unsigned long long>(counters.frames_dropped),
                   static_cast<unsigned long long>(counters.tracks_dropped),
                   static_cast<unsigned long long>(counters.frames_undecodable));
    text += format("connections           %llu\n", static_cast<unsigned long long>(counters.connections));
    text += "stage                 p50 ms    p99 ms\n";
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
        text += format("  %-18s %8.2f  %8.2f\n", kStageNames[stage], stage_ms(stage, 0.5), stage_ms(stage, 0.99));
    }
    return text;
}

std::string Report::summary_values(const ClientSessionCounters& counters) const {
    std::string text = format("frames=%llu\nseconds=%.3f\nframes_per_second=%.3f\n",
                              static_cast<unsigned long long>(frames_), seconds(), frames_per_second());
    text += format("traced_share=%.4f\nmegabits_per_second=%.3f\n", traced_share(), megabits_per_second());
    text += format("frames_dropped=%llu\ntracks_dropped=%llu\nframes_undecodable=%llu\nconnections=%llu\n",
                   static_cast<unsigned long long>(counters.frames_dropped),
                   static_cast<unsigned long long>(counters.tracks_dropped),
                   static_cast<unsigned long long>(counters.frames_undecodable),
                   static_cast<unsigned long long>(counters.connections));
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
        text += format("%s_p50_ms=%.3f\n%s_p99_ms=%.3f\n", kStageNames[stage], stage_ms(stage, 0.5), kStageNames[stage],
                       stage_ms(stage, 0.99));
    }
    return text;
}

Expected<void> Report::close() {
    if (!file_.is_open()) return {};
    file_.close();
    if (!file_) return fail(ErrorCode::output, path_ + ": writing the table failed; is the disk full?");
    return {};
}

}  // namespace macula
