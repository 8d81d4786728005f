#include "protocol/codec/av_decoder.h"
#include "protocol/codec/av_encoder.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/color_convert.h"

namespace macula {
namespace {

class AvVideoEncoder final : public VideoEncoder {
public:
    AvVideoEncoder(AvEncoder encoder, int width_px, int height_px)
        : encoder_(std::move(encoder)), width_px_(width_px), height_px_(height_px) {}

    Expected<EncodedFrame> encode(const ColorImage& picture, bool force_keyframe) override {
        if (picture.width_px != width_px_ || picture.height_px != height_px_) {
            return fail(ErrorCode::internal, "a picture of " + std::to_string(picture.width_px) + "x" +
                                                 std::to_string(picture.height_px) + " went to an encoder of " +
                                                 std::to_string(width_px_) + "x" + std::to_string(height_px_));
        }
        const auto frame = encoder_.picture();
        if (!frame) return tl::unexpected(frame.error());
        const AVFrame& yuv = **frame;
        yuv420_from_rgba(picture,
                         {yuv.data[0], yuv.data[1], yuv.data[2], yuv.linesize[0], yuv.linesize[1], yuv.linesize[2]});
        return encoder_.encode(force_keyframe);
    }

private:
    AvEncoder encoder_;
    int width_px_;
    int height_px_;
};

class AvVideoDecoder final : public VideoDecoder {
public:
    explicit AvVideoDecoder(AvDecoder decoder) : decoder_(std::move(decoder)) {}

    Expected<void> decode(std::span<const std::uint8_t> bytes, ColorImage& picture) override {
        const auto frame = decoder_.decode(bytes);
        if (!frame) return tl::unexpected(frame.error());
        const AVFrame& yuv = **frame;
        if (yuv.format != AV_PIX_FMT_YUV420P || yuv.width % 2 != 0 || yuv.height % 2 != 0) {
            return fail(ErrorCode::protocol, "a stream that is not 8-bit 4:2:0 of limited range and even size");
        }
        if (picture.width_px != yuv.width || picture.height_px != yuv.height) {
            picture = ColorImage(yuv.width, yuv.height);
        }
        rgba_from_yuv420({yuv.data[0], yuv.data[1], yuv.data[2], yuv.linesize[0], yuv.linesize[1], yuv.linesize[2]},
                         picture);
        return {};
    }

private:
    AvDecoder decoder_;
};

}  // namespace

Expected<std::unique_ptr<VideoEncoder>> make_video_encoder(const VideoEncoderOptions& options) {
    if (options.width_px % 2 != 0 || options.height_px % 2 != 0) {
        return fail(ErrorCode::option, "4:2:0 video needs an even width and height, not " +
                                           std::to_string(options.width_px) + "x" + std::to_string(options.height_px));
    }
    if (options.bit_rate_bps < 100'000) {
        return fail(ErrorCode::option,
                    "the video bit rate must be at least 100000 bit/s, not " + std::to_string(options.bit_rate_bps));
    }
    auto encoder = AvEncoder::open({.codec = options.codec,
                                    .width_px = options.width_px,
                                    .height_px = options.height_px,
                                    .format = AV_PIX_FMT_YUV420P,
                                    .frame_rate_hz = options.frame_rate_hz,
                                    .bit_rate_bps = options.bit_rate_bps,
                                    .threads = options.threads});
    if (!encoder) return tl::unexpected(encoder.error());
    return std::make_unique<AvVideoEncoder>(std::move(*encoder), options.width_px, options.height_px);
}

Expected<std::unique_ptr<VideoDecoder>> make_video_decoder(const std::string& codec) {
    if (codec != "h264") {
        return fail(ErrorCode::option, "there is no video decoder for \"" + codec + "\"; this version has h264");
    }
    auto decoder = AvDecoder::open();
    if (!decoder) return tl::unexpected(decoder.error());
    return std::make_unique<AvVideoDecoder>(std::move(*decoder));
}

}  // namespace macula
