#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/base/clock.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "protocol/message/message.h"
#include "tests/support/memory_channel.h"

namespace macula::testing {

/// Server's side of one connection, for a script that plays the server.
class FakeConnection {
public:
    static constexpr int kEye_px = 64;

    FakeConnection(std::unique_ptr<Channel> channel, std::int64_t clock_ahead_ns)
        : channel_(std::move(channel)), clock_ahead_ns_(clock_ahead_ns) {
        VideoEncoderOptions color;
        color.width_px = 2 * kEye_px;
        color.height_px = kEye_px;
        color.threads = 1;
        color_ = *make_video_encoder(color);
        depth_ = *make_depth_encoder({2 * kEye_px, kEye_px, 90.0, 1});
    }

    [[nodiscard]] std::int64_t clock_ns() const { return now_ns() + clock_ahead_ns_; }

    void send(const Message& message) { static_cast<void>(channel_->send(encode_message(message), kWait)); }
    void send_raw(const Bytes& body) { static_cast<void>(channel_->send(body, kWait)); }

    /// Next message that is not a Ping, which is answered; nothing when the connection or the patience ends.
    std::optional<Message> receive(std::chrono::milliseconds patience = std::chrono::milliseconds(5'000)) {
        const std::int64_t end_ns = now_ns() + patience.count() * 1'000'000;
        while (now_ns() < end_ns) {
            auto body = channel_->receive(std::chrono::milliseconds(10));
            if (!body && body.error().code == ErrorCode::timeout) continue;
            if (!body) return std::nullopt;
            auto message = decode_message(*body);
            if (!message) return std::nullopt;
            const auto* ping = std::get_if<Ping>(&*message);
            if (ping == nullptr) return std::move(*message);
            send(Pong{ping->sent_ns, clock_ns()});
        }
        return std::nullopt;
    }

    /// Next message of one kind; others are skipped.
    template <class T>
    std::optional<T> expect(std::chrono::milliseconds patience = std::chrono::milliseconds(5'000)) {
        while (auto message = receive(patience)) {
            if (auto* wanted = std::get_if<T>(&*message)) return std::move(*wanted);
        }
        return std::nullopt;
    }

    /// Receives Hello and answers Welcome.
    std::optional<Hello> welcome() {
        auto hello = expect<Hello>();
        Welcome answer;
        answer.server_name = "fake";
        answer.scene_name = "grey";
        answer.codec = "h264";
        answer.sampling = "27";
        answer.renderer = "none";
        answer.rank_tile_size_px = 16;
        for (int i = 0; i < 256; ++i) answer.rank_tile.push_back(static_cast<std::uint8_t>(i));
        send(answer);
        return hello;
    }

    /// A frame of one grey, all of it traced, at 1/m = .5.
    Frame make_frame(std::uint64_t id, std::uint8_t grey, bool keyframe) {
        Frame frame;
        frame.id = id;
        frame.near_m = 1.0F;
        frame.traced = 2 * kEye_px * kEye_px;
        for (EyeSamplingMessage& eye : frame.sampling) {
            eye.tiles_x = eye.tiles_y = kEye_px / 16;
            eye.level.assign(16, 21);
        }
        for (glm::vec3& gaze : frame.gaze) gaze = glm::vec3(0.0F, 0.0F, -1.0F);
        frame.times.track_received_ns = frame.times.send_ns = clock_ns();
        const Rgba8 color = 0xFF000000U | grey * 0x010101U;
        const auto colors = color_->encode(ColorImage(2 * kEye_px, kEye_px, color), keyframe);
        const auto depths = depth_->encode(InverseDepthImage(2 * kEye_px, kEye_px, 0.5F), frame.near_m, keyframe);
        frame.color = colors->bytes;
        frame.depth = depths->bytes;
        frame.keyframe = colors->keyframe && depths->keyframe;
        return frame;
    }

    void close() { channel_->close(); }

private:
    static constexpr std::chrono::milliseconds kWait{5'000};
    std::unique_ptr<Channel> channel_;
    std::int64_t clock_ahead_ns_;
    std::unique_ptr<VideoEncoder> color_;
    std::unique_ptr<DepthEncoder> depth_;
};

/// Plays one script for each connection, in order; when they are used up, nobody answers any more.
class FakeServer {
public:
    using Script = std::function<void(FakeConnection& connection)>;

    explicit FakeServer(std::vector<Script> scripts, std::int64_t clock_ahead_ns = 0)
        : scripts_(std::move(scripts)), clock_ahead_ns_(clock_ahead_ns) {}
    FakeServer(const FakeServer&) = delete;
    FakeServer& operator=(const FakeServer&) = delete;
    ~FakeServer() {
        for (std::thread& thread : threads_) thread.join();
    }

    Expected<std::unique_ptr<Channel>> connect() {
        const std::lock_guard lock(mutex_);
        ++attempts_;
        if (threads_.size() == scripts_.size()) return fail(ErrorCode::network, "nobody listens");
        auto [client, server] = MemoryChannel::pair(8);
        threads_.emplace_back(
            [script = scripts_[threads_.size()], channel = std::move(server), ahead_ns = clock_ahead_ns_]() mutable {
                FakeConnection connection(std::move(channel), ahead_ns);
                script(connection);
            });
        return std::move(client);
    }

    [[nodiscard]] int attempts() const {
        const std::lock_guard lock(mutex_);
        return attempts_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<Script> scripts_;
    std::int64_t clock_ahead_ns_;
    std::vector<std::thread> threads_;
    int attempts_ = 0;
};

}  // namespace macula::testing
