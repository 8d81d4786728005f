#include "protocol/codec/av_decoder.h"

#include <algorithm>
#include <string>

namespace macula {

Expected<AvDecoder> AvDecoder::open() {
    const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_H264);
    AvParser parser(av_parser_init(AV_CODEC_ID_H264));
    if (codec == nullptr || !parser) return fail(ErrorCode::option, "this libavcodec has no H.264 decoder");
    AvContext context = make_quiet_context(codec);
    AvContext parser_context = make_quiet_context(nullptr);
    AvFrame frame(av_frame_alloc());
    AvPacket packet(av_packet_alloc());
    if (!context || !parser_context || !frame || !packet) {
        return fail(ErrorCode::internal, "no memory for a video decoder");
    }
    parser->flags |= PARSER_FLAG_COMPLETE_FRAMES;
    context->flags |= AV_CODEC_FLAG_LOW_DELAY;
    context->err_recognition = AV_EF_EXPLODE | AV_EF_BITSTREAM | AV_EF_BUFFER;
    context->max_pixels = std::int64_t{kMaxPictureWidth_px} * kMaxPictureHeight_px;
    context->thread_count = 1;
    if (const int error = avcodec_open2(context.get(), codec, nullptr); error < 0) {
        return fail(ErrorCode::internal, "the H.264 decoder cannot be opened: " + av_error_text(error));
    }
    return AvDecoder(std::move(context), std::move(parser_context), std::move(parser), std::move(frame),
                     std::move(packet));
}

Expected<const AVFrame*> AvDecoder::decode(std::span<const std::uint8_t> bytes) {
    if (bytes.empty() || bytes.size() > kMaxAccessUnit_bytes) {
        waits_for_keyframe_ = true;
        return fail(ErrorCode::protocol, "an access unit of " + std::to_string(bytes.size()) + " bytes; 1 to " +
                                             std::to_string(kMaxAccessUnit_bytes) + " are allowed");
    }
    // A fresh packet each time: it carries the padding that libavcodec's bit readers need.
    av_packet_unref(packet_.get());
    if (av_new_packet(packet_.get(), static_cast<int>(bytes.size())) < 0) {
        return fail(ErrorCode::internal, "no memory for an access unit");
    }
    std::ranges::copy(bytes, packet_->data);

    Expected<void> done = check_order();
    if (done) done = decode_packet();
    if (!done) {
        waits_for_keyframe_ = true;
        avcodec_flush_buffers(context_.get());
        return tl::unexpected(done.error());
    }
    waits_for_keyframe_ = false;
    return frame_.get();
}

Expected<void> AvDecoder::check_order() {
    parser_->key_frame = 0;
    parser_->output_picture_number = -1;
    std::uint8_t* unit = nullptr;
    int unit_size = 0;
    av_parser_parse2(parser_.get(), parser_context_.get(), &unit, &unit_size, packet_->data, packet_->size,
                     AV_NOPTS_VALUE, AV_NOPTS_VALUE, 0);
    const int order = parser_->output_picture_number;
    if (parser_->key_frame == 1 && order == 0) {
        picture_order_ = 0;
        picture_order_step_ = 0;
        return {};
    }
    if (waits_for_keyframe_) return fail(ErrorCode::protocol, "a picture without its reference; ask for a keyframe");
    const int step = order - picture_order_;
    const bool in_order = picture_order_step_ == 0 ? step == 1 || step == 2 : step == picture_order_step_;
    if (!in_order) {
        return fail(ErrorCode::protocol, "pictures are missing before this one (order " + std::to_string(order) +
                                             " after " + std::to_string(picture_order_) + "); ask for a keyframe");
    }
    picture_order_ = order;
    picture_order_step_ = step;
    return {};
}

Expected<void> AvDecoder::decode_packet() {
    int error = avcodec_send_packet(context_.get(), packet_.get());
    if (error >= 0) error = avcodec_receive_frame(context_.get(), frame_.get());
    if (error < 0) {
        return fail(ErrorCode::protocol,
                    "an access unit cannot be decoded: " + av_error_text(error) + "; ask for a keyframe");
    }
    const bool corrupt = (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame_->decode_error_flags != 0;
    const bool too_large = frame_->width > kMaxPictureWidth_px || frame_->height > kMaxPictureHeight_px;
    if (corrupt || too_large) {
        return fail(ErrorCode::protocol,
                    too_large ? "a picture of " + std::to_string(frame_->width) + "x" + std::to_string(frame_->height) +
                                    " is larger than " + std::to_string(kMaxPictureWidth_px) + "x" +
                                    std::to_string(kMaxPictureHeight_px)
                              : "an access unit with missing or damaged parts; ask for a keyframe");
    }
    return {};
}

}  // namespace macula
