#include "client/device/recording.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

#include "client/device/salient360.h"

namespace macula {
namespace {

constexpr std::uintmax_t kMaxFile_bytes = std::uintmax_t{1} << 30;
/// Keeps differences of times inside int64.
constexpr std::int64_t kMaxTime_ns = std::int64_t{1} << 62;

constexpr std::array kMaculaColumns = {
    "time_ns", "head_x_m", "head_y_m", "head_z_m", "head_qx", "head_qy", "head_qz",         "head_qw",
    "left_x",  "left_y",   "left_z",   "right_x",  "right_y", "right_z", "left_confidence", "right_confidence"};

std::optional<RowLayout> find_layout(const Columns& columns) {
    if (auto layout = macula_layout(columns)) return layout;
    if (auto layout = salient360_dynamic_layout(columns)) return layout;
    return salient360_static_layout(columns);
}

/// Takes lines off the front of a text and counts them.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}
    std::optional<std::string_view> next() {
        if (rest_.empty()) return std::nullopt;
        const std::size_t end = rest_.find('\n');
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        ++number_;
        return line;
    }
    [[nodiscard]] std::size_t number() const { return number_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

bool blank_or_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    return first == std::string_view::npos || line[first] == '#';
}

}  // namespace

std::optional<RowLayout> macula_layout(const Columns& columns) {
    std::array<std::size_t, kMaculaColumns.size()> index{};
    for (std::size_t i = 0; i < kMaculaColumns.size(); ++i) {
        const auto found = columns.find(kMaculaColumns[i]);
        if (!found) return std::nullopt;
        index[i] = *found;
    }
    const auto read = [index, count = columns.count()](std::span<const std::string_view> fields,
                                                       DeviceSample& sample) -> std::optional<std::string> {
        if (fields.size() != count) return "the row has another number of fields than the header";
        const auto time_ns = parse_integer(fields[index[0]]);
        if (!time_ns) return "time_ns is not an integer";
        std::array<float, kMaculaColumns.size()> value{};
        for (std::size_t i = 1; i < value.size(); ++i) {
            const auto number = parse_number(fields[index[i]]);
            if (!number || !std::isfinite(*number) || std::abs(*number) > 1e6) {
                return std::string(kMaculaColumns[i]) + " is not a number";
            }
            value[i] = static_cast<float>(*number);
        }
        sample.time_ns = *time_ns;
        sample.start_from_head.position_m = {value[1], value[2], value[3]};
        const glm::quat q(value[7], value[4], value[5], value[6]);
        if (std::abs(glm::length(q) - 1.0F) > 1e-2F) return "the head quaternion is not of length 1";
        sample.start_from_head.orientation = glm::normalize(q);
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            const glm::vec3 direction(value[8 + 3 * eye], value[9 + 3 * eye], value[10 + 3 * eye]);
            if (std::abs(glm::length(direction) - 1.0F) > 1e-2F) return "a gaze vector is not of length 1";
            const float confidence = value[14 + eye];
            if (confidence < 0.0F || confidence > 1.0F) return "a confidence is outside 0..1";
            sample.gaze[eye] = {glm::normalize(direction), confidence};
        }
        return std::nullopt;
    };
    return RowLayout{"Macula", read, false};
}

Expected<Recording> parse_recording(std::string_view text, const std::string& name) {
    Lines lines(text);
    std::optional<std::string_view> line = lines.next();
    while (line && blank_or_comment(*line)) line = lines.next();
    if (!line) return fail(ErrorCode::input_file, name + ": the recording is empty");
    const std::optional<RowLayout> layout = find_layout(Columns(*line));
    if (!layout) {
        return fail(ErrorCode::input_file, name + ":" + std::to_string(lines.number()) +
                                               ": the header is none of the known layouts (see RECORDING.md)");
    }

    Recording recording;
    recording.layout = layout->name;
    std::vector<std::string_view> fields;
    DeviceSample sample;
    std::int64_t first_ns = 0;
    while ((line = lines.next())) {
        if (blank_or_comment(*line)) continue;
        split_fields(*line, fields);
        // The reader keeps the last known gaze in `sample`; a broken row must not spoil it.
        DeviceSample candidate = sample;
        std::optional<std::string> problem = layout->read(fields, candidate);
        if (!problem && (candidate.time_ns > kMaxTime_ns || candidate.time_ns < 0)) {
            problem = "the time is out of range";
        }
        if (!problem && !recording.samples.empty() &&
            candidate.time_ns - first_ns <= recording.samples.back().time_ns) {
            problem = "the time does not rise";
        }
        if (problem) {
            if (recording.skipped_rows++ == 0) {
                recording.first_problem = "line " + std::to_string(lines.number()) + ": " + *problem;
            }
            continue;
        }
        sample = candidate;
        if (recording.samples.empty()) first_ns = sample.time_ns;
        recording.samples.push_back(sample);
        recording.samples.back().time_ns -= first_ns;
    }
    if (recording.samples.empty()) {
        return fail(ErrorCode::input_file,
                    name + ": no usable row" +
                        (recording.first_problem.empty() ? std::string(" after the header")
                                                         : "; the first problem is in " + recording.first_problem));
    }
    if (layout->tracker_space) {
        interpolate_held_poses(recording.samples);
        move_to_start(recording.samples);
    }
    return recording;
}

Expected<Recording> load_recording(const std::string& path) {
    std::error_code problem;
    const std::uintmax_t size = std::filesystem::file_size(path, problem);
    if (problem) return fail(ErrorCode::input_file, path + ": " + problem.message());
    if (size > kMaxFile_bytes) return fail(ErrorCode::input_file, path + ": larger than 1 GiB");
    std::ifstream file(path, std::ios::binary);
    std::string text(size, '\0');
    if (!file || !file.read(text.data(), static_cast<std::streamsize>(size))) {
        return fail(ErrorCode::input_file, path + ": cannot be read");
    }
    return parse_recording(text, path);
}

}  // namespace macula
