// Time of the codec's steps at the sizes of the two displays, both eyes side by side. Counters: p50, p99 and least
// time in ms, mean bytes of an access unit. libswscale does the same conversions for comparison.
#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

extern "C" {
#include <libavutil/frame.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "protocol/codec/codec.h"
#include "protocol/codec/color_convert.h"
#include "protocol/codec/depth_codec.h"
#include "protocol/codec/depth_plane.h"
#include "tests/support/codec_pictures.h"

namespace macula {
namespace {

constexpr std::size_t kPictures = 6;  // shown to and fro, so that neighbours in time resemble each other
constexpr float kNear_m = 0.25F;

/// Times of one step, reported as counters.
class StepTimes {
public:
    template <class Step>
    void time(Step step) {
        const auto begin = std::chrono::steady_clock::now();
        step();
        times_ms_.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    void report(benchmark::State& state) {
        std::ranges::sort(times_ms_);
        const std::size_t last = times_ms_.size() - 1;
        state.counters["min_ms"] = times_ms_.front();
        state.counters["p50_ms"] = times_ms_[last / 2];
        state.counters["p99_ms"] = times_ms_[last * 99 / 100];
    }
    /// The picture of the next step, to and fro.
    [[nodiscard]] std::size_t picture() const {
        const std::size_t k = times_ms_.size() % (2 * kPictures - 2);
        return k < kPictures ? k : 2 * kPictures - 2 - k;
    }

private:
    std::vector<double> times_ms_;
};

/// Smooth, text-like and noisy thirds, moving: made once for each size.
const std::vector<ColorImage>& pictures(int width, int height) {
    static std::vector<ColorImage> made;
    if (!made.empty() && made[0].width_px == width && made[0].height_px == height) return made;
    made.clear();
    for (int i = 0; i < static_cast<int>(kPictures); ++i) {
        ColorImage picture = smooth_picture(width, height, 3 * i);
        const ColorImage text = text_picture(width, height / 3, 3 * i);
        std::ranges::copy(text.texels, picture.row(height / 3));
        for (int y = 2 * (height / 3); y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const std::uint32_t grain =
                    hash(static_cast<std::uint32_t>(x + 3 * i), static_cast<std::uint32_t>(y)) & 0x0f0f0fU;
                picture.at(x, y) = (picture.at(x, y) & 0xfff0f0f0U) | grain;
            }
        }
        made.push_back(std::move(picture));
    }
    return made;
}

const std::vector<InverseDepthImage>& depths(int width, int height) {
    static std::vector<InverseDepthImage> made;
    if (!made.empty() && made[0].width_px == width && made[0].height_px == height) return made;
    made.clear();
    for (int i = 0; i < static_cast<int>(kPictures); ++i) made.push_back(room_depth(width, height, i));
    return made;
}

struct Planes {
    explicit Planes(const ColorImage& picture)
        : width(picture.width_px), y(picture.texels.size()), u(y.size() / 4), v(y.size() / 4) {}
    Yuv420Planes<std::uint8_t> out() { return {y.data(), u.data(), v.data(), width, width / 2, width / 2}; }
    [[nodiscard]] Yuv420Planes<const std::uint8_t> in() const {
        return {y.data(), u.data(), v.data(), width, width / 2, width / 2};
    }
    int width;
    std::vector<std::uint8_t> y, u, v;
};

void convert_to_yuv(benchmark::State& state) {
    const auto& frames = pictures(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    Planes planes(frames[0]);
    StepTimes times;
    for (auto _ : state) times.time([&] { yuv420_from_rgba(frames[times.picture()], planes.out()); });
    times.report(state);
}

void convert_to_rgba(benchmark::State& state) {
    const auto& frames = pictures(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    Planes planes(frames[0]);
    yuv420_from_rgba(frames[0], planes.out());
    ColorImage back = frames[0];
    StepTimes times;
    for (auto _ : state) times.time([&] { rgba_from_yuv420(planes.in(), back); });
    times.report(state);
}

/// The same by libswscale with range(2) threads, bilinear; range(3) is 1 for the way back.
void convert_by_libswscale(benchmark::State& state) {
    const auto& frames = pictures(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const bool back = state.range(3) != 0;
    const auto make = [&](AVPixelFormat format) {
        AVFrame* frame = av_frame_alloc();
        frame->width = frames[0].width_px;
        frame->height = frames[0].height_px;
        frame->format = format;
        av_frame_get_buffer(frame, 0);
        return frame;
    };
    AVFrame* rgb = make(AV_PIX_FMT_RGBA);
    AVFrame* yuv = make(AV_PIX_FMT_YUV420P);
    for (int y = 0; y < rgb->height; ++y) {
        std::copy_n(reinterpret_cast<const std::uint8_t*>(frames[0].row(y)), 4 * rgb->width,
                    rgb->data[0] + static_cast<std::ptrdiff_t>(y) * rgb->linesize[0]);
    }
    SwsContext* scaler = sws_alloc_context();
    av_opt_set_int(scaler, "srcw", rgb->width, 0);
    av_opt_set_int(scaler, "srch", rgb->height, 0);
    av_opt_set_int(scaler, "dstw", rgb->width, 0);
    av_opt_set_int(scaler, "dsth", rgb->height, 0);
    av_opt_set_int(scaler, "src_format", back ? AV_PIX_FMT_YUV420P : AV_PIX_FMT_RGBA, 0);
    av_opt_set_int(scaler, "dst_format", back ? AV_PIX_FMT_RGBA : AV_PIX_FMT_YUV420P, 0);
    av_opt_set_int(scaler, "sws_flags", SWS_BILINEAR, 0);
    av_opt_set_int(scaler, "threads", state.range(2), 0);
    if (sws_init_context(scaler, nullptr, nullptr) < 0) state.SkipWithError("libswscale refuses");
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(scaler, bt709, back ? 0 : 1, bt709, back ? 1 : 0, 0, 1 << 16, 1 << 16);
    sws_scale_frame(scaler, yuv, rgb);
    StepTimes times;
    for (auto _ : state) {
        times.time([&] { back ? sws_scale_frame(scaler, rgb, yuv) : sws_scale_frame(scaler, yuv, rgb); });
    }
    times.report(state);
    sws_freeContext(scaler);
    av_frame_free(&rgb);
    av_frame_free(&yuv);
}

std::unique_ptr<VideoEncoder> video_encoder(const ColorImage& picture) {
    return make_video_encoder({.width_px = picture.width_px, .height_px = picture.height_px}).value();
}

/// range(2): 1 forces a keyframe each time.
void encode_video(benchmark::State& state) {
    const auto& frames = pictures(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const auto encoder = video_encoder(frames[0]);
    double bytes = 0.0;
    StepTimes times;
    for (auto _ : state) {
        times.time([&] {
            const auto encoded = encoder->encode(frames[times.picture()], state.range(2) != 0);
            bytes += static_cast<double>(encoded.value().bytes.size());
        });
    }
    times.report(state);
    state.counters["bytes"] = benchmark::Counter(bytes, benchmark::Counter::kAvgIterations);
}

void decode_video(benchmark::State& state) {
    const auto& frames = pictures(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const auto encoder = video_encoder(frames[0]);
    const auto decoder = make_video_decoder("h264").value();
    ColorImage shown;
    StepTimes times;
    for (auto _ : state) {
        state.PauseTiming();
        const EncodedFrame encoded = encoder->encode(frames[times.picture()], false).value();
        state.ResumeTiming();
        times.time([&] {
            if (!decoder->decode(encoded.bytes, shown)) state.SkipWithError("not decoded");
        });
    }
    times.report(state);
}

std::unique_ptr<DepthEncoder> depth_encoder(const InverseDepthImage& full) {
    return make_depth_encoder({.width_px = full.width_px, .height_px = full.height_px}).value();
}

/// The share of encode_depth that is not libavcodec's.
void depth_codes(benchmark::State& state) {
    const auto& frames = depths(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    std::vector<std::uint8_t> codes(frames[0].texels.size() / 16);
    StepTimes times;
    for (auto _ : state) {
        times.time([&] {
            nearest_depth_codes(frames[times.picture()], kNear_m, codes.data(), frames[0].width_px / kDepthBlock_px);
        });
    }
    times.report(state);
}

void encode_depth(benchmark::State& state) {
    const auto& frames = depths(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const auto encoder = depth_encoder(frames[0]);
    double bytes = 0.0;
    StepTimes times;
    for (auto _ : state) {
        times.time([&] {
            const auto encoded = encoder->encode(frames[times.picture()], kNear_m, false);
            bytes += static_cast<double>(encoded.value().bytes.size());
        });
    }
    times.report(state);
    state.counters["bytes"] = benchmark::Counter(bytes, benchmark::Counter::kAvgIterations);
}

void decode_depth(benchmark::State& state) {
    const auto& frames = depths(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const auto encoder = depth_encoder(frames[0]);
    const auto decoder = make_depth_decoder().value();
    InverseDepthImage quarter;
    StepTimes times;
    for (auto _ : state) {
        state.PauseTiming();
        const EncodedFrame encoded = encoder->encode(frames[times.picture()], kNear_m, false).value();
        state.ResumeTiming();
        times.time([&] {
            if (!decoder->decode(encoded.bytes, kNear_m, quarter)) state.SkipWithError("not decoded");
        });
    }
    times.report(state);
}

void sizes(benchmark::internal::Benchmark* bench) {
    bench->Args({3024, 1680})->Args({1512, 840})->Unit(benchmark::kMillisecond)->Iterations(100);
}

BENCHMARK(convert_to_yuv)->Apply(sizes);
BENCHMARK(convert_to_rgba)->Apply(sizes);
BENCHMARK(convert_by_libswscale)
    ->ArgsProduct({{3024}, {1680}, {1, 2}, {0, 1}})
    ->ArgNames({"", "", "threads", "back"})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(50);
BENCHMARK(encode_video)
    ->ArgsProduct({{3024}, {1680}, {0, 1}})
    ->ArgsProduct({{1512}, {840}, {0, 1}})
    ->ArgNames({"", "", "keyframes"})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(100);
BENCHMARK(decode_video)->Apply(sizes);
BENCHMARK(depth_codes)->Apply(sizes);
BENCHMARK(encode_depth)->Apply(sizes);
BENCHMARK(decode_depth)->Apply(sizes);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
