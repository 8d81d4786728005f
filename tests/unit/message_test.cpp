#include "protocol/message/message.h"

#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "masks/levels.h"
#include "protocol/message/limits.h"

namespace macula {
namespace {

EyeDisplayMessage some_eye() {
    EyeDisplayMessage eye;
    eye.tangents = {-1.2F, 1.0F, -1.3F, 1.25F};
    eye.head_from_eye.position_m = {-0.032F, 0.0F, 0.0F};
    eye.visible_outline = {{-1.0F, 0.0F}, {0.0F, -1.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
    return eye;
}

Hello some_hello() {
    Hello hello;
    hello.client_name = "client";
    hello.token = "0123456789abcdef";
    hello.display_name = "vive";
    hello.eye_width_px = 1512;
    hello.eye_height_px = 1680;
    hello.eyes = {some_eye(), some_eye()};
    hello.codecs = {"h264"};
    return hello;
}

Welcome some_welcome() {
    Welcome welcome;
    welcome.server_name = "server";
    welcome.rank_tile_size_px = 64;
    welcome.rank_tile.assign(64 * 64, 7);
    return welcome;
}

Frame some_frame() {
    Frame frame;
    frame.id = 12;
    frame.gaze = {glm::vec3(0.0F, 0.0F, -1.0F), glm::vec3(0.0F, 0.0F, -1.0F)};
    for (EyeSamplingMessage& sampling : frame.sampling) {
        sampling = {{3, 63}, 96, 106, std::vector<std::uint8_t>(std::size_t{96} * 106, 5)};
    }
    frame.color = {1, 2, 3};
    frame.depth = {4, 5};
    return frame;
}

/// The error's text, or "accepted".
std::string outcome(const Message& message) {
    const Expected<Message> decoded = decode_message(encode_message(message));
    if (decoded) return "accepted";
    EXPECT_EQ(decoded.error().code, ErrorCode::protocol);
    return decoded.error().message;
}

/// Applies a change to a good message; the outcome must name the field.
template <class T>
void expect_refused(T message, const std::function<void(T&)>& change, const std::string& field) {
    EXPECT_EQ(outcome(message), "accepted");
    change(message);
    const std::string text = outcome(message);
    EXPECT_NE(text.find(field + " "), std::string::npos) << "outcome: " << text << "\nwanted: " << field;
}

const float kNaN = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

TEST(Message, HelloIsValidated) {
    const auto refused = [](const std::function<void(Hello&)>& change, const std::string& field) {
        expect_refused<Hello>(some_hello(), change, field);
    };
    refused([](Hello& h) { h.client_name.assign(65, 'x'); }, "Hello.client_name");
    refused([](Hello& h) { h.client_name = "two\nlines"; }, "Hello.client_name");
    refused([](Hello& h) { h.token.assign(129, 'x'); }, "Hello.token");
    refused([](Hello& h) { h.display_name.assign(65, 'x'); }, "Hello.display_name");
    refused([](Hello& h) { h.eye_width_px = 60; }, "Hello.eye_width_px");
    refused([](Hello& h) { h.eye_width_px = 4100; }, "Hello.eye_width_px");
    refused([](Hello& h) { h.eye_height_px = 1002; }, "Hello.eye_height_px");
    refused([](Hello& h) { h.eye_height_px = -64; }, "Hello.eye_height_px");
    refused([](Hello& h) { h.refresh_hz = 0.5F; }, "Hello.refresh_hz");
    refused([](Hello& h) { h.refresh_hz = kNaN; }, "Hello.refresh_hz");
    refused([](Hello& h) { h.refresh_hz = 1001.0F; }, "Hello.refresh_hz");
    refused([](Hello& h) { h.sampling.assign(65, 'x'); }, "Hello.sampling");
    refused([](Hello& h) { h.codecs.assign(17, "h264"); }, "Hello.codecs");
    refused([](Hello& h) { h.codecs = {std::string(65, 'x')}; }, "Hello.codecs");
    refused([](Hello& h) { std::swap(h.eyes[0].tangents.left, h.eyes[0].tangents.right); }, "Hello.eyes[0].tangents");
    refused([](Hello& h) { h.eyes[1].tangents.top = h.eyes[1].tangents.bottom; }, "Hello.eyes[1].tangents");
    refused([](Hello& h) { h.eyes[1].tangents.right = 10.5F; }, "Hello.eyes[1].tangents");
    refused([](Hello& h) { h.eyes[1].head_from_eye.orientation.w = 1.01F; }, "Hello.eyes[1].head_from_eye");
    refused([](Hello& h) { h.eyes[1].head_from_eye.position_m.y = kInfinity; }, "Hello.eyes[1].head_from_eye");
    refused([](Hello& h) { h.eyes[0].visible_outline.resize(257); }, "Hello.eyes[0].visible_outline");
    refused([](Hello& h) { h.eyes[0].visible_outline.resize(2); }, "Hello.eyes[0].visible_outline");
    refused([](Hello& h) { h.eyes[0].visible_outline[1].y = -kNaN; }, "Hello.eyes[0].visible_outline");
}

TEST(Message, WelcomeIsValidated) {
    const auto refused = [](const std::function<void(Welcome&)>& change, const std::string& field) {
        expect_refused<Welcome>(some_welcome(), change, field);
    };
    refused([](Welcome& w) { w.server_name.assign(65, 'x'); }, "Welcome.server_name");
    refused([](Welcome& w) { w.scene_name.assign(1025, 'x'); }, "Welcome.scene_name");
    refused([](Welcome& w) { w.codec.assign(65, 'x'); }, "Welcome.codec");
    refused([](Welcome& w) { w.sampling.assign(65, 'x'); }, "Welcome.sampling");
    refused([](Welcome& w) { w.renderer.assign(1025, 'x'); }, "Welcome.renderer");
    refused([](Welcome& w) { w.rank_tile_size_px = 63; }, "Welcome.rank_tile_size_px");
    refused([](Welcome& w) { w.rank_tile_size_px = 0; }, "Welcome.rank_tile_size_px");
    refused([](Welcome& w) { w.rank_tile_size_px = -64; }, "Welcome.rank_tile_size_px");
    refused([](Welcome& w) { w.rank_tile.pop_back(); }, "Welcome.rank_tile");
    refused([](Welcome& w) { w.world_from_start.orientation = glm::quat(0, 0, 0, 0); }, "Welcome.world_from_start");
}

TEST(Message, TrackIsValidated) {
    const auto refused = [](const std::function<void(Track&)>& change, const std::string& field) {
        expect_refused<Track>(Track{}, change, field);
    };
    refused([](Track& t) { t.pose_time_ns = std::numeric_limits<std::int64_t>::min(); }, "Track.pose_time_ns");
    refused([](Track& t) { t.gaze_time_ns = kMaxTime_ns + 1; }, "Track.gaze_time_ns");
    refused([](Track& t) { t.display_time_ns = -kMaxTime_ns - 1; }, "Track.display_time_ns");
    refused([](Track& t) { t.start_from_head.orientation.x = 0.1F; }, "Track.start_from_head");
    refused([](Track& t) { t.start_from_head.position_m.x = -2e6F; }, "Track.start_from_head");
    refused([](Track& t) { t.linear_velocity_m_s.z = kNaN; }, "Track.linear_velocity_m_s");
    refused([](Track& t) { t.angular_velocity_rad_s.y = kInfinity; }, "Track.angular_velocity_rad_s");
    refused([](Track& t) { t.gaze[0].direction.z = -0.99F; }, "Track.eyes[0].gaze.direction");
    refused([](Track& t) { t.gaze[1].direction.x = kNaN; }, "Track.eyes[1].gaze.direction");
    refused([](Track& t) { t.gaze[1].confidence = 1.5F; }, "Track.eyes[1].gaze.confidence");
}

TEST(Message, FrameIsValidated) {
    const auto refused = [](const std::function<void(Frame&)>& change, const std::string& field) {
        expect_refused<Frame>(some_frame(), change, field);
    };
    refused([](Frame& f) { f.pose_time_ns = kMaxTime_ns + 1; }, "Frame.pose_time_ns");
    refused([](Frame& f) { f.times.trace_ns = kMaxTime_ns + 1; }, "Frame.times");
    refused([](Frame& f) { f.world_from_eye[1].position_m.x = kNaN; }, "Frame.eyes[1].world_from_eye");
    refused([](Frame& f) { f.gaze[0] = glm::vec3(0.0F); }, "Frame.eyes[0].gaze");
    refused([](Frame& f) { f.sampling[0].phase_px.x = 256; }, "Frame.eyes[0].sampling.phase_px.x");
    refused([](Frame& f) { f.sampling[0].phase_px.y = -1; }, "Frame.eyes[0].sampling.phase_px.y");
    refused([](Frame& f) { f.sampling[1].tiles_x = 258; }, "Frame.eyes[1].sampling.level");
    refused([](Frame& f) { f.sampling[1].tiles_y = 0; }, "Frame.eyes[1].sampling.level");
    refused([](Frame& f) { f.sampling[1].tiles_y = 107; }, "Frame.eyes[1].sampling.level");
    refused([](Frame& f) { f.sampling[1].tiles_y = 105; }, "Frame.eyes[1].sampling.level");
    refused([](Frame& f) { f.sampling[1].level[17] = kMaxLevel + 1; }, "Frame.eyes[1].sampling.level");
    refused([](Frame& f) { f.traced = kMaxTraced + 1; }, "Frame.traced");
    refused([](Frame& f) { f.near_m = 0.0F; }, "Frame.near_m");
    refused([](Frame& f) { f.moving_map = {1}; }, "Frame.moving_map");
}

TEST(Message, MovingObjectsAreValidated) {
    Frame frame = some_frame();
    frame.moving.resize(kMaxMovingObjects);
    for (std::size_t i = 0; i < frame.moving.size(); ++i) frame.moving[i].id = static_cast<std::uint32_t>(3 * i);
    frame.moving_map = {1};
    const auto refused = [&frame](const std::function<void(Frame&)>& change, const std::string& field) {
        expect_refused<Frame>(frame, change, field);
    };
    refused([](Frame& f) { f.moving.push_back({1, {}, {}}); }, "Frame.moving");
    refused([](Frame& f) { f.moving[253].id = f.moving[7].id; }, "Frame.moving.id");
    refused([](Frame& f) { f.moving[9].world_from_object[3].z = kNaN; }, "Frame.moving.world_from_object");
    refused([](Frame& f) { f.moving[0].world_from_object[0].x = 2e6F; }, "Frame.moving.world_from_object");
    refused([](Frame& f) { f.moving[9].velocity_per_s[2].y = -kInfinity; }, "Frame.moving.velocity_per_s");
    refused([](Frame& f) { f.moving_map.clear(); }, "Frame.moving_map");
    refused([](Frame& f) { f.moving.clear(); }, "Frame.moving_map");
}

TEST(Message, AStillFrameHasNoByteOfMotion) {
    Frame frame = some_frame();
    const std::size_t still_bytes = encode_message(frame).size();
    frame.moving.resize(2);
    frame.moving[1].id = 1;
    frame.moving_map = {1, 2, 3, 4};
    const std::size_t moving_bytes = encode_message(frame).size();
    EXPECT_GE(moving_bytes, still_bytes + 2 * 100 + 4);
    EXPECT_LE(moving_bytes, still_bytes + 2 * 100 + 4 + 32) << "lengths, offsets and padding";
}

TEST(Message, SmallMessagesAreValidated) {
    expect_refused<Refused>(
        {}, [](Refused& r) { r.reason.assign(1025, 'x'); }, "Refused.reason");
    expect_refused<Bye>(
        {}, [](Bye& b) { b.reason = "\x1b[2J"; }, "Bye.reason");
    expect_refused<Ping>(
        {}, [](Ping& p) { p.sent_ns = kMaxTime_ns + 1; }, "Ping.sent_ns");
    expect_refused<Pong>(
        {}, [](Pong& p) { p.ping_sent_ns = kMaxTime_ns + 1; }, "Pong.ping_sent_ns");
    expect_refused<Pong>(
        {}, [](Pong& p) { p.answered_ns = kMaxTime_ns + 1; }, "Pong.answered_ns");
    expect_refused<FrameReport>(
        {}, [](FrameReport& r) { r.received_ns = kMaxTime_ns + 1; }, "FrameReport.received_ns");
    expect_refused<FrameReport>(
        {}, [](FrameReport& r) { r.decoded_ns = kMaxTime_ns + 1; }, "FrameReport.decoded_ns");
    expect_refused<FrameReport>(
        {}, [](FrameReport& r) { r.displayed_ns = -kMaxTime_ns - 1; }, "FrameReport.displayed_ns");
    const Choose choose{1, "27", false};
    expect_refused<Choose>(
        choose, [](Choose& c) { c.id = 0; }, "Choose.id");
    expect_refused<Choose>(
        choose, [](Choose& c) { c.sampling.clear(); }, "Choose.sampling");
    expect_refused<Choose>(
        choose, [](Choose& c) { c.sampling.assign(65, 'x'); }, "Choose.sampling");
    expect_refused<Chosen>(
        {}, [](Chosen& c) { c.problem.assign(1025, 'x'); }, "Chosen.problem");
    expect_refused<Chosen>(
        {}, [](Chosen& c) { c.problem = "two\nlines"; }, "Chosen.problem");
}

TEST(Message, HelloOfAnotherVersionIsReadForItsRefusal) {
    Hello hello = some_hello();
    hello.protocol_version = kProtocolVersion + 1;
    hello.eye_width_px = 30000;  // may be good in that version
    const Expected<Message> decoded = decode_message(encode_message(hello));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(std::get<Hello>(*decoded).protocol_version, kProtocolVersion + 1);
    EXPECT_EQ(std::get<Hello>(*decoded).client_name, "client");
}

TEST(Message, DirectionsAndRotationsAreNormalised) {
    Track track;
    track.start_from_head.orientation = glm::quat(0.6F, 0.0F, 0.8F, 0.0F) * 1.0008F;
    track.gaze[1].direction = glm::vec3(0.0F, 0.6F, -0.8F) * 0.9993F;
    const Expected<Message> decoded = decode_message(encode_message(track));
    ASSERT_TRUE(decoded) << decoded.error().message;
    const Track& result = std::get<Track>(*decoded);
    EXPECT_NEAR(glm::length(result.start_from_head.orientation), 1.0F, 1e-6F);
    EXPECT_NEAR(glm::length(result.gaze[1].direction), 1.0F, 1e-6F);
    EXPECT_NEAR(result.gaze[1].direction.y, 0.6F, 1e-6F);
}

TEST(Message, BytesThatAreNoMessageAreRefused) {
    EXPECT_FALSE(decode_message({}));
    EXPECT_FALSE(decode_message(Bytes(3)));
    EXPECT_FALSE(decode_message(Bytes(1000, std::byte{0xff})));
    EXPECT_FALSE(decode_message(Bytes(kMaxServerMessage_bytes + 1)));
    Bytes cut = encode_message(some_hello());
    cut.resize(cut.size() - 4);  // up to three bytes at the end may be padding
    for (; !cut.empty(); cut.pop_back()) ASSERT_FALSE(decode_message(cut)) << cut.size() << " bytes";
}

TEST(Message, MayLieAtAnyAddress) {
    const Bytes body = encode_message(some_frame());
    Bytes shifted(body.size() + 8);
    for (std::size_t shift = 0; shift < 8; ++shift) {
        std::copy(body.begin(), body.end(), shifted.begin() + static_cast<std::ptrdiff_t>(shift));
        const Expected<Message> decoded = decode_message(std::span(shifted).subspan(shift, body.size()));
        ASSERT_TRUE(decoded) << decoded.error().message;
        EXPECT_EQ(std::get<Frame>(*decoded).sampling[1].level, some_frame().sampling[1].level);
    }
}

TEST(Message, AFrameThatDoesNotSayIsExact) {
    // A default takes no bytes on the wire, so a frame whose ranks are exact is a frame from before there was the
    // field.
    Frame frame = some_frame();
    ASSERT_TRUE(frame.sampling[0].exact && frame.sampling[1].exact);
    const Bytes old = encode_message(frame);
    frame.sampling[1].exact = false;
    const Bytes said = encode_message(frame);
    EXPECT_LT(old.size(), said.size());
    EXPECT_TRUE(std::get<Frame>(*decode_message(old)).sampling[1].exact);
    EXPECT_TRUE(std::get<Frame>(*decode_message(said)).sampling[0].exact);
    EXPECT_FALSE(std::get<Frame>(*decode_message(said)).sampling[1].exact);
}

TEST(Message, AClientThatDoesNotSayAccumulates) {
    // As above: the Hello of a client from before there was the field.
    Hello hello = some_hello();
    ASSERT_TRUE(hello.accumulates);
    const Bytes old = encode_message(hello);
    hello.accumulates = false;
    const Bytes said = encode_message(hello);
    EXPECT_LT(old.size(), said.size());
    EXPECT_TRUE(std::get<Hello>(*decode_message(old)).accumulates);
    EXPECT_FALSE(std::get<Hello>(*decode_message(said)).accumulates);
}

TEST(Message, LimitOfLevelsIsThatOfMasks) {
    EXPECT_EQ(kMaxLevel, kFullLevel);
}

/// The worked example of PROTOCOL.md is what encode_message makes.
TEST(Message, WorkedExampleIsTrue) {
    std::ifstream page(MACULA_SOURCE_DIR "/protocol/PROTOCOL.md");
    std::stringstream text;
    text << page.rdbuf();
    const std::string content = text.str();
    const std::string mark = "<!-- ping -->\n```\n";
    const std::size_t found = content.find(mark);
    ASSERT_NE(found, std::string::npos) << "PROTOCOL.md has no example after " << mark;
    const std::size_t begin = found + mark.size();
    std::istringstream lines(content.substr(begin, content.find("```", begin) - begin));
    std::string documented;
    for (std::string line; std::getline(lines, line);) {
        documented += line.substr(0, line.find('|'));  // what follows is explanation
    }
    std::istringstream digits(documented);
    std::vector<int> bytes;
    for (std::string byte; digits >> byte;) bytes.push_back(std::stoi(byte, nullptr, 16));

    const Bytes body = encode_message(Ping{1'000'000'000});
    std::vector<int> framed;
    for (int shift = 0; shift < 32; shift += 8) framed.push_back(static_cast<int>((body.size() >> shift) & 0xff));
    for (const std::byte byte : body) framed.push_back(std::to_integer<int>(byte));
    EXPECT_EQ(bytes, framed);
}

}  // namespace
}  // namespace macula
