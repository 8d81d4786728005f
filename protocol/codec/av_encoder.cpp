#include "protocol/codec/av_encoder.h"

extern "C" {
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <thread>

namespace macula {
namespace {

/// An encoder's own option. Where the encoder, or this build of it, has no such option, it goes without.
struct PrivateOption {
    const char* codec;
    const char* name;
    const char* value;
};

constexpr std::array kPrivateOptions = {
    PrivateOption{"libx264", "preset", "ultrafast"}, PrivateOption{"libx264", "tune", "zerolatency"},
    PrivateOption{"libx264", "forced-idr", "1"},     PrivateOption{"h264_nvenc", "preset", "p1"},
    PrivateOption{"h264_nvenc", "tune", "ull"},      PrivateOption{"h264_nvenc", "rc", "cbr"},
    PrivateOption{"h264_nvenc", "zerolatency", "1"}, PrivateOption{"h264_nvenc", "delay", "0"},
    PrivateOption{"h264_nvenc", "forced-idr", "1"},
};

/// Lossless by x264: transform bypass, and CABAC, which is a quarter smaller than ultrafast's CAVLC on depth.
constexpr std::array kLosslessOptions = {
    PrivateOption{"libx264", "qp", "0"},
    PrivateOption{"libx264", "coder", "cabac"},
};

std::string h264_encoders() {
    std::string names;
    void* position = nullptr;
    while (const AVCodec* codec = av_codec_iterate(&position)) {
        if (codec->id != AV_CODEC_ID_H264 || av_codec_is_encoder(codec) == 0) continue;
        if (!names.empty()) names += ", ";
        names += codec->name;
    }
    return names.empty() ? "none" : names;
}

bool accepts(const AVCodec& codec, AVPixelFormat format) {
    if (codec.pix_fmts == nullptr) return true;  // the encoder does not say; opening it will
    for (const AVPixelFormat* f = codec.pix_fmts; *f != AV_PIX_FMT_NONE; ++f) {
        if (*f == format) return true;
    }
    return false;
}

Expected<void> check(const AvEncoderOptions& o) {
    if (o.width_px < 16 || o.height_px < 16 || o.width_px > kMaxPictureWidth_px || o.height_px > kMaxPictureHeight_px) {
        return fail(ErrorCode::option, "a picture of " + std::to_string(o.width_px) + "x" +
                                           std::to_string(o.height_px) + " cannot be encoded; use 16x16 to " +
                                           std::to_string(kMaxPictureWidth_px) + "x" +
                                           std::to_string(kMaxPictureHeight_px));
    }
    if (!(o.frame_rate_hz >= 1.0 && o.frame_rate_hz <= 1000.0)) {
        return fail(ErrorCode::option,
                    "the encoder's frame rate must be 1 to 1000 Hz, not " + std::to_string(o.frame_rate_hz));
    }
    if (o.bit_rate_bps < 0 || o.bit_rate_bps > 1'000'000'000) {
        return fail(ErrorCode::option,
                    "the encoder's bit rate must be at most 1000000000 bit/s, not " + std::to_string(o.bit_rate_bps));
    }
    if (o.threads < 0 || o.threads > 64) {
        return fail(ErrorCode::option,
                    "the encoder's threads must be 0 (automatic) to 64, not " + std::to_string(o.threads));
    }
    return {};
}

void set_private_options(AVCodecContext& context, std::span<const PrivateOption> options) {
    for (const PrivateOption& o : options) {
        if (std::string_view(o.codec) == context.codec->name) av_opt_set(context.priv_data, o.name, o.value, 0);
    }
}

/// Each thread codes a slice of its own, and what slices cost in bits grows with their number.
int automatic_threads() {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U));
}

void configure(AVCodecContext& context, const AvEncoderOptions& o) {
    context.width = o.width_px;
    context.height = o.height_px;
    context.pix_fmt = o.format;
    context.framerate = av_d2q(o.frame_rate_hz, 100'000);
    context.time_base = av_inv_q(context.framerate);
    context.max_b_frames = 0;
    context.gop_size = std::numeric_limits<int>::max();  // keyframes only when they are asked for
    context.flags |= AV_CODEC_FLAG_LOW_DELAY;
    context.thread_type = FF_THREAD_SLICE;  // all threads work on the same picture: threads over pictures add delay
    context.thread_count = o.threads > 0 ? o.threads : automatic_threads();
    context.sample_aspect_ratio = {1, 1};
    set_private_options(context, kPrivateOptions);
    if (o.bit_rate_bps == 0) {
        context.color_range = AVCOL_RANGE_JPEG;
        set_private_options(context, kLosslessOptions);
        return;
    }
    context.bit_rate = o.bit_rate_bps;
    context.rc_max_rate = o.bit_rate_bps;
    // A rate buffer of one frame keeps a keyframe the size of any other frame.
    context.rc_buffer_size = static_cast<int>(std::lround(static_cast<double>(o.bit_rate_bps) / o.frame_rate_hz));
    context.color_range = AVCOL_RANGE_MPEG;
    context.colorspace = AVCOL_SPC_BT709;
    context.color_primaries = AVCOL_PRI_BT709;
    context.color_trc = AVCOL_TRC_IEC61966_2_1;
    context.chroma_sample_location = AVCHROMA_LOC_CENTER;
}

}  // namespace

Expected<AvEncoder> AvEncoder::open(const AvEncoderOptions& options) {
    const AVCodec* codec = avcodec_find_encoder_by_name(options.codec.c_str());
    if (codec == nullptr || codec->id != AV_CODEC_ID_H264) {
        return fail(ErrorCode::option,
                    "\"" + options.codec + "\" is not an H.264 encoder of this libavcodec; it has: " + h264_encoders());
    }
    if (!accepts(*codec, options.format)) {
        return fail(ErrorCode::option, "encoder " + options.codec + " does not take " +
                                           av_get_pix_fmt_name(options.format) +
                                           " pictures from memory; choose another of: " + h264_encoders());
    }
    if (auto valid = check(options); !valid) return tl::unexpected(valid.error());

    AvContext context = make_quiet_context(codec);
    AvFrame frame(av_frame_alloc());
    AvPacket packet(av_packet_alloc());
    if (!context || !frame || !packet) return fail(ErrorCode::internal, "no memory for a video encoder");
    configure(*context, options);
    if (const int error = avcodec_open2(context.get(), codec, nullptr); error < 0) {
        return fail(ErrorCode::option, "encoder " + options.codec + " cannot be opened for " +
                                           std::to_string(options.width_px) + "x" + std::to_string(options.height_px) +
                                           ": " + av_error_text(error) + "; libx264 runs on every machine");
    }
    frame->width = context->width;
    frame->height = context->height;
    frame->format = context->pix_fmt;
    if (av_frame_get_buffer(frame.get(), 0) < 0) return fail(ErrorCode::internal, "no memory for a video encoder");
    return AvEncoder(std::move(context), std::move(frame), std::move(packet));
}

Expected<AVFrame*> AvEncoder::picture() {
    if (av_frame_make_writable(frame_.get()) < 0) return fail(ErrorCode::internal, "no memory for a picture to encode");
    return frame_.get();
}

Expected<EncodedFrame> AvEncoder::encode(bool force_keyframe) {
    frame_->pts = pictures_++;
    frame_->pict_type = force_keyframe ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
    int error = avcodec_send_frame(context_.get(), frame_.get());
    if (error >= 0) error = avcodec_receive_packet(context_.get(), packet_.get());
    if (error < 0) {
        return fail(ErrorCode::internal, std::string("encoder ") + context_->codec->name +
                                             " gave no access unit for a picture: " + av_error_text(error));
    }
    EncodedFrame encoded;
    encoded.bytes.assign(packet_->data, packet_->data + packet_->size);
    encoded.keyframe = (packet_->flags & AV_PKT_FLAG_KEY) != 0;
    av_packet_unref(packet_.get());
    return encoded;
}

}  // namespace macula
