#include "tests/support/random_messages.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "protocol/message/limits.h"

namespace macula {
namespace {

class Maker {
public:
    explicit Maker(std::mt19937& random) : random_(random) {}

    template <class Int>
    Int integer(Int low, Int high) {
        switch (random_() % 8) {
            case 0:
                return low;
            case 1:
                return high;
            default:
                return std::uniform_int_distribution<Int>(low, high)(random_);
        }
    }
    std::size_t count(std::size_t high) { return integer<std::size_t>(0, high); }
    float number(float low, float high) {
        switch (random_() % 8) {
            case 0:
                return low;
            case 1:
                return high;
            default:
                return low + (high - low) * std::generate_canonical<float, 24>(random_);
        }
    }
    bool flag() { return random_() % 2 == 0; }
    std::int64_t time() { return integer(-kMaxTime_ns, kMaxTime_ns); }
    std::string text(std::size_t max_bytes) {
        std::string text(count(max_bytes), ' ');
        for (char& c : text) c = static_cast<char>(integer(0x20, 0x7e));
        return text;
    }
    std::vector<std::uint8_t> bytes(std::size_t size, int highest) {
        std::vector<std::uint8_t> bytes(size);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(integer(0, highest));
        return bytes;
    }
    glm::vec3 vector() {
        glm::vec3 v;
        for (int i = 0; i < 3; ++i) v[i] = number(-kMaxMagnitude, kMaxMagnitude);
        return v;
    }
    glm::vec3 direction() {
        std::normal_distribution<float> normal;
        return glm::normalize(glm::vec3(normal(random_), normal(random_), normal(random_) + 1e-3F));
    }
    Pose pose() {
        std::normal_distribution<float> normal;
        const glm::quat q(normal(random_), normal(random_), normal(random_), normal(random_) + 1e-3F);
        return {glm::normalize(q), vector()};
    }
    EyeDisplayMessage eye_display() {
        EyeDisplayMessage eye;
        const float middle_x = number(-1.0F, 1.0F);
        const float middle_y = number(-1.0F, 1.0F);
        eye.tangents = {number(-kMaxTangent, middle_x - 0.1F), number(middle_x, kMaxTangent),
                        number(-kMaxTangent, middle_y - 0.1F), number(middle_y, kMaxTangent)};
        eye.head_from_eye = pose();
        if (flag()) {
            eye.visible_outline.resize(integer<std::size_t>(3, kMaxOutlinePoints));
            for (glm::vec2& point : eye.visible_outline) {
                point = {number(-kMaxTangent, kMaxTangent), number(-kMaxTangent, kMaxTangent)};
            }
        }
        return eye;
    }
    EyeSamplingMessage sampling() {
        EyeSamplingMessage sampling;
        sampling.phase_px = {integer(0, kMaxRankTile_px - 1), integer(0, kMaxRankTile_px - 1)};
        sampling.tiles_x = integer(1, kMaxTilesAcross);
        sampling.tiles_y = integer(1, kMaxTilesAcross);
        sampling.level = bytes(static_cast<std::size_t>(sampling.tiles_x * sampling.tiles_y), kMaxLevel);
        sampling.exact = flag();
        return sampling;
    }

    glm::mat4x3 affine() { return {vector(), vector(), vector(), vector()}; }

private:
    std::mt19937& random_;
};

Hello hello(Maker& make) {
    Hello hello;
    hello.client_name = make.text(kMaxName_bytes);
    hello.token = make.text(kMaxToken_bytes);
    hello.display_name = make.text(kMaxName_bytes);
    hello.eye_width_px = 4 * make.integer(kMinEyeEdge_px / 4, kMaxEyeEdge_px / 4);
    hello.eye_height_px = 4 * make.integer(kMinEyeEdge_px / 4, kMaxEyeEdge_px / 4);
    hello.refresh_hz = make.number(kMinRefresh_hz, kMaxRefresh_hz);
    hello.eyes = {make.eye_display(), make.eye_display()};
    hello.sampling = make.text(kMaxName_bytes);
    hello.codecs.resize(make.count(kMaxCodecs));
    for (std::string& codec : hello.codecs) codec = make.text(kMaxName_bytes);
    hello.accumulates = make.flag();
    return hello;
}

Welcome welcome(Maker& make) {
    Welcome welcome;
    welcome.protocol_version = make.integer<std::uint32_t>(0, 10);
    welcome.server_name = make.text(kMaxName_bytes);
    welcome.scene_name = make.text(kMaxText_bytes);
    welcome.codec = make.text(kMaxName_bytes);
    welcome.sampling = make.text(kMaxName_bytes);
    welcome.renderer = make.text(kMaxText_bytes);
    welcome.rank_tile_size_px = 16 * make.integer(1, kMaxRankTile_px / 16);
    welcome.rank_tile =
        make.bytes(static_cast<std::size_t>(welcome.rank_tile_size_px * welcome.rank_tile_size_px), 255);
    welcome.world_from_start = make.pose();
    welcome.can_choose = make.flag();
    return welcome;
}

Track track(Maker& make) {
    Track track;
    track.id = make.integer<std::uint64_t>(0, UINT64_MAX);
    track.pose_time_ns = make.time();
    track.gaze_time_ns = make.time();
    track.display_time_ns = make.time();
    track.start_from_head = make.pose();
    track.linear_velocity_m_s = make.vector();
    track.angular_velocity_rad_s = make.vector();
    for (GazeSample& gaze : track.gaze) gaze = {make.direction(), make.number(0.0F, 1.0F)};
    return track;
}

Frame frame(Maker& make) {
    Frame frame;
    frame.id = make.integer<std::uint64_t>(0, UINT64_MAX);
    frame.track_id = make.integer<std::uint64_t>(0, UINT64_MAX);
    frame.pose_time_ns = make.time();
    frame.gaze_time_ns = make.time();
    frame.display_time_ns = make.time();
    frame.world_from_eye = {make.pose(), make.pose()};
    frame.gaze = {make.direction(), make.direction()};
    frame.sampling = {make.sampling(), make.sampling()};
    frame.traced = make.integer<std::uint32_t>(0, kMaxTraced);
    frame.near_m = make.number(kMinNear_m, kMaxNear_m);
    frame.times = {make.time(), make.time(), make.time(), make.time(), make.time(), make.time(), make.time()};
    frame.keyframe = make.flag();
    frame.color = make.bytes(make.count(5000), 255);
    frame.depth = make.bytes(make.count(2000), 255);
    if (make.flag()) {
        const auto count = make.integer<std::uint32_t>(1, kMaxMovingObjects);
        for (std::uint32_t i = 0; i < count; ++i) frame.moving.push_back({i * 16777619U, make.affine(), make.affine()});
        frame.moving_map = make.bytes(1 + make.count(2000), 255);
    }
    frame.choice = make.integer<std::uint32_t>(0, UINT32_MAX);
    return frame;
}

}  // namespace

Message random_message(std::size_t kind, std::mt19937& random) {
    Maker make(random);
    switch (kind) {
        case 0:
            return hello(make);
        case 1:
            return welcome(make);
        case 2:
            return Refused{make.integer<std::uint32_t>(0, UINT32_MAX), make.text(kMaxText_bytes)};
        case 3:
            return track(make);
        case 4:
            return frame(make);
        case 5:
            return FrameReport{make.integer<std::uint64_t>(0, UINT64_MAX), make.time(), make.time(), make.time(),
                               make.flag()};
        case 6:
            return Ping{make.time()};
        case 7:
            return Pong{make.time(), make.time()};
        case 8:
            return Bye{make.text(kMaxText_bytes)};
        case 9:
            return Choose{make.integer<std::uint32_t>(1, UINT32_MAX), make.text(kMaxName_bytes - 1) + "x", make.flag()};
        default:
            return Chosen{make.integer<std::uint32_t>(0, UINT32_MAX), make.text(kMaxText_bytes)};
    }
}

}  // namespace macula
