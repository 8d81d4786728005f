#include "protocol/message/validate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <glm/geometric.hpp>

#include "protocol/message/limits.h"

namespace macula {
namespace {

/// Remembers the first field that is wrong.
class Check {
public:
    /// Fields checked from here on lie in `prefix`, such as "Track.".
    void in(std::string prefix) { prefix_ = std::move(prefix); }

    void that(bool good, std::string_view field, const std::string& problem) {
        if (!good && !problem_) problem_ = prefix_ + std::string(field) + " " + problem;
    }
    template <class Number>
    void range(Number value, Number low, Number high, std::string_view field) {
        if (value >= low && value <= high) return;  // NaN does not get past this
        that(false, field,
             "is " + std::to_string(value) + ", not in " + std::to_string(low) + ".." + std::to_string(high));
    }
    void number(float value, float low, float high, std::string_view field) { range(value, low, high, field); }
    void integer(std::int64_t value, std::int64_t low, std::int64_t high, std::string_view field) {
        range(value, low, high, field);
    }
    void time(std::int64_t value_ns, std::string_view field) { integer(value_ns, -kMaxTime_ns, kMaxTime_ns, field); }

    /// One line: these texts go to logs and terminals.
    void text(const std::string& value, std::size_t max_bytes, std::string_view field) {
        that(value.size() <= max_bytes, field, "has more than " + std::to_string(max_bytes) + " bytes");
        const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
        that(std::none_of(value.begin(), value.end(), is_control), field, "holds control characters");
    }
    void vector(const glm::vec3& value, std::string_view field) {
        for (int i = 0; i < 3; ++i) number(value[i], -kMaxMagnitude, kMaxMagnitude, field);
    }
    template <class T>
    void unit(T& value, std::string_view field) {
        const float length = std::sqrt(glm::dot(value, value));
        if (std::abs(length - 1.0F) <= kUnitTolerance) {
            value /= length;
        } else {
            that(false, field, "has length " + std::to_string(length) + ", not 1");
        }
    }
    void pose(Pose& value, std::string_view field) {
        unit(value.orientation, field);
        vector(value.position_m, field);
    }

    [[nodiscard]] Expected<void> result() const {
        if (problem_) return fail(ErrorCode::protocol, "malformed message: " + *problem_);
        return {};
    }

private:
    std::string prefix_;
    std::optional<std::string> problem_;
};

std::string eye_prefix(const char* message, std::size_t eye) {
    return std::string(message) + ".eyes[" + std::to_string(eye) + "].";
}

void check_edge(Check& check, int edge_px, std::string_view field) {
    check.integer(edge_px, kMinEyeEdge_px, kMaxEyeEdge_px, field);
    check.that(edge_px % kEyeEdgeStep_px == 0, field, "is not a multiple of " + std::to_string(kEyeEdgeStep_px));
}

void check_eye(Check& check, EyeDisplayMessage& eye) {
    for (const float tangent : {eye.tangents.left, eye.tangents.right, eye.tangents.bottom, eye.tangents.top}) {
        check.number(tangent, -kMaxTangent, kMaxTangent, "tangents");
    }
    check.that(eye.tangents.left < eye.tangents.right, "tangents", "has left not below right");
    check.that(eye.tangents.bottom < eye.tangents.top, "tangents", "has bottom not below top");
    check.pose(eye.head_from_eye, "head_from_eye");
    const std::size_t points = eye.visible_outline.size();
    check.that(points == 0 || (points >= 3 && points <= kMaxOutlinePoints), "visible_outline",
               "has " + std::to_string(points) + " points, not 0 or 3.." + std::to_string(kMaxOutlinePoints));
    for (const glm::vec2& point : eye.visible_outline) {
        for (int i = 0; i < 2; ++i) check.number(point[i], -kMaxTangent, kMaxTangent, "visible_outline");
    }
}

void check_message(Check& check, Hello& hello) {
    check.in("Hello.");
    check.text(hello.client_name, kMaxName_bytes, "client_name");
    if (hello.protocol_version != kProtocolVersion) return;
    check.text(hello.token, kMaxToken_bytes, "token");
    check.text(hello.display_name, kMaxName_bytes, "display_name");
    check_edge(check, hello.eye_width_px, "eye_width_px");
    check_edge(check, hello.eye_height_px, "eye_height_px");
    check.number(hello.refresh_hz, kMinRefresh_hz, kMaxRefresh_hz, "refresh_hz");
    check.text(hello.sampling, kMaxName_bytes, "sampling");
    check.that(hello.codecs.size() <= kMaxCodecs, "codecs", "has more than " + std::to_string(kMaxCodecs) + " entries");
    for (const std::string& codec : hello.codecs) check.text(codec, kMaxName_bytes, "codecs");
    for (std::size_t eye = 0; eye < hello.eyes.size(); ++eye) {
        check.in(eye_prefix("Hello", eye));
        check_eye(check, hello.eyes[eye]);
    }
}

void check_message(Check& check, Welcome& welcome) {
    check.in("Welcome.");
    check.text(welcome.server_name, kMaxName_bytes, "server_name");
    check.text(welcome.scene_name, kMaxText_bytes, "scene_name");
    check.text(welcome.codec, kMaxName_bytes, "codec");
    check.text(welcome.sampling, kMaxName_bytes, "sampling");
    check.text(welcome.renderer, kMaxText_bytes, "renderer");
    const int edge_px = welcome.rank_tile_size_px;
    check.integer(edge_px, kRankTileStep_px, kMaxRankTile_px, "rank_tile_size_px");
    check.that(edge_px % kRankTileStep_px == 0, "rank_tile_size_px",
               "is not a multiple of " + std::to_string(kRankTileStep_px));
    check.that(welcome.rank_tile.size() == static_cast<std::size_t>(std::int64_t{edge_px} * edge_px), "rank_tile",
               "has " + std::to_string(welcome.rank_tile.size()) + " entries, not the square of rank_tile_size_px");
    check.pose(welcome.world_from_start, "world_from_start");
}

void check_message(Check& check, Refused& refused) {
    check.in("Refused.");
    check.text(refused.reason, kMaxText_bytes, "reason");
}

void check_message(Check& check, Track& track) {
    check.in("Track.");
    check.time(track.pose_time_ns, "pose_time_ns");
    check.time(track.gaze_time_ns, "gaze_time_ns");
    check.time(track.display_time_ns, "display_time_ns");
    check.pose(track.start_from_head, "start_from_head");
    check.vector(track.linear_velocity_m_s, "linear_velocity_m_s");
    check.vector(track.angular_velocity_rad_s, "angular_velocity_rad_s");
    for (std::size_t eye = 0; eye < track.gaze.size(); ++eye) {
        check.in(eye_prefix("Track", eye));
        check.unit(track.gaze[eye].direction, "gaze.direction");
        check.number(track.gaze[eye].confidence, 0.0F, 1.0F, "gaze.confidence");
    }
}

void check_sampling(Check& check, const EyeSamplingMessage& sampling) {
    check.integer(sampling.phase_px.x, 0, kMaxRankTile_px - 1, "sampling.phase_px.x");
    check.integer(sampling.phase_px.y, 0, kMaxRankTile_px - 1, "sampling.phase_px.y");
    check.integer(sampling.tiles_x, 1, kMaxTilesAcross, "sampling.tiles_x");
    check.integer(sampling.tiles_y, 1, kMaxTilesAcross, "sampling.tiles_y");
    check.that(sampling.level.size() == static_cast<std::size_t>(std::int64_t{sampling.tiles_x} * sampling.tiles_y),
               "sampling.level",
               "has " + std::to_string(sampling.level.size()) + " entries, not one for each of the tiles");
    std::uint8_t densest = 0;
    for (const std::uint8_t level : sampling.level) densest = std::max(densest, level);
    check.integer(densest, 0, kMaxLevel, "sampling.level");
}

void check_moving(Check& check, const Frame& frame) {
    const std::size_t count = frame.moving.size();
    check.that(count <= kMaxMovingObjects, "moving", "has more than " + std::to_string(kMaxMovingObjects) + " objects");
    check.that(frame.moving_map.empty() == frame.moving.empty(), "moving_map",
               "is there without moving, or not with it");
    std::vector<std::uint32_t> ids;
    ids.reserve(count);
    for (const MovingObject& object : frame.moving) {
        ids.push_back(object.id);
        for (int column = 0; column < 4; ++column) {
            check.vector(object.world_from_object[column], "moving.world_from_object");
            check.vector(object.velocity_per_s[column], "moving.velocity_per_s");
        }
    }
    std::ranges::sort(ids);
    check.that(std::ranges::adjacent_find(ids) == ids.end(), "moving.id", "is not unique");
}

void check_message(Check& check, Frame& frame) {
    check.in("Frame.");
    check.time(frame.pose_time_ns, "pose_time_ns");
    check.time(frame.gaze_time_ns, "gaze_time_ns");
    check.time(frame.display_time_ns, "display_time_ns");
    check.integer(frame.traced, 0, kMaxTraced, "traced");
    check.number(frame.near_m, kMinNear_m, kMaxNear_m, "near_m");
    const StageTimes& times = frame.times;
    for (const std::int64_t time_ns : {times.track_received_ns, times.begin_ns, times.plan_ns, times.trace_ns,
                                       times.reconstruct_ns, times.encode_ns, times.send_ns}) {
        check.time(time_ns, "times");
    }
    check_moving(check, frame);
    for (std::size_t eye = 0; eye < frame.sampling.size(); ++eye) {
        check.in(eye_prefix("Frame", eye));
        check.pose(frame.world_from_eye[eye], "world_from_eye");
        check.unit(frame.gaze[eye], "gaze");
        check_sampling(check, frame.sampling[eye]);
    }
}

void check_message(Check& check, FrameReport& report) {
    check.in("FrameReport.");
    check.time(report.received_ns, "received_ns");
    check.time(report.decoded_ns, "decoded_ns");
    check.time(report.displayed_ns, "displayed_ns");
}

void check_message(Check& check, Ping& ping) {
    check.in("Ping.");
    check.time(ping.sent_ns, "sent_ns");
}

void check_message(Check& check, Pong& pong) {
    check.in("Pong.");
    check.time(pong.ping_sent_ns, "ping_sent_ns");
    check.time(pong.answered_ns, "answered_ns");
}

void check_message(Check& check, Bye& bye) {
    check.in("Bye.");
    check.text(bye.reason, kMaxText_bytes, "reason");
}

void check_message(Check& check, Choose& choose) {
    check.in("Choose.");
    check.that(choose.id > 0, "id", "is 0, which stands for the sampling of Hello");
    check.text(choose.sampling, kMaxName_bytes, "sampling");
    check.that(!choose.sampling.empty(), "sampling", "is empty");
}

void check_message(Check& check, Chosen& chosen) {
    check.in("Chosen.");
    check.text(chosen.problem, kMaxText_bytes, "problem");
}

}  // namespace

Expected<void> validate(Message& message) {
    Check check;
    std::visit([&check](auto& body) { check_message(check, body); }, message);
    return check.result();
}

}  // namespace macula
