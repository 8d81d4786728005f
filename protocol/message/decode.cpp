#include <algorithm>
#include <cstdint>

#include <macula_generated.h>

#include "protocol/message/byte_map.h"
#include "protocol/message/limits.h"
#include "protocol/message/message.h"
#include "protocol/message/validate.h"

namespace macula {
namespace {

// A buffer may point to one text from many places. One byte, or one entry, more than any limit allows is enough for
// validate to refuse it, and keeps what is copied within a small multiple of the body.
std::string read(const flatbuffers::String* text) {
    return {text->c_str(), std::min<std::size_t>(text->size(), kMaxText_bytes + 1)};
}

std::vector<std::string> read(const flatbuffers::Vector<flatbuffers::Offset<flatbuffers::String>>* texts) {
    std::vector<std::string> result;
    const auto count = std::min<flatbuffers::uoffset_t>(texts->size(), kMaxCodecs + 1);
    for (flatbuffers::uoffset_t i = 0; i < count; ++i) result.push_back(read(texts->Get(i)));
    return result;
}

std::vector<std::uint8_t> read(const flatbuffers::Vector<std::uint8_t>* bytes) {
    return {bytes->begin(), bytes->end()};
}

glm::vec3 read(const wire::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

Pose read(const wire::Pose& pose) {
    const wire::Quat& q = pose.orientation();
    return {glm::quat(q.w(), q.x(), q.y(), q.z()), read(pose.position_m())};
}

GazeSample read(const wire::Gaze& gaze) {
    return {read(gaze.direction()), gaze.confidence()};
}

EyeDisplayMessage read(const wire::EyeDisplay& eye) {
    const wire::Tangents& t = *eye.tangents();
    EyeDisplayMessage result{{t.left(), t.right(), t.bottom(), t.top()}, read(*eye.head_from_eye()), {}};
    if (const auto* outline = eye.visible_outline()) {
        result.visible_outline.reserve(outline->size());
        for (const wire::Vec2* point : *outline) result.visible_outline.emplace_back(point->x(), point->y());
    }
    return result;
}

Hello read(const wire::Hello& hello) {
    Hello result;
    result.protocol_version = hello.protocol_version();
    result.client_name = read(hello.client_name());
    result.token = read(hello.token());
    result.display_name = read(hello.display_name());
    result.eye_width_px = hello.eye_width_px();
    result.eye_height_px = hello.eye_height_px();
    result.refresh_hz = hello.refresh_hz();
    result.eyes = {read(*hello.left()), read(*hello.right())};
    result.sampling = read(hello.sampling());
    result.codecs = read(hello.codecs());
    result.accumulates = hello.accumulates();
    return result;
}

Welcome read(const wire::Welcome& welcome) {
    Welcome result;
    result.protocol_version = welcome.protocol_version();
    result.server_name = read(welcome.server_name());
    result.scene_name = read(welcome.scene_name());
    result.codec = read(welcome.codec());
    result.sampling = read(welcome.sampling());
    result.renderer = read(welcome.renderer());
    result.rank_tile_size_px = welcome.rank_tile_size_px();
    result.rank_tile = read(welcome.rank_tile());
    result.world_from_start = read(*welcome.world_from_start());
    result.can_choose = welcome.can_choose();
    return result;
}

Track read(const wire::Track& track) {
    Track result;
    result.id = track.id();
    result.pose_time_ns = track.pose_time_ns();
    result.gaze_time_ns = track.gaze_time_ns();
    result.display_time_ns = track.display_time_ns();
    result.start_from_head = read(*track.start_from_head());
    result.linear_velocity_m_s = read(*track.linear_velocity_m_s());
    result.angular_velocity_rad_s = read(*track.angular_velocity_rad_s());
    result.gaze = {read(*track.left()), read(*track.right())};
    return result;
}

/// The tile counts are checked here because they bound what is allocated.
Expected<EyeSamplingMessage> read_sampling(const wire::EyeFrame& eye) {
    const auto good = [](int tiles) { return tiles >= 1 && tiles <= kMaxTilesAcross; };
    if (!good(eye.tiles_x()) || !good(eye.tiles_y())) {
        return fail(ErrorCode::protocol, "has " + std::to_string(eye.tiles_x()) + " x " +
                                             std::to_string(eye.tiles_y()) + " tiles, not 1.." +
                                             std::to_string(kMaxTilesAcross) + " each way");
    }
    const std::size_t count = static_cast<std::size_t>(eye.tiles_x()) * static_cast<std::size_t>(eye.tiles_y());
    Expected<std::vector<std::uint8_t>> level = unpack_map({eye.level()->data(), eye.level()->size()}, count);
    if (!level) return tl::unexpected(level.error());
    return EyeSamplingMessage{
        {eye.phase_x_px(), eye.phase_y_px()}, eye.tiles_x(), eye.tiles_y(), std::move(*level), eye.exact()};
}

glm::mat4x3 read(const wire::Affine& m) {
    return {read(m.x()), read(m.y()), read(m.z()), read(m.origin())};
}

std::vector<MovingObject> read(const flatbuffers::Vector<const wire::MovingObject*>* objects) {
    std::vector<MovingObject> result;
    if (objects == nullptr) return result;
    const auto count = std::min<std::size_t>(objects->size(), kMaxMovingObjects + 1);
    result.reserve(count);
    for (flatbuffers::uoffset_t i = 0; i < count; ++i) {
        const wire::MovingObject& object = *objects->Get(i);
        result.push_back({object.id(), read(object.world_from_object()), read(object.velocity_per_s())});
    }
    return result;
}

Expected<Frame> read(const wire::Frame& frame) {
    Frame result;
    result.id = frame.id();
    result.track_id = frame.track_id();
    result.pose_time_ns = frame.pose_time_ns();
    result.gaze_time_ns = frame.gaze_time_ns();
    result.display_time_ns = frame.display_time_ns();
    const PerEye<const wire::EyeFrame*> eyes = {frame.left(), frame.right()};
    for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
        result.world_from_eye[eye] = read(*eyes[eye]->world_from_eye());
        result.gaze[eye] = read(*eyes[eye]->gaze());
        Expected<EyeSamplingMessage> sampling = read_sampling(*eyes[eye]);
        if (!sampling) {
            return fail(sampling.error().code, "malformed message: Frame.eyes[" + std::to_string(eye) +
                                                   "].sampling.level " + sampling.error().message);
        }
        result.sampling[eye] = std::move(*sampling);
    }
    result.traced = frame.traced();
    result.near_m = frame.near_m();
    const wire::StageTimes& t = *frame.times();
    result.times = {t.track_received_ns(), t.begin_ns(),  t.plan_ns(), t.trace_ns(),
                    t.reconstruct_ns(),    t.encode_ns(), t.send_ns()};
    result.keyframe = frame.keyframe();
    result.color = read(frame.color());
    result.depth = read(frame.depth());
    result.moving = read(frame.moving());
    if (frame.moving_map() != nullptr) result.moving_map = read(frame.moving_map());
    result.choice = frame.choice();
    return result;
}

Expected<Message> read(const wire::Envelope& envelope) {
    switch (envelope.body_type()) {
        case wire::Body::Hello:
            return read(*envelope.body_as_Hello());
        case wire::Body::Welcome:
            return read(*envelope.body_as_Welcome());
        case wire::Body::Refused: {
            const wire::Refused& refused = *envelope.body_as_Refused();
            return Refused{refused.protocol_version(), read(refused.reason())};
        }
        case wire::Body::Track:
            return read(*envelope.body_as_Track());
        case wire::Body::Frame:
            return read(*envelope.body_as_Frame());
        case wire::Body::FrameReport: {
            const wire::FrameReport& report = *envelope.body_as_FrameReport();
            return FrameReport{report.frame_id(), report.received_ns(), report.decoded_ns(), report.displayed_ns(),
                               report.decode_failed()};
        }
        case wire::Body::Ping:
            return Ping{envelope.body_as_Ping()->sent_ns()};
        case wire::Body::Pong: {
            const wire::Pong& pong = *envelope.body_as_Pong();
            return Pong{pong.ping_sent_ns(), pong.answered_ns()};
        }
        case wire::Body::Bye:
            return Bye{read(envelope.body_as_Bye()->reason())};
        case wire::Body::Choose: {
            const wire::Choose& choose = *envelope.body_as_Choose();
            return Choose{choose.id(), read(choose.sampling()), choose.only_prepare()};
        }
        case wire::Body::Chosen: {
            const wire::Chosen& chosen = *envelope.body_as_Chosen();
            return Chosen{chosen.id(), read(chosen.problem())};
        }
        case wire::Body::NONE:
            break;
    }
    return fail(ErrorCode::protocol,
                "malformed message: unknown kind " + std::to_string(static_cast<int>(envelope.body_type())));
}

Expected<Message> decode_aligned(std::span<const std::byte> body) {
    // Four tables nested three deep are the most that this version has; a later one may have more.
    constexpr flatbuffers::uoffset_t kMaxDepth = 16;
    constexpr flatbuffers::uoffset_t kMaxTables = 64;
    const auto* data = reinterpret_cast<const std::uint8_t*>(body.data());
    flatbuffers::Verifier verifier(data, body.size(), kMaxDepth, kMaxTables);
    if (!wire::VerifyEnvelopeBuffer(verifier)) {
        return fail(ErrorCode::protocol,
                    "malformed message: " + std::to_string(body.size()) + " bytes that do not follow the schema");
    }
    Expected<Message> message = read(*wire::GetEnvelope(data));
    if (!message) return message;
    if (const Expected<void> valid = validate(*message); !valid) return tl::unexpected(valid.error());
    return message;
}

}  // namespace

Expected<Message> decode_message(std::span<const std::byte> body) {
    if (body.size() > kMaxServerMessage_bytes) {
        return fail(ErrorCode::protocol, "malformed message: " + std::to_string(body.size()) + " bytes, more than " +
                                             std::to_string(kMaxServerMessage_bytes));
    }
    constexpr std::uintptr_t kAlignment = alignof(std::uint64_t);
    if (reinterpret_cast<std::uintptr_t>(body.data()) % kAlignment == 0) return decode_aligned(body);
    return decode_aligned(Bytes(body.begin(), body.end()));
}

}  // namespace macula
