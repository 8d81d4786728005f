#include "tests/support/peer.h"

#include <gtest/gtest.h>

#include "protocol/base/clock.h"

namespace macula::testing {

Hello small_hello(const std::string& token) {
    Hello hello;
    hello.client_name = "scripted peer";
    hello.token = token;
    hello.display_name = "small";
    hello.eye_width_px = 128;
    hello.eye_height_px = 128;
    hello.refresh_hz = 500.0F;
    hello.eyes[kLeftEye].head_from_eye.position_m = {-0.032F, 0.0F, 0.0F};
    hello.eyes[kRightEye].head_from_eye.position_m = {0.032F, 0.0F, 0.0F};
    hello.codecs = {"h264"};
    return hello;
}

Peer::Peer(std::uint16_t port, const Credentials& credentials) : credentials_(credentials) {
    auto channel = connect("127.0.0.1", port, credentials.fingerprint, kPatience);
    EXPECT_TRUE(channel) << channel.error().message;
    if (channel) channel_ = *std::move(channel);
}

void Peer::send(const Message& message) {
    // The server may have closed already; what counts is what receive() sees.
    static_cast<void>(channel_->send(encode_message(message), kPatience));
}

std::optional<Message> Peer::receive(std::chrono::milliseconds timeout) {
    const auto body = channel_->receive(timeout);
    if (!body) return std::nullopt;
    auto message = decode_message(*body);
    EXPECT_TRUE(message) << message.error().message;
    return message ? std::optional<Message>(*std::move(message)) : std::nullopt;
}

std::optional<Welcome> Peer::greet() {
    send(small_hello(credentials_.token));
    return expect<Welcome>();
}

std::uint64_t Peer::send_track() {
    Track track;
    track.id = ++tracks_;
    track.pose_time_ns = now_ns();
    track.gaze_time_ns = track.pose_time_ns;
    track.display_time_ns = track.pose_time_ns + 20'000'000;
    send(track);
    return track.id;
}

std::optional<Frame> Peer::next_frame() {
    send_track();
    auto frame = expect<Frame>();
    if (frame) {
        const std::int64_t now = now_ns();
        send(FrameReport{frame->id, now, now, now, false});
    }
    return frame;
}

bool Peer::wait_for_end() {
    for (;;) {
        const auto body = channel_->receive(kPatience);
        if (!body) return body.error().code == ErrorCode::network;
    }
}

void Peer::complain(const std::optional<Message>& message) {
    if (!message) {
        ADD_FAILURE() << "no message came";
    } else if (const auto* refused = std::get_if<Refused>(&*message)) {
        ADD_FAILURE() << "refused: " << refused->reason;
    } else if (const auto* bye = std::get_if<Bye>(&*message)) {
        ADD_FAILURE() << "bye: " << bye->reason;
    } else {
        ADD_FAILURE() << "another message came, alternative " << message->index();
    }
}

}  // namespace macula::testing
