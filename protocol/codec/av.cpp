#include "protocol/codec/av.h"

extern "C" {
#include <libavutil/error.h>
#include <libavutil/log.h>
}

#include <array>

namespace macula {

AvContext make_quiet_context(const AVCodec* codec) {
    AvContext context(avcodec_alloc_context3(codec));
    if (context) context->log_level_offset = AV_LOG_MAX_OFFSET;  // lifts every message above any level that is printed
    return context;
}

std::string av_error_text(int error) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(error, text.data(), text.size());
    return text.data();
}

}  // namespace macula
