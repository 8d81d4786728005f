#include <macula_generated.h>

#include "protocol/message/byte_map.h"
#include "protocol/message/message.h"

namespace macula {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

wire::Vec3 to_wire(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

wire::Pose to_wire(const Pose& pose) {
    const glm::quat& q = pose.orientation;
    return {wire::Quat(q.x, q.y, q.z, q.w), to_wire(pose.position_m)};
}

wire::Gaze to_wire(const GazeSample& gaze) {
    return {to_wire(gaze.direction), gaze.confidence};
}

Offset<wire::EyeDisplay> write(FlatBufferBuilder& builder, const EyeDisplayMessage& eye) {
    const wire::Tangents tangents(eye.tangents.left, eye.tangents.right, eye.tangents.bottom, eye.tangents.top);
    const wire::Pose head_from_eye = to_wire(eye.head_from_eye);
    std::vector<wire::Vec2> outline;
    outline.reserve(eye.visible_outline.size());
    for (const glm::vec2& point : eye.visible_outline) outline.emplace_back(point.x, point.y);
    return wire::CreateEyeDisplay(builder, &tangents, &head_from_eye, builder.CreateVectorOfStructs(outline));
}

Offset<wire::Hello> write(FlatBufferBuilder& builder, const Hello& hello) {
    const auto client_name = builder.CreateString(hello.client_name);
    const auto token = builder.CreateString(hello.token);
    const auto display_name = builder.CreateString(hello.display_name);
    const auto left = write(builder, hello.eyes[kLeftEye]);
    const auto right = write(builder, hello.eyes[kRightEye]);
    const auto sampling = builder.CreateString(hello.sampling);
    const auto codecs = builder.CreateVectorOfStrings(hello.codecs);
    return wire::CreateHello(builder, hello.protocol_version, client_name, token, display_name, hello.eye_width_px,
                             hello.eye_height_px, hello.refresh_hz, left, right, sampling, codecs, hello.accumulates);
}

Offset<wire::Welcome> write(FlatBufferBuilder& builder, const Welcome& welcome) {
    const auto server_name = builder.CreateString(welcome.server_name);
    const auto scene_name = builder.CreateString(welcome.scene_name);
    const auto codec = builder.CreateString(welcome.codec);
    const auto sampling = builder.CreateString(welcome.sampling);
    const auto renderer = builder.CreateString(welcome.renderer);
    const auto rank_tile = builder.CreateVector(welcome.rank_tile);
    const wire::Pose world_from_start = to_wire(welcome.world_from_start);
    return wire::CreateWelcome(builder, welcome.protocol_version, server_name, scene_name, codec, sampling, renderer,
                               welcome.rank_tile_size_px, rank_tile, &world_from_start, welcome.can_choose);
}

Offset<wire::Refused> write(FlatBufferBuilder& builder, const Refused& refused) {
    return wire::CreateRefused(builder, refused.protocol_version, builder.CreateString(refused.reason));
}

Offset<wire::Track> write(FlatBufferBuilder& builder, const Track& track) {
    const wire::Pose start_from_head = to_wire(track.start_from_head);
    const wire::Vec3 linear = to_wire(track.linear_velocity_m_s);
    const wire::Vec3 angular = to_wire(track.angular_velocity_rad_s);
    const wire::Gaze left = to_wire(track.gaze[kLeftEye]);
    const wire::Gaze right = to_wire(track.gaze[kRightEye]);
    return wire::CreateTrack(builder, track.id, track.pose_time_ns, track.gaze_time_ns, track.display_time_ns,
                             &start_from_head, &linear, &angular, &left, &right);
}

Offset<wire::EyeFrame> write_eye(FlatBufferBuilder& builder, const Frame& frame, Eye eye) {
    const wire::Pose world_from_eye = to_wire(frame.world_from_eye[eye]);
    const wire::Vec3 gaze = to_wire(frame.gaze[eye]);
    const EyeSamplingMessage& sampling = frame.sampling[eye];
    const auto level = builder.CreateVector(pack_map(sampling.level));
    return wire::CreateEyeFrame(builder, &world_from_eye, &gaze, sampling.phase_px.x, sampling.phase_px.y,
                                sampling.tiles_x, sampling.tiles_y, level, sampling.exact);
}

wire::Affine to_wire(const glm::mat4x3& m) {
    return {to_wire(m[0]), to_wire(m[1]), to_wire(m[2]), to_wire(m[3])};
}

/// Null where nothing moves: the frame of a still scene carries no byte of it.
Offset<flatbuffers::Vector<const wire::MovingObject*>> write(FlatBufferBuilder& builder,
                                                             const std::vector<MovingObject>& objects) {
    if (objects.empty()) return {};
    std::vector<wire::MovingObject> moving;
    moving.reserve(objects.size());
    for (const MovingObject& object : objects) {
        moving.emplace_back(object.id, to_wire(object.world_from_object), to_wire(object.velocity_per_s));
    }
    return builder.CreateVectorOfStructs(moving);
}

Offset<wire::Frame> write(FlatBufferBuilder& builder, const Frame& frame) {
    const auto color = builder.CreateVector(frame.color);
    const auto depth = builder.CreateVector(frame.depth);
    const auto left = write_eye(builder, frame, kLeftEye);
    const auto right = write_eye(builder, frame, kRightEye);
    const StageTimes& t = frame.times;
    const wire::StageTimes times(t.track_received_ns, t.begin_ns, t.plan_ns, t.trace_ns, t.reconstruct_ns, t.encode_ns,
                                 t.send_ns);
    const auto moving = write(builder, frame.moving);
    const auto moving_map =
        frame.moving_map.empty() ? Offset<flatbuffers::Vector<std::uint8_t>>() : builder.CreateVector(frame.moving_map);
    return wire::CreateFrame(builder, frame.id, frame.track_id, frame.pose_time_ns, frame.gaze_time_ns,
                             frame.display_time_ns, left, right, frame.traced, frame.near_m, &times, frame.keyframe,
                             color, depth, moving, moving_map, frame.choice);
}

Offset<wire::FrameReport> write(FlatBufferBuilder& builder, const FrameReport& report) {
    return wire::CreateFrameReport(builder, report.frame_id, report.received_ns, report.decoded_ns, report.displayed_ns,
                                   report.decode_failed);
}

Offset<wire::Ping> write(FlatBufferBuilder& builder, const Ping& ping) {
    return wire::CreatePing(builder, ping.sent_ns);
}

Offset<wire::Pong> write(FlatBufferBuilder& builder, const Pong& pong) {
    return wire::CreatePong(builder, pong.ping_sent_ns, pong.answered_ns);
}

Offset<wire::Bye> write(FlatBufferBuilder& builder, const Bye& bye) {
    return wire::CreateBye(builder, builder.CreateString(bye.reason));
}

Offset<wire::Choose> write(FlatBufferBuilder& builder, const Choose& choose) {
    return wire::CreateChoose(builder, choose.id, builder.CreateString(choose.sampling), choose.only_prepare);
}

Offset<wire::Chosen> write(FlatBufferBuilder& builder, const Chosen& chosen) {
    return wire::CreateChosen(builder, chosen.id, builder.CreateString(chosen.problem));
}

template <class Table>
Offset<wire::Envelope> envelope(FlatBufferBuilder& builder, Offset<Table> body) {
    return wire::CreateEnvelope(builder, wire::BodyTraits<Table>::enum_value, body.Union());
}

/// First capacity of the builder, which otherwise starts at a kilobyte and copies itself each time it doubles.
std::size_t expected_size(const Message& message) {
    constexpr std::size_t kWithoutPictures = std::size_t{8} << 10;
    const auto* frame = std::get_if<Frame>(&message);
    if (frame == nullptr) return kWithoutPictures / 8;
    return frame->color.size() + frame->depth.size() + frame->moving.size() * sizeof(wire::MovingObject) +
           frame->moving_map.size() + kWithoutPictures;
}

}  // namespace

Bytes encode_message(const Message& message) {
    FlatBufferBuilder builder(expected_size(message));
    const auto root =
        std::visit([&builder](const auto& body) { return envelope(builder, write(builder, body)); }, message);
    wire::FinishEnvelopeBuffer(builder, root);
    const auto* begin = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
    return {begin, begin + builder.GetSize()};
}

}  // namespace macula
