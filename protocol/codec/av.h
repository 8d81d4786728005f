#pragma once

#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace macula {

/// Largest picture that is encoded or decoded.
inline constexpr int kMaxPictureWidth_px = 8192;
inline constexpr int kMaxPictureHeight_px = 4096;

struct AvContextDeleter {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
};
struct AvFrameDeleter {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
struct AvPacketDeleter {
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
struct AvParserDeleter {
    void operator()(AVCodecParserContext* parser) const { av_parser_close(parser); }
};

using AvContext = std::unique_ptr<AVCodecContext, AvContextDeleter>;
using AvFrame = std::unique_ptr<AVFrame, AvFrameDeleter>;
using AvPacket = std::unique_ptr<AVPacket, AvPacketDeleter>;
using AvParser = std::unique_ptr<AVCodecParserContext, AvParserDeleter>;

/// A context for `codec` (which may be null) whose messages do not reach the process's standard error: errors come
/// back as values, and broken streams would flood the log. This is a property of the context; av_log_set_level, which
/// is the whole process's, stays with whoever owns the process. A few warnings that the H.264 decoder prints without
/// its context remain, such as for two pictures in one access unit. Null when memory is short.
AvContext make_quiet_context(const AVCodec* codec);

/// libav's text for one of its error numbers.
std::string av_error_text(int error);

}  // namespace macula
