#pragma once

#include <cstdint>
#include <string>

#include "protocol/base/error.h"
#include "protocol/codec/av.h"
#include "protocol/codec/codec.h"

namespace macula {

/// What an AvEncoder is opened with.
struct AvEncoderOptions {
    std::string codec;  ///< libavcodec encoder name
    int width_px = 0;
    int height_px = 0;
    AVPixelFormat format = AV_PIX_FMT_NONE;
    double frame_rate_hz = 90.0;
    std::int64_t bit_rate_bps = 0;  ///< 0: lossless, at whatever rate that takes
    int threads = 0;                ///< 0: one for each core, at most 8
};

/// Low-delay H.264 encoder of raw pictures through libavcodec: one picture in, one access unit out; no B frames, no
/// keyframes but the first and the forced ones, parameter sets repeated in each keyframe. One thread at a time.
class AvEncoder {
public:
    /// Errors: `option`; an unknown name lists the H.264 encoders that this libavcodec has.
    static Expected<AvEncoder> open(const AvEncoderOptions& options);

    /// The picture to fill before encode(); its planes stay valid until then. Errors: `internal`, memory is short.
    Expected<AVFrame*> picture();

    /// Encodes what picture() holds.
    Expected<EncodedFrame> encode(bool force_keyframe);

private:
    AvEncoder(AvContext context, AvFrame frame, AvPacket packet)
        : context_(std::move(context)), frame_(std::move(frame)), packet_(std::move(packet)) {}

    AvContext context_;
    AvFrame frame_;
    AvPacket packet_;
    std::int64_t pictures_ = 0;
};

}  // namespace macula
