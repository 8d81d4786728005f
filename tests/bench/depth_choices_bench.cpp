// The measurements behind the choices of the depth stream (protocol/codec/DEPTH.md): which value stands for a 4x4
// block, and how many bits, with or without loss. Run it with --benchmark_counters_tabular=true.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}

#include "protocol/codec/depth_plane.h"
#include "tests/support/codec_pictures.h"

namespace macula {
namespace {

constexpr int kWidth_px = 3024;
constexpr int kHeight_px = 1680;
constexpr int kSteps = 8;
constexpr float kNear_m = 0.25F;
// Errors are given as reprojection errors of the Vive after 5 mm.
constexpr float kFocal_px = 571.04F;
constexpr float kTranslation_m = 0.005F;

using Block = std::array<float, kDepthBlock_px * kDepthBlock_px>;
using BlockRule = float (*)(Block&);

float nearest(Block& block) {
    return *std::ranges::max_element(block);
}
float farthest(Block& block) {
    return *std::ranges::min_element(block);
}
float corner(Block& block) {
    return block[5];
}  // the pixel above and left of the centre
float median(Block& block) {
    std::ranges::nth_element(block, block.begin() + 8);
    return block[8];
}
float mean_over(const Block& block, float least) {
    float sum = 0.0F;
    float count = 0.0F;
    for (const float v : block) {
        if (v < least) continue;
        sum += v;
        count += 1.0F;
    }
    return sum / count;
}
float mean(Block& block) {
    return mean_over(block, 0.0F);
}
/// Mean of the pixels whose depth is within 5 % of the nearest one's: unbiased on planes, nearest at edges.
float mean_of_nearest(Block& block) {
    return mean_over(block, nearest(block) / 1.05F);
}

/// Reprojection error by keeping one value a block, without quantisation. An edge pixel lies in a block whose depths
/// differ by more than 5 %; it is in front when its own depth is within 5 % of the block's nearest.
void block_rule(benchmark::State& state, BlockRule rule) {
    static const InverseDepthImage kFull = room_depth(kWidth_px, kHeight_px);
    double inner = 0.0;
    double front = 0.0;
    double behind = 0.0;
    double inner_count = 0.0;
    double front_count = 0.0;
    double behind_count = 0.0;
    for (auto _ : state) {
        for (int y = 0; y < kHeight_px; y += kDepthBlock_px) {
            for (int x = 0; x < kWidth_px; x += kDepthBlock_px) {
                Block block{};
                for (int i = 0; i < 16; ++i) block[i] = kFull.at(x + i % 4, y + i / 4);
                const Block pixels = block;
                const float kept = rule(block);
                const auto [low, high] = std::ranges::minmax(pixels);
                for (const float v : pixels) {
                    const double error = reprojection_error_px(kFocal_px, kTranslation_m, kept - v);
                    const bool edge = high > 1.05F * low;
                    double& sum = !edge ? inner : v >= high / 1.05F ? front : behind;
                    (!edge ? inner_count : v >= high / 1.05F ? front_count : behind_count) += 1.0;
                    sum += error * error;
                }
            }
        }
    }
    state.counters["inner_rms_px"] = std::sqrt(inner / inner_count);
    state.counters["front_rms_px"] = std::sqrt(front / front_count);
    state.counters["behind_rms_px"] = std::sqrt(behind / behind_count);
    state.counters["all_rms_px"] = std::sqrt((inner + front + behind) / (inner_count + front_count + behind_count));
    state.counters["edge_share"] = (front_count + behind_count) / (inner_count + front_count + behind_count);
}

struct Stream {
    const char* encoder;
    int bits;
    const char* parameters;  ///< x264's
};

/// The nearest surface of each block of a moving head's pictures, 1/m.
const std::vector<InverseDepthImage>& quarters() {
    static const std::vector<InverseDepthImage> kQuarters = [] {
        std::vector<InverseDepthImage> made;
        for (int step = 0; step < kSteps; ++step) {
            const InverseDepthImage full = room_depth(kWidth_px, kHeight_px, step);
            InverseDepthImage quarter(kWidth_px / kDepthBlock_px, kHeight_px / kDepthBlock_px);
            for (int y = 0; y < kHeight_px; ++y) {
                for (int x = 0; x < kWidth_px; ++x) {
                    float& kept = quarter.at(x / kDepthBlock_px, y / kDepthBlock_px);
                    kept = std::max(kept, full.at(x, y));
                }
            }
            made.push_back(std::move(quarter));
        }
        return made;
    }();
    return kQuarters;
}

AVCodecContext* open_encoder(const Stream& stream, const InverseDepthImage& quarter) {
    const AVCodec* codec = avcodec_find_encoder_by_name(stream.encoder);
    AVCodecContext* context = avcodec_alloc_context3(codec);
    context->width = quarter.width_px;
    context->height = quarter.height_px;
    context->pix_fmt = stream.bits == 8 ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_GRAY10LE;
    context->time_base = {1, 90};
    context->color_range = AVCOL_RANGE_JPEG;
    context->thread_type = FF_THREAD_SLICE;
    context->thread_count = 2;
    context->log_level_offset = 64;
    if (codec->id == AV_CODEC_ID_H264) {
        context->gop_size = 1 << 30;
        av_opt_set(context->priv_data, "preset", "ultrafast", 0);
        av_opt_set(context->priv_data, "tune", "zerolatency", 0);
        av_opt_set(context->priv_data, "x264-params", stream.parameters, 0);
    } else {
        context->gop_size = 1;
        context->level = 3;
        context->slices = 4;
    }
    return avcodec_open2(context, codec, nullptr) < 0 ? nullptr : context;
}

/// Bytes, time and error of a stream: `max_px` and `rms_px` of quantisation and loss together.
void depth_stream(benchmark::State& state, Stream stream) {
    AVCodecContext* encoder = open_encoder(stream, quarters()[0]);
    AVCodecContext* decoder = avcodec_alloc_context3(avcodec_find_decoder(encoder->codec_id));
    decoder->width = encoder->width;
    decoder->height = encoder->height;
    decoder->log_level_offset = 64;
    decoder->thread_count = 1;
    if (encoder->codec_id == AV_CODEC_ID_FFV1) {
        decoder->extradata = static_cast<std::uint8_t*>(
            av_mallocz(encoder->extradata_size + static_cast<std::size_t>(AV_INPUT_BUFFER_PADDING_SIZE)));
        std::copy_n(encoder->extradata, encoder->extradata_size, decoder->extradata);
        decoder->extradata_size = encoder->extradata_size;
    }
    avcodec_open2(decoder, nullptr, nullptr);
    AVFrame* frame = av_frame_alloc();
    AVFrame* shown = av_frame_alloc();
    AVPacket* packet = av_packet_alloc();
    frame->width = encoder->width;
    frame->height = encoder->height;
    frame->format = encoder->pix_fmt;
    av_frame_get_buffer(frame, 0);

    const auto max_code = static_cast<float>((1 << stream.bits) - 1);
    const auto code_at = [&](const AVFrame& f, int x, int y) -> int {
        const std::uint8_t* row = f.data[0] + static_cast<std::ptrdiff_t>(y) * f.linesize[0];
        return stream.bits == 8 ? row[x] : row[2 * x] | row[2 * x + 1] << 8;
    };
    std::vector<double> encode_ms;
    double key_bytes = 0.0;
    double other_bytes = 0.0;
    double largest = 0.0;
    double squares = 0.0;
    int i = 0;
    for (auto _ : state) {
        const InverseDepthImage& quarter = quarters()[i % (2 * kSteps) < kSteps ? i % kSteps : kSteps - 1 - i % kSteps];
        av_frame_make_writable(frame);
        for (int y = 0; y < frame->height; ++y) {
            std::uint8_t* row = frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0];
            for (int x = 0; x < frame->width; ++x) {
                const auto code = static_cast<int>(std::lrint(std::min(1.0F, quarter.at(x, y) * kNear_m) * max_code));
                if (stream.bits == 8) {
                    row[x] = static_cast<std::uint8_t>(code);
                } else {
                    row[2 * x] = static_cast<std::uint8_t>(code & 255);
                    row[2 * x + 1] = static_cast<std::uint8_t>(code >> 8);
                }
            }
        }
        frame->pts = i;
        const auto begin = std::chrono::steady_clock::now();
        avcodec_send_frame(encoder, frame);
        const bool encoded = avcodec_receive_packet(encoder, packet) >= 0;
        encode_ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
        if (!encoded || avcodec_send_packet(decoder, packet) < 0 || avcodec_receive_frame(decoder, shown) < 0) {
            state.SkipWithError("no picture came back");
            break;
        }
        (i++ == 0 ? key_bytes : other_bytes) += packet->size;
        av_packet_unref(packet);
        for (int y = 0; y < frame->height; ++y) {
            for (int x = 0; x < frame->width; ++x) {
                const float back = static_cast<float>(code_at(*shown, x, y)) / max_code / kNear_m;
                const double error = reprojection_error_px(kFocal_px, kTranslation_m, back - quarter.at(x, y));
                largest = std::max(largest, std::abs(error));
                squares += error * error;
            }
        }
    }
    std::ranges::sort(encode_ms);
    state.counters["key_bytes"] = key_bytes;
    state.counters["P_bytes"] = other_bytes / (i - 1);
    state.counters["encode_min_ms"] = encode_ms.front();
    state.counters["encode_p50_ms"] = encode_ms[encode_ms.size() / 2];
    state.counters["max_px"] = largest;
    state.counters["rms_px"] = std::sqrt(squares / i / frame->width / frame->height);
    av_packet_free(&packet);
    av_frame_free(&shown);
    av_frame_free(&frame);
    avcodec_free_context(&decoder);
    avcodec_free_context(&encoder);
}

BENCHMARK_CAPTURE(block_rule, nearest, nearest)->Iterations(1);
BENCHMARK_CAPTURE(block_rule, mean_of_nearest, mean_of_nearest)->Iterations(1);
BENCHMARK_CAPTURE(block_rule, median, median)->Iterations(1);
BENCHMARK_CAPTURE(block_rule, mean, mean)->Iterations(1);
BENCHMARK_CAPTURE(block_rule, corner, corner)->Iterations(1);
BENCHMARK_CAPTURE(block_rule, farthest, farthest)->Iterations(1);

BENCHMARK_CAPTURE(depth_stream, x264_8bit_lossless_cabac, Stream{"libx264", 8, "qp=0:cabac=1"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, x264_8bit_lossless_cavlc, Stream{"libx264", 8, "qp=0"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, x264_8bit_qp4_cabac, Stream{"libx264", 8, "qp=4:cabac=1"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, x264_8bit_qp14_cabac, Stream{"libx264", 8, "qp=14:cabac=1"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, x264_10bit_lossless_cabac, Stream{"libx264", 10, "qp=0:cabac=1"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, x264_10bit_qp4_cabac, Stream{"libx264", 10, "qp=4:cabac=1"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, x264_10bit_qp10_cabac, Stream{"libx264", 10, "qp=10:cabac=1"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, x264_10bit_qp16_cabac, Stream{"libx264", 10, "qp=16:cabac=1"})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, ffv1_8bit, Stream{"ffv1", 8, ""})->Iterations(24);
BENCHMARK_CAPTURE(depth_stream, ffv1_10bit, Stream{"ffv1", 10, ""})->Iterations(24);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
