#include "client/device/recorder.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace macula {
namespace {

void append(std::string& row, float value) {
    std::array<char, 32> text;
    const auto [end, problem] = std::to_chars(text.data(), text.data() + text.size(), value);
    row += ',';
    row.append(text.data(), end);
}

}  // namespace

std::string recording_header() {
    return "time_ns,head_x_m,head_y_m,head_z_m,head_qx,head_qy,head_qz,head_qw,"
           "left_x,left_y,left_z,right_x,right_y,right_z,left_confidence,right_confidence";
}

std::string recording_row(const DeviceSample& sample) {
    std::string row = std::to_string(sample.time_ns);
    const glm::vec3& p = sample.start_from_head.position_m;
    const glm::quat& q = sample.start_from_head.orientation;
    for (const float value : {p.x, p.y, p.z, q.x, q.y, q.z, q.w}) append(row, value);
    for (const GazeSample& gaze : sample.gaze) {
        for (const float value : {gaze.direction.x, gaze.direction.y, gaze.direction.z}) append(row, value);
    }
    for (const GazeSample& gaze : sample.gaze) append(row, gaze.confidence);
    return row;
}

Expected<std::unique_ptr<Recorder>> Recorder::open(const std::string& path) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    if (!file) return fail(ErrorCode::output, path + ": cannot be written: " + std::strerror(errno));
    file << recording_header() << '\n';
    return std::unique_ptr<Recorder>(new Recorder(path, std::move(file)));
}

void Recorder::write(const DeviceSample& sample) {
    if (!first_ns_) first_ns_ = sample.time_ns;
    DeviceSample relative = sample;
    relative.time_ns -= *first_ns_;
    file_ << recording_row(relative) << '\n';
}

Expected<void> Recorder::close() {
    file_.close();
    if (!file_) return fail(ErrorCode::output, path_ + ": writing the recording failed; is the disk full?");
    return {};
}

std::uint64_t record(TrackSource& source, Recorder& recorder, std::int64_t length_ns) {
    source.begin(0);
    std::uint64_t count = 0;
    for (auto due_ns = source.due_ns(); due_ns && *due_ns <= length_ns; due_ns = source.due_ns()) {
        while (const auto sample = source.next(*due_ns)) {
            recorder.write(*sample);
            ++count;
        }
    }
    return count;
}

}  // namespace macula
