#include "client/device/salient360.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/trigonometric.hpp>

namespace macula {
namespace {

using Fields = std::span<const std::string_view>;

std::optional<std::vector<std::size_t>> find_all(const Columns& columns, std::span<const std::string_view> names) {
    std::vector<std::size_t> index;
    for (const std::string_view name : names) {
        const auto found = columns.find(name);
        if (!found) return std::nullopt;
        index.push_back(*found);
    }
    return index;
}

/// Finite number of at most a million; outside it a field is broken.
std::optional<float> bounded(std::string_view text) {
    const auto number = parse_number(text);
    if (!number || !std::isfinite(*number) || std::abs(*number) > 1e6) return std::nullopt;
    return static_cast<float>(*number);
}

/// Direction of an eye in Unity's axes. An eye that the tracker lost (flag or numbers say so) keeps its last
/// direction with confidence 0.
void read_gaze(Fields fields, std::size_t x, bool valid, GazeSample& gaze) {
    gaze.confidence = 0.0F;
    if (!valid) return;
    const auto vx = bounded(fields[x]);
    const auto vy = bounded(fields[x + 1]);
    const auto vz = bounded(fields[x + 2]);
    if (!vx || !vy || !vz) return;
    const glm::vec3 direction = from_unity(glm::vec3(*vx, *vy, *vz));
    const float length = glm::length(direction);
    if (std::abs(length - 1.0F) > 1e-2F) return;
    gaze = {direction / length, 1.0F};
}

}  // namespace

glm::vec3 from_unity(const glm::vec3& v) {
    return {v.x, v.y, -v.z};
}

glm::quat from_unity(const glm::quat& q) {
    return {q.w, -q.x, -q.y, q.z};
}

glm::quat from_unity_euler(double pitch_deg, double yaw_deg, double roll_deg) {
    const glm::dquat pitch = glm::angleAxis(glm::radians(pitch_deg), glm::dvec3(1.0, 0.0, 0.0));
    const glm::dquat yaw = glm::angleAxis(glm::radians(yaw_deg), glm::dvec3(0.0, 1.0, 0.0));
    const glm::dquat roll = glm::angleAxis(glm::radians(roll_deg), glm::dvec3(0.0, 0.0, 1.0));
    return from_unity(glm::quat(yaw * pitch * roll));
}

std::optional<RowLayout> salient360_dynamic_layout(const Columns& columns) {
    constexpr std::array<std::string_view, 6> kNames = {"oculoTS",  "cam_pitch",     "cam_yaw",
                                                        "cam_roll", "leftGazeDir.x", "rightGazeDir.x"};
    const auto index = find_all(columns, kNames);
    // Each gaze vector is three columns in a row, and the two flags come last.
    if (!index || columns.count() < 30 || (*index)[4] + 3 > columns.count() - 3 ||
        (*index)[5] + 3 > columns.count() - 3) {
        return std::nullopt;
    }
    const auto read = [at = *index, count = columns.count()](Fields fields,
                                                             DeviceSample& sample) -> std::optional<std::string> {
        // The last number and the left eye's flag share a field: "666.5324True,True".
        if (fields.size() != count - 1) return "the row has another number of fields than the layout";
        const auto time_ns = parse_integer(fields[at[0]]);
        const auto pitch_deg = bounded(fields[at[1]]);
        const auto yaw_deg = bounded(fields[at[2]]);
        const auto roll_deg = bounded(fields[at[3]]);
        if (!time_ns) return "oculoTS is not an integer";
        if (!pitch_deg || !yaw_deg || !roll_deg) return "a camera angle is not a number";
        sample.time_ns = *time_ns;
        sample.start_from_head.orientation = from_unity_euler(*pitch_deg, *yaw_deg, *roll_deg);
        read_gaze(fields, at[4], fields[count - 3].ends_with("True"), sample.gaze[kLeftEye]);
        read_gaze(fields, at[5], fields[count - 2] == "True", sample.gaze[kRightEye]);
        return std::nullopt;
    };
    return RowLayout{"Salient360 video", read, true};
}

std::optional<RowLayout> salient360_static_layout(const Columns& columns) {
    constexpr std::array<std::string_view, 12> kNames = {"OcutimeStamp",
                                                         "cameraPosition.x",
                                                         "cameraPosition.y",
                                                         "cameraPosition.z",
                                                         "cameraRotation.x",
                                                         "cameraRotation.y",
                                                         "cameraRotation.z",
                                                         "cameraRotation.w",
                                                         "leftEyeDirection.x",
                                                         "rightEyeDirection.x",
                                                         "valL",
                                                         "valR"};
    const auto index = find_all(columns, kNames);
    if (!index || (*index)[8] + 3 > columns.count() || (*index)[9] + 3 > columns.count()) return std::nullopt;
    const auto read = [at = *index, count = columns.count()](Fields fields,
                                                             DeviceSample& sample) -> std::optional<std::string> {
        if (fields.size() != count) return "the row has another number of fields than the header";
        const auto time_us = parse_integer(fields[at[0]]);
        if (!time_us || std::abs(static_cast<double>(*time_us)) > 4e15) return "OcutimeStamp is not a time";
        std::array<float, 7> value{};
        for (std::size_t i = 0; i < value.size(); ++i) {
            const auto number = bounded(fields[at[1 + i]]);
            if (!number) return "the camera's pose is not a number";
            value[i] = *number;
        }
        const glm::quat q(value[6], value[3], value[4], value[5]);
        if (std::abs(glm::length(q) - 1.0F) > 1e-2F) return "the camera's quaternion is not of length 1";
        sample.time_ns = *time_us * 1000;
        sample.start_from_head = {from_unity(glm::normalize(q)), from_unity(glm::vec3(value[0], value[1], value[2]))};
        read_gaze(fields, at[8], fields[at[10]] == "True", sample.gaze[kLeftEye]);
        read_gaze(fields, at[9], fields[at[11]] == "True", sample.gaze[kRightEye]);
        return std::nullopt;
    };
    return RowLayout{"Salient360 scene", read, true};
}

void interpolate_held_poses(std::span<DeviceSample> samples) {
    const auto same = [](const Pose& a, const Pose& b) {
        return a.orientation == b.orientation && a.position_m == b.position_m;
    };
    std::size_t held = 0;  // where the pose of the current run first appeared
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (same(samples[i].start_from_head, samples[held].start_from_head)) continue;
        const Pose from = samples[held].start_from_head;
        const Pose to = samples[i].start_from_head;
        const std::int64_t end_ns = samples[i].time_ns;
        const std::int64_t begin_ns = std::max(samples[held].time_ns, end_ns - kLongestHold_ns);
        for (std::size_t j = held + 1; j < i; ++j) {
            if (samples[j].time_ns <= begin_ns) continue;
            const float t = static_cast<float>(samples[j].time_ns - begin_ns) / static_cast<float>(end_ns - begin_ns);
            samples[j].start_from_head = {glm::slerp(from.orientation, to.orientation, t),
                                          glm::mix(from.position_m, to.position_m, t)};
        }
        held = i;
    }
}

void move_to_start(std::span<DeviceSample> samples) {
    if (samples.empty()) return;
    const Pose first = samples.front().start_from_head;
    const glm::vec3 forward = first.direction(glm::vec3(0.0F, 0.0F, -1.0F));
    // Someone who looks straight up or down has no heading; the tracker's own is kept.
    const bool level = std::hypot(forward.x, forward.z) > 1e-3F;
    const float heading_rad = level ? std::atan2(-forward.x, -forward.z) : 0.0F;
    const Pose tracker_from_start{glm::angleAxis(heading_rad, glm::vec3(0.0F, 1.0F, 0.0F)), first.position_m};
    const Pose start_from_tracker = tracker_from_start.inverse();
    for (DeviceSample& sample : samples) sample.start_from_head = start_from_tracker * sample.start_from_head;
}

}  // namespace macula
