// A session against a peer in the same process, with fakes for everything that renders.

#include "server/service/session.h"

#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/null_sink.h>

#include <future>
#include <memory>
#include <optional>
#include <thread>

#include "protocol/base/clock.h"
#include "tests/support/memory_channel.h"
#include "tests/support/render_fakes.h"

namespace macula {
namespace {

using namespace std::chrono_literals;
using testing::FakeReconstructor;
using testing::FakeTracer;

constexpr int kWidth_px = 64;
constexpr int kHeight_px = 80;

Display small_display() {
    Display display;
    display.name = "small";
    display.eye_width_px = kWidth_px;
    display.eye_height_px = kHeight_px;
    display.eyes[kLeftEye].head_from_eye.position_m = {-0.03F, 0.0F, 0.0F};
    display.eyes[kRightEye].head_from_eye.position_m = {0.03F, 0.0F, 0.0F};
    return display;
}

/// A running session and the client's end of its channel.
class SessionTest : public ::testing::Test {
protected:
    void start(SessionOptions options = {}, std::size_t channel_capacity = 64) {
        auto [server_end, client_end] = testing::MemoryChannel::pair(channel_capacity);
        server_end_ = std::move(server_end);
        client_ = std::move(client_end);
        Scene scene;
        scene.world_from_start.position_m = {0.0F, 1.6F, 0.0F};
        scene.near_m = 0.25F;
        FrameMaker::Parts maker_parts;
        maker_parts.scene = std::make_shared<const Scene>(std::move(scene));
        maker_parts.scene_start_ns = scene_start_ns_;
        maker_parts.tracer = tracer_;
        for (auto& sampler : maker_parts.samplers)
            sampler = std::make_unique<testing::FakeSampler>(kWidth_px, kHeight_px);
        auto reconstructor = std::make_unique<FakeReconstructor>();
        reconstructor_ = reconstructor.get();
        maker_parts.reconstructor = std::move(reconstructor);
        Session::Parts parts;
        parts.frame_maker = std::make_unique<FrameMaker>(small_display(), std::move(maker_parts));
        parts.make_method = [this](const std::string& sampling) { return make_method(sampling); };
        parts.color_encoder = std::make_unique<testing::FakeVideoEncoder>();
        parts.depth_encoder = std::make_unique<testing::FakeDepthEncoder>();
        parts.refresh_hz = 1000.0;
        parts.frame_pixels = 2 * kWidth_px * kHeight_px;
        session_ = std::make_unique<Session>(
            "test", *server_end_, std::move(parts), options,
            std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>()));
        outcome_ = std::async(std::launch::async, [this] { return session_->run(); });
    }

    void TearDown() override {
        if (client_) client_->close();
        if (outcome_.valid()) outcome_.wait();
    }

    void send(const Message& message) { ASSERT_TRUE(client_->send(encode_message(message), 1s)); }

    void send_track(std::uint64_t id) {
        Track track;
        track.id = id;
        track.pose_time_ns = now_ns();
        track.gaze_time_ns = track.pose_time_ns - 1'000'000;
        track.display_time_ns = track.pose_time_ns;
        send(track);
    }

    /// Next message from the server, if one comes.
    std::optional<Message> receive(std::chrono::milliseconds timeout = 2s) {
        const auto body = client_->receive(timeout);
        if (!body) return std::nullopt;
        auto message = decode_message(*body);
        EXPECT_TRUE(message) << message.error().message;
        return message ? std::optional<Message>(*std::move(message)) : std::nullopt;
    }

    std::optional<Frame> receive_frame(std::chrono::milliseconds timeout = 2s) {
        auto message = receive(timeout);
        if (!message || !std::holds_alternative<Frame>(*message)) return std::nullopt;
        return std::get<Frame>(*std::move(message));
    }

    /// "slow" waits until may_make_ is set; other words are unknown, but for "small", whose plans are half as wide.
    Expected<std::unique_ptr<MethodParts>> make_method(const std::string& sampling) {
        if (sampling == "slow") may_make_.get_future().wait();
        if (sampling != "small" && sampling != "slow") return fail(ErrorCode::option, "no method " + sampling);
        auto method = std::make_unique<MethodParts>();
        for (auto& sampler : method->samplers)
            sampler = std::make_unique<testing::FakeSampler>(kWidth_px / 2, kHeight_px);
        method->reconstructor = std::make_unique<FakeReconstructor>();
        return method;
    }

    /// How the session ended; says what its last words were.
    Expected<void> outcome() {
        while (auto message = receive())
            if (const auto* bye = std::get_if<Bye>(&*message)) bye_ = bye->reason;
        return outcome_.get();
    }

    const std::int64_t scene_start_ns_ = now_ns() - 5'000'000'000;
    std::shared_ptr<FakeTracer> tracer_ = std::make_shared<FakeTracer>();
    FakeReconstructor* reconstructor_ = nullptr;
    std::unique_ptr<Channel> server_end_;
    std::unique_ptr<Channel> client_;
    std::unique_ptr<Session> session_;
    std::future<Expected<void>> outcome_;
    std::string bye_;
    std::promise<void> may_make_;
};

TEST_F(SessionTest, FrameCarriesEverythingThatMadeIt) {
    start();
    Track track;
    track.id = 41;
    track.pose_time_ns = 1'000'000'000;
    track.gaze_time_ns = 999'000'000;
    track.display_time_ns = 1'040'000'000;
    track.linear_velocity_m_s = {1.0F, 0.0F, 0.0F};
    track.gaze[kLeftEye].direction = glm::normalize(glm::vec3(0.3F, 0.1F, -1.0F));
    track.gaze[kRightEye].direction = glm::normalize(glm::vec3(0.2F, 0.1F, -1.0F));
    const std::int64_t before_ns = now_ns();
    send(track);
    const auto frame = receive_frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->id, 1U);
    EXPECT_EQ(frame->track_id, 41U);
    EXPECT_EQ(frame->pose_time_ns, track.pose_time_ns);
    EXPECT_EQ(frame->gaze_time_ns, track.gaze_time_ns);
    EXPECT_EQ(frame->display_time_ns, track.display_time_ns);
    EXPECT_TRUE(frame->keyframe);
    EXPECT_EQ(frame->near_m, 0.25F);
    // 40 ms at 1 m/s from the start pose, and half the distance between the eyes.
    EXPECT_NEAR(frame->world_from_eye[kLeftEye].position_m.x, 0.04F - 0.03F, 1e-6F);
    EXPECT_NEAR(frame->world_from_eye[kRightEye].position_m.x, 0.04F + 0.03F, 1e-6F);
    EXPECT_NEAR(frame->world_from_eye[kRightEye].position_m.y, 1.6F, 1e-6F);
    EXPECT_NEAR(glm::dot(frame->gaze[kLeftEye], track.gaze[kLeftEye].direction), 1.0F, 1e-6F);
    EXPECT_NEAR(glm::dot(frame->gaze[kRightEye], track.gaze[kRightEye].direction), 1.0F, 1e-6F);
    EXPECT_EQ(frame->sampling[kLeftEye].phase_px, phase_of_frame(0));
    EXPECT_EQ(frame->sampling[kLeftEye].tiles_x, 4);
    EXPECT_EQ(frame->sampling[kLeftEye].tiles_y, 5);
    EXPECT_EQ(frame->sampling[kLeftEye].level, std::vector<std::uint8_t>(20, 1));
    EXPECT_EQ(frame->traced, 40U);
    EXPECT_EQ(frame->color, (std::vector<std::uint8_t>{1, 2}));  // the left eye is on the left
    EXPECT_EQ(frame->depth, std::vector<std::uint8_t>{7});
    const StageTimes& times = frame->times;
    // The first Track's delay cannot be known: it counts as none, and the frame is shown 40 ms after the pose.
    EXPECT_NEAR(tracer_->last_time_s, 1e-9 * static_cast<double>(times.track_received_ns - scene_start_ns_) + 0.040,
                1e-9);
    EXPECT_TRUE(frame->moving.empty());
    EXPECT_LE(before_ns, times.track_received_ns);
    EXPECT_LE(times.track_received_ns, times.begin_ns);
    EXPECT_LE(times.begin_ns, times.plan_ns);
    EXPECT_LE(times.plan_ns, times.trace_ns);
    EXPECT_LE(times.trace_ns, times.reconstruct_ns);
    EXPECT_LE(times.reconstruct_ns, times.encode_ns);
    EXPECT_LE(times.encode_ns, times.send_ns);
    EXPECT_LE(times.send_ns, now_ns());
    EXPECT_EQ(tracer_->calls, 1);
    EXPECT_EQ(tracer_->tasks_per_call, 2);
}

TEST_F(SessionTest, NoNewTrackNoNewFrame) {
    start();
    send_track(1);
    const auto first = receive_frame();
    ASSERT_TRUE(first);
    send(FrameReport{first->id, 1, 2, 3, false});
    EXPECT_FALSE(receive_frame(100ms));
    send_track(2);
    const auto second = receive_frame();
    ASSERT_TRUE(second);
    EXPECT_EQ(second->id, 2U);
    EXPECT_EQ(second->track_id, 2U);
    EXPECT_FALSE(second->keyframe);
    EXPECT_EQ(second->sampling[kRightEye].phase_px, phase_of_frame(1));
}

TEST_F(SessionTest, UnreportedFramesHoldBackFurtherOnes) {
    SessionOptions options;
    options.max_in_flight = 3;
    start(options);
    std::uint64_t track = 0;
    for (std::uint64_t id = 1; id <= 3; ++id) {
        send_track(++track);
        const auto frame = receive_frame();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->id, id);
    }
    for (int i = 0; i < 5; ++i) send_track(++track);
    EXPECT_FALSE(receive_frame(100ms));
    send(FrameReport{1, 1, 2, 3, false});
    const auto frame = receive_frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->id, 4U);
    EXPECT_EQ(frame->track_id, track);  // the newest, not the oldest that waited
    EXPECT_FALSE(receive_frame(100ms));
}

TEST_F(SessionTest, FailedDecodingBringsAKeyframe) {
    start();
    send_track(1);
    ASSERT_TRUE(receive_frame());
    send_track(2);
    const auto second = receive_frame();
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->keyframe);
    send(FrameReport{2, 1, 0, 0, true});
    send_track(3);
    const auto third = receive_frame();
    ASSERT_TRUE(third);
    EXPECT_TRUE(third->keyframe);
}

TEST_F(SessionTest, FramesAreMadeByTheMethodThatWasChosen) {
    start();
    send_track(1);
    const auto before = receive_frame();
    ASSERT_TRUE(before);
    EXPECT_EQ(before->choice, 0U);
    EXPECT_GE(before->sampling[kLeftEye].tiles_x, 4);
    for (const bool only_prepare : {true, false}) {
        send(Choose{only_prepare ? 7U : 8U, "small", only_prepare});
        const auto answer = receive();
        ASSERT_TRUE(answer && std::holds_alternative<Chosen>(*answer));
        EXPECT_EQ(std::get<Chosen>(*answer).id, only_prepare ? 7U : 8U);
        EXPECT_EQ(std::get<Chosen>(*answer).problem, "");
        send_track(2);
        const auto frame = receive_frame();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->choice, only_prepare ? 0U : 8U);
        // The phase may have shifted the tiles so that one more touches the window.
        EXPECT_EQ(frame->sampling[kRightEye].tiles_x >= 4, only_prepare);
        EXPECT_FALSE(frame->keyframe) << "the stream goes on";
        send(FrameReport{frame->id, 1, 2, 3, false});
    }
}

TEST_F(SessionTest, FramesGoOnWhileAMethodIsMade) {
    start();
    send(Choose{1, "slow", false});
    for (std::uint64_t id = 1; id <= 3; ++id) {
        send_track(id);
        const auto frame = receive_frame();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->choice, 0U);
        send(FrameReport{frame->id, 1, 2, 3, false});
    }
    may_make_.set_value();
    const auto answer = receive();
    ASSERT_TRUE(answer && std::holds_alternative<Chosen>(*answer));
    send_track(4);
    EXPECT_EQ(receive_frame()->choice, 1U);
}

TEST_F(SessionTest, AnUnknownMethodLeavesTheOldOne) {
    start();
    send(Choose{3, "nonsense", false});
    const auto answer = receive();
    ASSERT_TRUE(answer && std::holds_alternative<Chosen>(*answer));
    EXPECT_EQ(std::get<Chosen>(*answer).id, 3U);
    EXPECT_EQ(std::get<Chosen>(*answer).problem, "no method nonsense");
    send_track(1);
    const auto frame = receive_frame();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->choice, 0U);
    EXPECT_EQ(frame->traced, 40U);
}

TEST_F(SessionTest, PingIsAnsweredWithBothTimes) {
    start();
    const std::int64_t before_ns = now_ns();
    send(Ping{123});
    const auto message = receive();
    ASSERT_TRUE(message && std::holds_alternative<Pong>(*message));
    EXPECT_EQ(std::get<Pong>(*message).ping_sent_ns, 123);
    EXPECT_GE(std::get<Pong>(*message).answered_ns, before_ns);
    EXPECT_LE(std::get<Pong>(*message).answered_ns, now_ns());
}

TEST_F(SessionTest, ByeEndsItWell) {
    start();
    send(Bye{"done"});
    EXPECT_TRUE(outcome());
    EXPECT_EQ(bye_, "");
}

TEST_F(SessionTest, StopSaysByeAndEndsItWell) {
    start();
    send_track(1);
    ASSERT_TRUE(receive_frame());
    session_->stop("maintenance");
    EXPECT_TRUE(outcome());
    EXPECT_EQ(bye_, "maintenance");
}

TEST_F(SessionTest, MalformedMessageEndsIt) {
    start();
    const Bytes garbage(17, std::byte{0x5a});
    ASSERT_TRUE(client_->send(garbage, 1s));
    const auto ended = outcome();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::protocol);
    EXPECT_EQ(bye_, ended.error().message);
}

TEST_F(SessionTest, UnexpectedMessageEndsIt) {
    start();
    send(Hello{});
    const auto ended = outcome();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::protocol);
}

TEST_F(SessionTest, SilentPeerIsGivenUp) {
    SessionOptions options;
    options.silence_limit = 50ms;
    start(options);
    const auto ended = outcome();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::timeout);
    EXPECT_EQ(bye_, "");  // it may come back
}

TEST_F(SessionTest, PeerThatDoesNotReadIsGivenUp) {
    SessionOptions options;
    options.send_limit = 50ms;
    start(options, 2);
    for (int i = 0; i < 3; ++i) send(Ping{i});  // the third Pong finds no room
    const auto ended = outcome_.get();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::timeout);
}

TEST_F(SessionTest, VanishedPeerEndsIt) {
    start();
    send_track(1);
    client_->close();
    const auto ended = outcome_.get();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::network);
}

TEST_F(SessionTest, LostContextEndsIt) {
    start();
    reconstructor_->broken = true;
    send_track(1);
    const auto ended = outcome();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::graphics);
    EXPECT_EQ(bye_, "the context is lost");
}

}  // namespace
}  // namespace macula
