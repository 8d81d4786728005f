#include "client/stream/client_session.h"

#include <cstdlib>
#include <future>
#include <string>

#include <gtest/gtest.h>

#include "client/stream/backoff.h"
#include "protocol/message/byte_map.h"
#include "tests/support/fake_server.h"

namespace macula {
namespace {

using std::chrono::milliseconds;
using testing::FakeConnection;
using testing::FakeServer;

constexpr milliseconds kPatience{10'000};

ClientSessionOptions options() {
    ClientSessionOptions options;
    options.hello.client_name = "test";
    options.hello.token = "secret";
    options.hello.eye_width_px = options.hello.eye_height_px = FakeConnection::kEye_px;
    options.hello.codecs = {"h264"};
    options.retry_for = milliseconds(3'000);
    options.first_retry = milliseconds(2);
    options.longest_retry = milliseconds(20);
    return options;
}

/// A session with a fake server, and the lines that it logged.
struct Trial {
    explicit Trial(std::vector<FakeServer::Script> scripts, const ClientSessionOptions& with = options(),
                   std::int64_t clock_ahead_ns = 0)
        : server(std::move(scripts), clock_ahead_ns),
          session([this](milliseconds) { return server.connect(); }, with,
                  [this](const std::string& line) {
                      const std::lock_guard lock(mutex);
                      log += line + "\n";
                  }) {}

    std::string logged() {
        const std::lock_guard lock(mutex);
        return log;
    }
    /// The error with which the session gives up.
    Error error() {
        const std::int64_t end_ns = now_ns() + kPatience.count() * 1'000'000;
        while (now_ns() < end_ns) {
            if (const auto error = session.error()) return *error;
            std::this_thread::sleep_for(milliseconds(1));
        }
        return {ErrorCode::internal, "the session does not give up"};
    }

    std::mutex mutex;
    std::string log;
    FakeServer server;
    ClientSession session;
};

int grey_of(const ReceivedFrame& frame) {
    return static_cast<int>(frame.color.at(10, 10) & 255U);
}

TEST(ClientSession, TracksGoOutAndFramesComeIn) {
    std::promise<Track> sent;
    std::promise<FrameReport> reported;
    Trial trial({[&](FakeConnection& server) {
        const auto hello = server.welcome();
        EXPECT_TRUE(hello && hello->token == "secret");
        server.send(server.make_frame(7, 120, true));
        if (const auto track = server.expect<Track>()) sent.set_value(*track);
        if (const auto report = server.expect<FrameReport>()) reported.set_value(*report);
        server.expect<Bye>();
    }});
    const auto frame = trial.session.next_frame(kPatience);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->frame.id, 7U);
    EXPECT_NEAR(grey_of(*frame), 120, 3);
    ASSERT_EQ(frame->depth.width_px, FakeConnection::kEye_px / 2);
    EXPECT_NEAR(frame->depth.at(3, 3), 0.5F, 0.005F);
    EXPECT_LE(frame->received_ns, frame->decoded_ns);
    EXPECT_EQ(frame->welcome->scene_name, "grey");
    Track track;
    track.pose_time_ns = 42;
    trial.session.send(track);
    auto track_there = sent.get_future();
    ASSERT_EQ(track_there.wait_for(kPatience), std::future_status::ready);
    EXPECT_EQ(track_there.get().pose_time_ns, 42);
    trial.session.send(FrameReport{7, 1, 2, 3, false});
    auto report_there = reported.get_future();
    ASSERT_EQ(report_there.wait_for(kPatience), std::future_status::ready);
    EXPECT_EQ(report_there.get().displayed_ns, 3);
    trial.session.stop();
    EXPECT_FALSE(trial.session.error());
}

TEST(ClientSession, ChoicesGoOutInOrderAndAnswersComeIn) {
    std::promise<std::vector<Choose>> asked;
    Trial trial({[&](FakeConnection& server) {
        server.welcome();
        server.send(server.make_frame(1, 120, true));
        std::vector<Choose> choices;
        while (choices.size() < 2) {
            const auto choice = server.expect<Choose>();
            if (!choice) break;
            choices.push_back(*choice);
            server.send(Chosen{choice->id, choice->id == 5 ? "" : "there is none"});
        }
        asked.set_value(choices);
        server.expect<Bye>();
    }});
    ASSERT_TRUE(trial.session.next_frame(kPatience));
    trial.session.send(Choose{5, "27", true});
    trial.session.send(Choose{6, "28", false});
    auto choices_there = asked.get_future();
    ASSERT_EQ(choices_there.wait_for(kPatience), std::future_status::ready);
    const auto choices = choices_there.get();
    ASSERT_EQ(choices.size(), 2U);
    EXPECT_EQ(choices[0].sampling, "27");
    EXPECT_TRUE(choices[0].only_prepare);
    EXPECT_EQ(choices[1].sampling, "28");
    EXPECT_FALSE(choices[1].only_prepare);
    std::vector<Chosen> answers;
    const std::int64_t end_ns = now_ns() + kPatience.count() * 1'000'000;
    while (answers.size() < 2 && now_ns() < end_ns) {
        for (Chosen& answer : trial.session.take_answers()) answers.push_back(std::move(answer));
        std::this_thread::sleep_for(milliseconds(1));
    }
    ASSERT_EQ(answers.size(), 2U);
    EXPECT_EQ(answers[0].id, 5U);
    EXPECT_EQ(answers[0].problem, "");
    EXPECT_EQ(answers[1].problem, "there is none");
    EXPECT_TRUE(trial.session.take_answers().empty());
}

TEST(ClientSession, MapsOfWhatMovesAreUnpackedAndChecked) {
    constexpr std::size_t kBlocks = std::size_t{2} * FakeConnection::kEye_px / 4 * FakeConnection::kEye_px / 4;
    std::promise<FrameReport> too_short;
    std::promise<FrameReport> too_high;
    Trial trial({[&](FakeConnection& server) {
        server.welcome();
        const auto send = [&](std::uint64_t id, std::size_t blocks, std::uint8_t slot) {
            Frame frame = server.make_frame(id, 120, true);
            frame.moving.resize(2);
            frame.moving[1].id = 1;
            std::vector<std::uint8_t> map(blocks);
            map[5] = slot;
            frame.moving_map = pack_map(map);
            server.send(frame);
        };
        send(1, kBlocks - 1, 2);
        if (const auto report = server.expect<FrameReport>()) too_short.set_value(*report);
        send(2, kBlocks, 3);
        if (const auto report = server.expect<FrameReport>()) too_high.set_value(*report);
        send(3, kBlocks, 2);
        server.expect<Bye>();
    }});
    for (std::promise<FrameReport>* refused : {&too_short, &too_high}) {
        auto report = refused->get_future();
        ASSERT_EQ(report.wait_for(kPatience), std::future_status::ready);
        EXPECT_TRUE(report.get().decode_failed);
    }
    const auto frame = trial.session.next_frame(kPatience);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->frame.id, 3U);
    ASSERT_EQ(frame->frame.moving.size(), 2U);
    ASSERT_EQ(frame->moving_map.texels.size(), kBlocks);
    EXPECT_EQ(frame->moving_map.width_px, frame->depth.width_px);
    EXPECT_EQ(frame->moving_map.at(5, 0), 2);
    EXPECT_EQ(frame->moving_map.at(6, 0), 0);
    trial.session.stop();
    EXPECT_NE(trial.logged().find("Frame.moving_map"), std::string::npos) << trial.logged();
}

TEST(ClientSession, ARefusalEndsItWithoutRetry) {
    Trial trial({[](FakeConnection& server) {
        server.expect<Hello>();
        server.send(Refused{kProtocolVersion, "wrong token; copy the one in the state folder"});
    }});
    const Error error = trial.error();
    EXPECT_EQ(error.code, ErrorCode::refused);
    EXPECT_NE(error.message.find("wrong token"), std::string::npos);
    EXPECT_EQ(trial.server.attempts(), 1);
    EXPECT_FALSE(trial.session.next_frame(kPatience)) << "the slot is closed, nobody waits for ever";
}

TEST(ClientSession, AnotherVersionNamesBoth) {
    Trial trial({[](FakeConnection& server) {
        server.expect<Hello>();
        server.send(Refused{kProtocolVersion + 6, "update the client"});
    }});
    const Error error = trial.error();
    EXPECT_EQ(error.code, ErrorCode::refused);
    EXPECT_NE(error.message.find("version " + std::to_string(kProtocolVersion + 6)), std::string::npos);
    EXPECT_NE(error.message.find("version " + std::to_string(kProtocolVersion)), std::string::npos);
}

TEST(ClientSession, GoesOnWhenTheServerReturns) {
    const auto one_frame = [](FakeConnection& server) {
        server.welcome();
        server.send(server.make_frame(1, 50, true));
        server.expect<FrameReport>();
    };
    Trial trial({one_frame, one_frame, one_frame});
    for (std::uint64_t connection = 1; connection <= 3; ++connection) {
        const auto frame = trial.session.next_frame(kPatience);
        ASSERT_TRUE(frame) << trial.logged();
        EXPECT_EQ(frame->connection, connection);
        trial.session.send(FrameReport{1, 0, 0, 1, false});
    }
    EXPECT_EQ(trial.session.counters().connections, 3U);
}

TEST(ClientSession, GivesUpAfterItsTime) {
    ClientSessionOptions soon = options();
    soon.retry_for = milliseconds(60);
    Trial trial({}, soon);
    const Error error = trial.error();
    EXPECT_EQ(error.code, ErrorCode::network);
    EXPECT_EQ(error.message, "nobody listens");
    EXPECT_GT(trial.server.attempts(), 2);
    ClientSessionOptions at_once = options();
    at_once.retry_for = milliseconds(0);
    Trial once({}, at_once);
    EXPECT_EQ(once.error().code, ErrorCode::network);
    EXPECT_EQ(once.server.attempts(), 1);
}

TEST(ClientSession, AsksForAKeyframeAfterABrokenFrame) {
    bool asked = false;
    Trial trial({[&](FakeConnection& server) {
        server.welcome();
        server.send(server.make_frame(1, 40, true));
        server.expect<FrameReport>();
        Frame broken = server.make_frame(2, 80, false);
        broken.color.assign(broken.color.size(), 0x5A);
        server.send(broken);
        server.send(server.make_frame(3, 80, false));  // refers to the broken one: must not be shown
        for (int i = 0; i < 2; ++i) {
            const auto report = server.expect<FrameReport>();
            asked = report && report->decode_failed;
            EXPECT_TRUE(asked);
        }
        server.send(server.make_frame(4, 160, true));
        server.expect<Bye>();
    }});
    const auto first = trial.session.next_frame(kPatience);
    ASSERT_TRUE(first);
    trial.session.send(FrameReport{1, 0, 0, 1, false});
    const auto next = trial.session.next_frame(kPatience);
    ASSERT_TRUE(next) << trial.logged();
    EXPECT_EQ(next->frame.id, 4U);
    EXPECT_NEAR(grey_of(*next), 160, 3);
    EXPECT_EQ(trial.session.counters().frames_undecodable, 2U);
    EXPECT_EQ(trial.session.counters().connections, 1U) << "a broken picture is no reason to leave";
}

TEST(ClientSession, PicturesOfAnotherSizeAreNotShown) {
    ClientSessionOptions larger = options();
    larger.hello.eye_width_px = 128;
    Trial trial({[](FakeConnection& server) {
                    server.welcome();
                    server.send(server.make_frame(1, 40, true));
                    const auto report = server.expect<FrameReport>();
                    EXPECT_TRUE(report && report->decode_failed);
                }},
                larger);
    EXPECT_FALSE(trial.session.next_frame(milliseconds(300)));
}

TEST(ClientSession, ASilentServerIsLost) {
    ClientSessionOptions impatient = options();
    impatient.silence_timeout = milliseconds(100);
    Trial trial({[](FakeConnection& server) {
                     server.welcome();
                     std::this_thread::sleep_for(milliseconds(400));
                 },
                 [](FakeConnection& server) {
                     server.welcome();
                     server.send(server.make_frame(1, 50, true));
                     server.expect<Bye>();
                 }},
                impatient);
    const auto frame = trial.session.next_frame(kPatience);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->connection, 2U);
    EXPECT_NE(trial.logged().find("silent"), std::string::npos) << trial.logged();
}

TEST(ClientSession, GarbageEndsTheConnectionNotTheSession) {
    Trial trial({[](FakeConnection& server) {
                     server.welcome();
                     server.send_raw(Bytes(100, std::byte{0x7F}));
                     server.expect<Bye>(milliseconds(500));
                 },
                 [](FakeConnection& server) {
                     server.expect<Hello>();
                     server.send(Pong{});  // out of turn
                     server.expect<Bye>(milliseconds(500));
                 },
                 [](FakeConnection& server) {
                     server.welcome();
                     server.send(server.make_frame(1, 50, true));
                     server.expect<Bye>();
                 }});
    const auto frame = trial.session.next_frame(kPatience);
    ASSERT_TRUE(frame) << trial.logged();
    EXPECT_EQ(frame->connection, 2U) << "the second was never welcome";
}

TEST(ClientSession, FramesThatNobodyTakesAreDroppedAndReported) {
    std::promise<void> done;
    Trial trial({[&](FakeConnection& server) {
        server.welcome();
        for (std::uint64_t id = 1; id <= 5; ++id) server.send(server.make_frame(id, 50, id == 1));
        for (std::uint64_t id = 1; id <= 4; ++id) {
            const auto report = server.expect<FrameReport>();
            EXPECT_TRUE(report && report->frame_id == id && report->displayed_ns == 0 && !report->decode_failed);
        }
        done.set_value();
        server.expect<Bye>();
    }});
    ASSERT_EQ(done.get_future().wait_for(kPatience), std::future_status::ready);
    const auto frame = trial.session.next_frame(kPatience);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->frame.id, 5U);
    EXPECT_EQ(trial.session.counters().frames_dropped, 4U);
}

TEST(ClientSession, MeasuresTheServersClock) {
    constexpr std::int64_t kAhead_ns = 123'456'789'000;
    Trial trial({[](FakeConnection& server) {
                    server.welcome();
                    server.expect<Bye>(kPatience);
                }},
                options(), kAhead_ns);
    const std::int64_t end_ns = now_ns() + kPatience.count() * 1'000'000;
    while (!trial.session.clock_offset() && now_ns() < end_ns) std::this_thread::sleep_for(milliseconds(1));
    const auto offset = trial.session.clock_offset();
    ASSERT_TRUE(offset);
    EXPECT_LE(std::abs(offset->offset_ns - kAhead_ns), offset->round_trip_ns / 2 + 1000);
    trial.session.stop();
}

TEST(ClientSession, StopsWhileNobodyAnswers) {
    Trial trial({});
    trial.session.stop();
    EXPECT_FALSE(trial.session.error()) << "being stopped is not an error";
}

TEST(ClockFilter, BelievesTheShortestRoundTrip) {
    ClockFilter filter;
    EXPECT_FALSE(filter.best());
    // Symmetric 2 ms: exact. 40 ms of which the way back took 38: wrong by 18 ms.
    filter.add(Pong{1'000'000'000, 6'020'000'000}, 1'040'000'000);
    filter.add(Pong{2'000'000'000, 7'001'000'000}, 2'002'000'000);
    filter.add(Pong{3'000'000'000, 8'002'000'000}, 3'040'000'000);
    EXPECT_EQ(filter.best()->offset_ns, 5'000'000'000);
    EXPECT_EQ(filter.best()->round_trip_ns, 2'000'000);
    filter.add(Pong{9'000'000'000, 1}, 8'000'000'000);  // from the future: ignored
    EXPECT_EQ(filter.best()->round_trip_ns, 2'000'000);
    // Clocks drift: what is 16 exchanges old is forgotten.
    for (int i = 0; i < 16; ++i) filter.add(Pong{0, 10'003'000'000}, 6'000'000);
    EXPECT_EQ(filter.best()->offset_ns, 10'000'000'000);
}

TEST(Backoff, DoublesWithJitterUpToItsLimit) {
    Backoff backoff(milliseconds(100), milliseconds(1000), 7);
    for (int round = 0; round < 2; ++round) {
        std::int64_t step = 100;
        for (int i = 0; i < 10; ++i) {
            const auto wait = backoff.next().count();
            EXPECT_GE(wait, step / 2);
            EXPECT_LE(wait, step);
            step = std::min<std::int64_t>(2 * step, 1000);
        }
        backoff.reset();
    }
}

TEST(Outbox, TheNewestTrackWinsAndTheRestKeepsItsOrder) {
    Outbox outbox;
    Track track;
    for (std::uint64_t id = 1; id <= 3; ++id) {
        track.id = id;
        outbox.put_track(track);
        outbox.put(FrameReport{id, 0, 0, 0, false});
    }
    const auto messages = outbox.take(milliseconds(0));
    ASSERT_EQ(messages.size(), 4U);
    for (std::uint64_t id = 1; id <= 3; ++id) EXPECT_EQ(std::get<FrameReport>(messages[id - 1]).frame_id, id);
    EXPECT_EQ(std::get<Track>(messages[3]).id, 3U);
    EXPECT_EQ(outbox.dropped_tracks(), 2U);
    EXPECT_TRUE(outbox.take(milliseconds(1)).empty());
}

}  // namespace
}  // namespace macula
