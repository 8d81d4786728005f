// A server over real loopback sockets against scripted peers, good and bad.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <thread>

#include "masks/levels.h"
#include "masks/rank_tile.h"
#include "protocol/base/clock.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "tests/support/peer.h"
#include "tests/support/raw_peer.h"
#include "tests/support/small_service.h"

namespace macula {
namespace {

using namespace std::chrono_literals;
using testing::kAWhile;
using testing::Peer;
using testing::RunningServer;
using testing::small_hello;

/// Sessions then trace on their own threads: oneTBB's synchronisation between its workers is invisible to
/// ThreadSanitizer, that between sessions is what these tests are about.
class OneThreadEach : public ::testing::Environment {
    oneapi::tbb::global_control limit_{oneapi::tbb::global_control::max_allowed_parallelism, 1};
};
const auto* const kOneThreadEach = ::testing::AddGlobalTestEnvironment(new OneThreadEach);

/// Pixels of one eye that the rule of EyeSamplingMessage calls traced.
int count_traced(const Welcome& welcome, const EyeSamplingMessage& sampling) {
    const int size = welcome.rank_tile_size_px;
    int traced = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            const glm::ivec2 in_tile = (glm::ivec2(x, y) + sampling.phase_px) % size;
            const glm::ivec2 tile = (glm::ivec2(x, y) + sampling.phase_px % kTileEdge_px) / kTileEdge_px;
            const std::uint8_t level = sampling.level[static_cast<std::size_t>(tile.y * sampling.tiles_x + tile.x)];
            const std::uint8_t rank = welcome.rank_tile[static_cast<std::size_t>(in_tile.y * size + in_tile.x)];
            if (rank < kLevelCounts[level]) ++traced;
        }
    return traced;
}

TEST(Server, SendsDecodableFramesSampledAsThePresetSays) {
    RunningServer server;
    Peer peer(server.port(), server.credentials());
    const auto welcome = peer.greet();
    ASSERT_TRUE(welcome);
    EXPECT_EQ(welcome->scene_name, "wall");
    EXPECT_EQ(welcome->sampling, "27");
    EXPECT_EQ(welcome->codec, "h264");

    Track track;
    track.id = 5;
    track.pose_time_ns = 1'000'000'000;
    track.gaze_time_ns = 998'000'000;
    track.display_time_ns = 1'010'000'000;
    track.start_from_head.position_m = {0.1F, -0.2F, 0.5F};
    peer.send(track);
    const auto frame = peer.expect<Frame>();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->id, 1U);
    EXPECT_EQ(frame->track_id, 5U);
    EXPECT_EQ(frame->pose_time_ns, track.pose_time_ns);
    EXPECT_EQ(frame->gaze_time_ns, track.gaze_time_ns);
    EXPECT_EQ(frame->display_time_ns, track.display_time_ns);
    EXPECT_TRUE(frame->keyframe);
    EXPECT_NEAR(frame->world_from_eye[kLeftEye].position_m.x, 0.1F - 0.032F, 1e-5F);
    EXPECT_NEAR(frame->world_from_eye[kRightEye].position_m.x, 0.1F + 0.032F, 1e-5F);
    EXPECT_NEAR(frame->gaze[kRightEye].z, -1.0F, 1e-5F);

    const int traced =
        count_traced(*welcome, frame->sampling[kLeftEye]) + count_traced(*welcome, frame->sampling[kRightEye]);
    EXPECT_EQ(static_cast<int>(frame->traced), traced);
    EXPECT_NEAR(static_cast<double>(traced) / (2.0 * 128 * 128), 0.27, 0.03);

    auto decoder = make_video_decoder(welcome->codec);
    ASSERT_TRUE(decoder);
    ColorImage picture;
    ASSERT_TRUE((*decoder)->decode(frame->color, picture));
    ASSERT_EQ(picture.width_px, 256);
    ASSERT_EQ(picture.height_px, 128);
    for (const Rgba8 pixel : picture.texels)
        for (int shift = 0; shift < 32; shift += 8)
            ASSERT_NEAR((pixel >> shift) & 0xff, (testing::kWallColor >> shift) & 0xff, 4);

    auto depth_decoder = make_depth_decoder();
    ASSERT_TRUE(depth_decoder);
    InverseDepthImage depth;
    ASSERT_TRUE((*depth_decoder)->decode(frame->depth, frame->near_m, depth));
    ASSERT_EQ(depth.width_px, 64);
    ASSERT_EQ(depth.height_px, 32);
    const float expected_per_m = 1.0F / (testing::kWallDistance_m + 0.5F);
    for (const float inverse : depth.texels)
        ASSERT_NEAR(inverse, expected_per_m, 0.5F / 254.0F / frame->near_m + 1e-4F);
}

TEST(Server, GazeMovesTheSamples) {
    RunningServer server;
    Peer peer(server.port(), server.credentials());
    ASSERT_TRUE(peer.greet());
    Track track;
    track.id = 1;
    const float side = std::sqrt(0.5F);
    for (GazeSample& gaze : track.gaze) gaze.direction = {-side, 0.0F, -side};
    peer.send(track);
    const auto frame = peer.expect<Frame>();
    ASSERT_TRUE(frame);
    const EyeSamplingMessage& sampling = frame->sampling[kLeftEye];
    const std::size_t middle = static_cast<std::size_t>(sampling.tiles_y / 2 * sampling.tiles_x);
    EXPECT_GT(sampling.level[middle], sampling.level[middle + static_cast<std::size_t>(sampling.tiles_x) - 1]);
}

TEST(Server, WrongTokenIsRefused) {
    RunningServer server;
    Peer peer(server.port(), server.credentials());
    peer.send(small_hello("not the token"));
    const auto refused = peer.expect<Refused>();
    ASSERT_TRUE(refused);
    EXPECT_NE(refused->reason.find("token"), std::string::npos);
    EXPECT_TRUE(peer.wait_for_end());
    EXPECT_EQ(server.counters().refused, 1U);
    EXPECT_EQ(server.counters().sessions, 0);
}

TEST(Server, WrongVersionIsRefusedNamingBoth) {
    RunningServer server;
    Peer peer(server.port(), server.credentials());
    Hello hello = small_hello(server.credentials().token);
    hello.protocol_version = 7'777;
    peer.send(hello);
    const auto refused = peer.expect<Refused>();
    ASSERT_TRUE(refused);
    EXPECT_NE(refused->reason.find("7777"), std::string::npos);
    EXPECT_NE(refused->reason.find("version " + std::to_string(kProtocolVersion)), std::string::npos);
    EXPECT_TRUE(peer.wait_for_end());
}

TEST(Server, UnknownSamplingIsRefused) {
    RunningServer server;
    Peer peer(server.port(), server.credentials());
    Hello hello = small_hello(server.credentials().token);
    hello.sampling = "plenty";
    peer.send(hello);
    const auto refused = peer.expect<Refused>();
    ASSERT_TRUE(refused);
    EXPECT_NE(refused->reason.find("plenty"), std::string::npos);
}

TEST(Server, FirstMessageMustBeHello) {
    RunningServer server;
    Peer peer(server.port(), server.credentials());
    peer.send(Ping{1});
    ASSERT_TRUE(peer.expect<Refused>());
    EXPECT_TRUE(peer.wait_for_end());
    EXPECT_TRUE(server.wait_until([](const ServerCounters& now) { return now.malformed == 1; }));
}

TEST(Server, FourClientsAtOnceAndTheFifthIsRefused) {
    RunningServer server;
    std::array<std::optional<Peer>, 4> peers;
    for (auto& peer : peers) {
        peer.emplace(server.port(), server.credentials());
        ASSERT_TRUE(peer->greet());
    }
    Peer fifth(server.port(), server.credentials());
    fifth.send(small_hello(server.credentials().token));
    const auto refused = fifth.expect<Refused>();
    ASSERT_TRUE(refused);
    EXPECT_NE(refused->reason.find("full"), std::string::npos);

    for (std::uint64_t id = 1; id <= 5; ++id) {
        for (auto& peer : peers) peer->send_track();
        for (auto& peer : peers) {
            const auto frame = peer->expect<Frame>();
            ASSERT_TRUE(frame);
            EXPECT_EQ(frame->id, id);
            peer->send(FrameReport{id, 1, 1, 1, false});
        }
    }
    // A place that becomes free is given to the next.
    peers[2]->send(Bye{"done"});
    EXPECT_TRUE(peers[2]->wait_for_end());
    Peer next(server.port(), server.credentials());
    EXPECT_TRUE(server.wait_until([](const ServerCounters& now) { return now.sessions == 3; }));
    EXPECT_TRUE(next.greet());
}

TEST(Server, VanishedClientFreesItsPlaceAndReconnectsToAKeyframe) {
    ServerOptions options;
    options.max_sessions = 1;
    RunningServer server(options);
    for (int round = 0; round < 3; ++round) {
        Peer peer(server.port(), server.credentials());
        ASSERT_TRUE(peer.greet());
        const auto frame = peer.next_frame();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->id, 1U);
        EXPECT_TRUE(frame->keyframe);
        peer.send_track();  // its frame is on its way when the client goes
        peer.vanish();
        ASSERT_TRUE(server.wait_until([](const ServerCounters& now) { return now.sessions == 0; }));
    }
}

TEST(Server, SilentClientIsCutOff) {
    ServerOptions options;
    options.session.silence_limit = 100ms;
    RunningServer server(options);
    Peer peer(server.port(), server.credentials());
    ASSERT_TRUE(peer.greet());
    EXPECT_FALSE(peer.receive());  // no Bye: it may come back
    EXPECT_TRUE(peer.wait_for_end());
    EXPECT_TRUE(server.wait_until([](const ServerCounters& now) { return now.sessions == 0; }));
}

TEST(Server, ClientWithoutAHelloIsCutOff) {
    ServerOptions options;
    options.greeting_limit = 50ms;
    RunningServer server(options);
    Peer peer(server.port(), server.credentials());
    EXPECT_TRUE(peer.wait_for_end());
    EXPECT_EQ(server.counters().refused, 0U);
}

TEST(Server, ClientThatNeverReadsIsCutOff) {
    ServerOptions options;
    options.session.send_limit = 200ms;
    RunningServer server(options);
    Peer peer(server.port(), server.credentials());
    ASSERT_TRUE(peer.greet());
    // It claims to have shown frames that it never read, until the server's sends find no room. Pongs fill the
    // way faster than frames of a plain wall.
    const auto deadline = std::chrono::steady_clock::now() + testing::kPatience;
    while (server.counters().sessions == 1 && std::chrono::steady_clock::now() < deadline) {
        for (int i = 0; i < 64; ++i) peer.send(Ping{1});
        peer.send(FrameReport{1'000'000, 1, 1, 1, false});
        peer.send_track();
    }
    EXPECT_EQ(server.counters().sessions, 0);
}

TEST(Server, StopsWithAByeInTheMiddleOfAStream) {
    auto server = std::make_unique<RunningServer>();
    Peer peer(server->port(), server->credentials());
    ASSERT_TRUE(peer.greet());
    ASSERT_TRUE(peer.next_frame());
    std::jthread stream([&peer](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            peer.send_track();
            peer.send(FrameReport{1'000'000, 1, 1, 1, false});
            std::this_thread::sleep_for(1ms);
        }
    });
    std::this_thread::sleep_for(20ms);
    server->stop();
    bool said_bye = false;
    while (const auto message = peer.receive()) said_bye = said_bye || std::holds_alternative<Bye>(*message);
    EXPECT_TRUE(said_bye);
    EXPECT_TRUE(peer.wait_for_end());
    stream.request_stop();
    stream.join();
    server.reset();
}

/// One thing after the other that a client must not do; each ends that client's connection alone.
TEST(Server, BadClientsLeaveAnothersStreamWhole) {
    ServerOptions options;
    options.greeting_limit = 1s;
    RunningServer server(options);
    Peer good(server.port(), server.credentials());
    ASSERT_TRUE(good.greet());
    std::uint64_t expected_id = 0;
    const auto good_goes_on = [&good, &expected_id] {
        for (int i = 0; i < 3; ++i) {
            const auto frame = good.next_frame();
            ASSERT_TRUE(frame);
            EXPECT_EQ(frame->id, ++expected_id);
            EXPECT_EQ(frame->keyframe, expected_id == 1);
        }
    };
    good_goes_on();

    {  // garbage instead of a Hello
        Peer bad(server.port(), server.credentials());
        static_cast<void>(bad.channel().send(Bytes(100, std::byte{0xff}), testing::kPatience));
        good_goes_on();
        EXPECT_TRUE(bad.wait_for_end());
    }
    {  // garbage in the middle of a session
        Peer bad(server.port(), server.credentials());
        ASSERT_TRUE(bad.greet());
        ASSERT_TRUE(bad.next_frame());
        static_cast<void>(bad.channel().send(Bytes(100, std::byte{0}), testing::kPatience));
        const auto bye = bad.expect<Bye>();
        ASSERT_TRUE(bye);
        EXPECT_NE(bye->reason, "");
        good_goes_on();
        EXPECT_TRUE(bad.wait_for_end());
    }
    {  // a message that only servers send
        Peer bad(server.port(), server.credentials());
        ASSERT_TRUE(bad.greet());
        bad.send(Welcome{});
        good_goes_on();
        EXPECT_TRUE(bad.wait_for_end());
    }
    {  // a length of 2 GiB
        const testing::RawTls bad(server.port());
        ASSERT_TRUE(bad.connected());
        ASSERT_TRUE(bad.write({std::byte{0x7f}, std::byte{0xff}, std::byte{0xff}, std::byte{0xff}}));
        good_goes_on();
        bad.socket().wait_for_end();
    }
    {  // plain TCP, not a word
        const testing::RawSocket bad(server.port());
        ASSERT_TRUE(bad.connected());
        good_goes_on();
    }
    {  // many connections that stall before their Hello
        std::array<std::optional<Peer>, 20> idle;
        for (auto& peer : idle) peer.emplace(server.port(), server.credentials());
        good_goes_on();
        for (auto& peer : idle) EXPECT_TRUE(peer->wait_for_end());
    }
    good_goes_on();
    EXPECT_TRUE(server.wait_until([](const ServerCounters& now) { return now.malformed == 4; }));
    EXPECT_EQ(server.counters().sessions, 1);
}

TEST(Server, AnswersPingsWhileItServes) {
    RunningServer server;
    Peer peer(server.port(), server.credentials());
    ASSERT_TRUE(peer.greet());
    const std::int64_t sent_ns = now_ns();
    peer.send(Ping{sent_ns});
    const auto pong = peer.expect<Pong>();
    ASSERT_TRUE(pong);
    EXPECT_EQ(pong->ping_sent_ns, sent_ns);
    EXPECT_GE(pong->answered_ns, sent_ns);  // one machine, one clock
    EXPECT_LE(pong->answered_ns, now_ns());
}

}  // namespace
}  // namespace macula
