// What a frame costs to put into bytes and to read back, and how small its level maps become.

#include <cmath>
#include <random>

#include <benchmark/benchmark.h>

#include "protocol/message/message.h"

namespace {

constexpr int kTilesX = 96;  // 1512 x 1680 pixels an eye
constexpr int kTilesY = 106;

/// A frame as the server sends it: levels that fall with the distance from the gaze, with hysteresis' ragged
/// edges; compressed pictures look like noise.
macula::Frame typical_frame() {
    std::mt19937 random(1);
    macula::Frame frame;
    for (std::size_t eye = 0; eye < 2; ++eye) {
        frame.gaze[eye] = {0.0F, 0.0F, -1.0F};
        macula::EyeSamplingMessage& sampling = frame.sampling[eye];
        sampling = {{17, 42}, kTilesX, kTilesY, {}};
        for (int y = 0; y < kTilesY; ++y) {
            for (int x = 0; x < kTilesX; ++x) {
                const double distance = std::hypot(x - 0.5 * kTilesX, y - 0.5 * kTilesY);
                const double ragged = static_cast<double>(random() % 100) < 20 ? 1.0 : 0.0;
                const double level = distance > 55 ? 0.0 : 21.0 - 0.35 * distance + ragged;
                sampling.level.push_back(static_cast<std::uint8_t>(std::clamp(level, 0.0, 21.0)));
            }
        }
    }
    for (int i = 0; i < 35'000; ++i) frame.color.push_back(static_cast<std::uint8_t>(random()));
    for (int i = 0; i < 5'000; ++i) frame.depth.push_back(static_cast<std::uint8_t>(random()));
    return frame;
}

void encode_frame(benchmark::State& state) {
    const macula::Message frame = typical_frame();
    std::size_t size = 0;
    for (auto _ : state) {
        const macula::Bytes body = macula::encode_message(frame);
        size = body.size();
        benchmark::DoNotOptimize(body.data());
    }
    const std::size_t pictures = std::size_t{35'000} + 5'000;
    state.counters["levels_bytes"] = 2.0 * kTilesX * kTilesY;
    state.counters["body_without_pictures_bytes"] = static_cast<double>(size - pictures);
}

void decode_frame(benchmark::State& state) {
    const macula::Bytes body = macula::encode_message(typical_frame());
    for (auto _ : state) benchmark::DoNotOptimize(macula::decode_message(body));
}

void encode_track(benchmark::State& state) {
    const macula::Message track = macula::Track{};
    for (auto _ : state) benchmark::DoNotOptimize(macula::encode_message(track));
}

void decode_track(benchmark::State& state) {
    const macula::Bytes body = macula::encode_message(macula::Track{});
    for (auto _ : state) benchmark::DoNotOptimize(macula::decode_message(body));
}

BENCHMARK(encode_frame)->Unit(benchmark::kMicrosecond);
BENCHMARK(decode_frame)->Unit(benchmark::kMicrosecond);
BENCHMARK(encode_track)->Unit(benchmark::kMicrosecond);
BENCHMARK(decode_track)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
