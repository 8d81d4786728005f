// Whatever a sender may say within the limits arrives as it was said.

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/random_messages.h"

namespace macula {
namespace {

// Bindings, so that a field that is added to a message must be added here.

template <class T>
bool same(const T& a, const T& b) {
    return a == b;
}

/// Decoding normalises, which may move the last digits.
bool same_direction(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-6F;
}

bool same(const Pose& a, const Pose& b) {
    const auto& [orientation, position_m] = a;
    return glm::length(orientation - b.orientation) < 1e-6F && position_m == b.position_m;
}

bool same(const GazeSample& a, const GazeSample& b) {
    const auto& [direction, confidence] = a;
    return same_direction(direction, b.direction) && confidence == b.confidence;
}

bool same(const EyeDisplayMessage& a, const EyeDisplayMessage& b) {
    const auto& [tangents, head_from_eye, visible_outline] = a;
    const auto& [left, right, bottom, top] = tangents;
    const Tangents& t = b.tangents;
    return std::tie(left, right, bottom, top) == std::tie(t.left, t.right, t.bottom, t.top) &&
           same(head_from_eye, b.head_from_eye) && visible_outline == b.visible_outline;
}

bool same(const EyeSamplingMessage& a, const EyeSamplingMessage& b) {
    const auto& [phase_px, tiles_x, tiles_y, level, exact] = a;
    return std::tie(phase_px, tiles_x, tiles_y, level, exact) ==
           std::tie(b.phase_px, b.tiles_x, b.tiles_y, b.level, b.exact);
}

template <class T>
bool same(const PerEye<T>& a, const PerEye<T>& b) {
    return same(a[kLeftEye], b[kLeftEye]) && same(a[kRightEye], b[kRightEye]);
}

bool same(const StageTimes& a, const StageTimes& b) {
    const auto& [track_received_ns, begin_ns, plan_ns, trace_ns, reconstruct_ns, encode_ns, send_ns] = a;
    return std::tie(track_received_ns, begin_ns, plan_ns, trace_ns, reconstruct_ns, encode_ns, send_ns) ==
           std::tie(b.track_received_ns, b.begin_ns, b.plan_ns, b.trace_ns, b.reconstruct_ns, b.encode_ns, b.send_ns);
}

bool same(const Hello& a, const Hello& b) {
    const auto& [version, client, token, display, width_px, height_px, refresh_hz, eyes, sampling, codecs,
                 accumulates] = a;
    return std::tie(version, client, token, display, width_px, height_px, refresh_hz, sampling, codecs, accumulates) ==
               std::tie(b.protocol_version, b.client_name, b.token, b.display_name, b.eye_width_px, b.eye_height_px,
                        b.refresh_hz, b.sampling, b.codecs, b.accumulates) &&
           same(eyes, b.eyes);
}

bool same(const Welcome& a, const Welcome& b) {
    const auto& [version, server, scene, codec, sampling, renderer, size_px, tile, world_from_start, can_choose] = a;
    return std::tie(version, server, scene, codec, sampling, renderer, size_px, tile, can_choose) ==
               std::tie(b.protocol_version, b.server_name, b.scene_name, b.codec, b.sampling, b.renderer,
                        b.rank_tile_size_px, b.rank_tile, b.can_choose) &&
           same(world_from_start, b.world_from_start);
}

bool same(const Refused& a, const Refused& b) {
    const auto& [version, reason] = a;
    return std::tie(version, reason) == std::tie(b.protocol_version, b.reason);
}

bool same(const Track& a, const Track& b) {
    const auto& [id, pose_ns, gaze_ns, display_ns, start_from_head, linear, angular, gaze] = a;
    return std::tie(id, pose_ns, gaze_ns, display_ns, linear, angular) ==
               std::tie(b.id, b.pose_time_ns, b.gaze_time_ns, b.display_time_ns, b.linear_velocity_m_s,
                        b.angular_velocity_rad_s) &&
           same(start_from_head, b.start_from_head) && same(gaze, b.gaze);
}

bool same(const MovingObject& a, const MovingObject& b) {
    const auto& [id, world_from_object, velocity_per_s] = a;
    return std::tie(id, world_from_object, velocity_per_s) == std::tie(b.id, b.world_from_object, b.velocity_per_s);
}

bool same(const Frame& a, const Frame& b) {
    const auto& [id, track_id, pose_ns, gaze_ns, display_ns, world_from_eye, gaze, sampling, traced, near_m, times,
                 keyframe, color, depth, moving, moving_map, choice] = a;
    return std::tie(id, track_id, pose_ns, gaze_ns, display_ns, traced, near_m, keyframe, color, depth, moving_map,
                    choice) == std::tie(b.id, b.track_id, b.pose_time_ns, b.gaze_time_ns, b.display_time_ns, b.traced,
                                        b.near_m, b.keyframe, b.color, b.depth, b.moving_map, b.choice) &&
           std::ranges::equal(moving, b.moving, [](const auto& x, const auto& y) { return same(x, y); }) &&
           same(world_from_eye, b.world_from_eye) && same_direction(gaze[kLeftEye], b.gaze[kLeftEye]) &&
           same_direction(gaze[kRightEye], b.gaze[kRightEye]) && same(sampling, b.sampling) && same(times, b.times);
}

bool same(const FrameReport& a, const FrameReport& b) {
    const auto& [frame_id, received_ns, decoded_ns, displayed_ns, decode_failed] = a;
    return std::tie(frame_id, received_ns, decoded_ns, displayed_ns, decode_failed) ==
           std::tie(b.frame_id, b.received_ns, b.decoded_ns, b.displayed_ns, b.decode_failed);
}

bool same(const Ping& a, const Ping& b) {
    const auto& [sent_ns] = a;
    return sent_ns == b.sent_ns;
}

bool same(const Pong& a, const Pong& b) {
    const auto& [ping_sent_ns, answered_ns] = a;
    return std::tie(ping_sent_ns, answered_ns) == std::tie(b.ping_sent_ns, b.answered_ns);
}

bool same(const Bye& a, const Bye& b) {
    const auto& [reason] = a;
    return reason == b.reason;
}

bool same(const Choose& a, const Choose& b) {
    const auto& [id, sampling, only_prepare] = a;
    return std::tie(id, sampling, only_prepare) == std::tie(b.id, b.sampling, b.only_prepare);
}

bool same(const Chosen& a, const Chosen& b) {
    const auto& [id, problem] = a;
    return std::tie(id, problem) == std::tie(b.id, b.problem);
}

bool same(const Message& a, const Message& b) {
    return a.index() == b.index() &&
           std::visit([&b](const auto& body) { return same(body, std::get<std::decay_t<decltype(body)>>(b)); }, a);
}

/// MACULA_SEED repeats a run.
unsigned seed() {
    const char* chosen = std::getenv("MACULA_SEED");
    return chosen != nullptr ? static_cast<unsigned>(std::strtoul(chosen, nullptr, 10)) : std::random_device{}();
}

class MessageRoundTrip : public testing::TestWithParam<std::size_t> {};

TEST_P(MessageRoundTrip, KeepsEveryField) {
    const unsigned chosen = seed();
    RecordProperty("seed", std::to_string(chosen));
    SCOPED_TRACE("MACULA_SEED=" + std::to_string(chosen));
    std::mt19937 random(chosen);
    for (int i = 0; i < 50; ++i) {
        const Message message = random_message(GetParam(), random);
        const Bytes body = encode_message(message);
        const Expected<Message> decoded = decode_message(body);
        ASSERT_TRUE(decoded) << "message " << i << ": " << decoded.error().message;
        ASSERT_TRUE(same(message, *decoded)) << "message " << i;
        EXPECT_LE(body.size(), kMaxServerMessage_bytes);
        // The largest Hello and the other messages of clients pass the server's limit.
        if (GetParam() != 1 && GetParam() != 4) {
            EXPECT_LE(body.size(), kMaxClientMessage_bytes);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, MessageRoundTrip, testing::Range(std::size_t{0}, kMessageKinds));

}  // namespace
}  // namespace macula
