// A whole server under a peer that moves its head and eyes and shows every frame at once: what the server alone
// can do, and where its time goes.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <thread>
#include <vector>

#include "masks/display.h"
#include "protocol/base/clock.h"
#include "scenes/load.h"
#include "tests/support/peer.h"
#include "tests/support/small_service.h"

namespace macula {
namespace {

Hello hello_of(const Display& display, const std::string& token, const std::string& sampling) {
    Hello hello;
    hello.token = token;
    hello.display_name = display.name;
    hello.eye_width_px = display.eye_width_px;
    hello.eye_height_px = display.eye_height_px;
    hello.refresh_hz = display.refresh_hz;
    hello.sampling = sampling;
    hello.codecs = {"h264"};
    for (std::size_t eye = 0; eye < kEyeCount; ++eye)
        hello.eyes[eye] = {display.eyes[eye].tangents, display.eyes[eye].head_from_eye,
                           display.eyes[eye].visible_outline};
    return hello;
}

/// Head and eyes that wander about the start pose.
Track wander(std::uint64_t id) {
    Track track;
    track.id = id;
    track.pose_time_ns = now_ns();
    track.gaze_time_ns = track.pose_time_ns;
    track.display_time_ns = track.pose_time_ns + 30'000'000;
    const float t = 0.005F * static_cast<float>(id);
    track.start_from_head.orientation = glm::angleAxis(0.3F * std::sin(0.7F * t), glm::vec3(0.0F, 1.0F, 0.0F));
    const float yaw = 0.3F * std::sin(2.3F * t);
    const float pitch = 0.2F * std::cos(1.7F * t);
    for (GazeSample& gaze : track.gaze)
        gaze.direction = glm::normalize(glm::vec3(std::tan(yaw), std::tan(pitch), -1.0F));
    return track;
}

/// Processor time of this process, all threads.
double cpu_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double percentile_ms(std::vector<std::int64_t>& durations_ns, double share) {
    if (durations_ns.empty()) return 0.0;
    const auto place =
        durations_ns.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(durations_ns.size() - 1));
    std::nth_element(durations_ns.begin(), place, durations_ns.end());
    return 1e-6 * static_cast<double>(*place);
}

void serve(benchmark::State& state, const std::string& display_name, const std::string& sampling) {
    Supplies supplies = testing::small_supplies();
    const auto scene = load_scene("bunny-box");
    const auto display = load_display(display_name);
    if (!scene || !display) return state.SkipWithError("no scene or display");
    supplies.scene = scene->scene;
    supplies.tracer = *make_embree_tracer(scene->scene);
    supplies.make_color_encoder = [](int width_px, int height_px, double frame_rate_hz) {
        return make_video_encoder({"libx264", width_px, height_px, frame_rate_hz, 25'000'000, 0});
    };
    testing::RunningServer server({}, supplies);
    testing::Peer peer(server.port(), server.credentials());
    peer.send(hello_of(*display, server.credentials().token, sampling));
    if (!peer.expect<Welcome>()) return state.SkipWithError("refused");

    std::jthread tracker([&peer](const std::stop_token& stop) {
        for (std::uint64_t id = 1; !stop.stop_requested(); ++id) {
            peer.send(wander(id));
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    });
    std::array<std::vector<std::int64_t>, 5> stages_ns;
    double traced = 0.0;
    double size_bytes = 0.0;
    double cpu_begin_ms = 0.0;
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;
    for (auto _ : state) {
        const auto frame = peer.expect<Frame>();
        if (!frame) return state.SkipWithError("no frame");
        last_ns = now_ns();
        if (first_ns == 0) {
            first_ns = last_ns;
            cpu_begin_ms = cpu_ms();
        }
        peer.send(FrameReport{frame->id, last_ns, last_ns, last_ns, false});
        const StageTimes& times = frame->times;
        stages_ns[0].push_back(times.plan_ns - times.begin_ns);
        stages_ns[1].push_back(times.trace_ns - times.plan_ns);
        stages_ns[2].push_back(times.reconstruct_ns - times.trace_ns);
        stages_ns[3].push_back(times.encode_ns - times.reconstruct_ns);
        stages_ns[4].push_back(last_ns - times.track_received_ns);
        traced += frame->traced;
        size_bytes += static_cast<double>(frame->color.size() + frame->depth.size());
    }
    const auto frames = static_cast<double>(stages_ns[0].size());
    const double pixels = 2.0 * display->eye_width_px * display->eye_height_px;
    state.counters["frames/s"] = (frames - 1.0) * 1e9 / static_cast<double>(last_ns - first_ns);
    state.counters["cpu_ms/frame"] = (cpu_ms() - cpu_begin_ms) / (frames - 1.0);
    state.counters["traced_%"] = 100.0 * traced / (frames * pixels);
    state.counters["frame_kB"] = 1e-3 * size_bytes / frames;
    constexpr std::array<const char*, 5> kNames = {"plan", "trace", "reconstruct", "encode", "age"};
    for (std::size_t stage = 0; stage < kNames.size(); ++stage) {
        state.counters[std::string(kNames[stage]) + "_p50_ms"] = percentile_ms(stages_ns[stage], 0.5);
        state.counters[std::string(kNames[stage]) + "_p99_ms"] = percentile_ms(stages_ns[stage], 0.99);
    }
}

BENCHMARK_CAPTURE(serve, desktop_18, "desktop", "18")->Iterations(200)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(serve, vive_18, "vive", "18")->Iterations(100)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
