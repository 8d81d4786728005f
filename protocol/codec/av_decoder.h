#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/base/error.h"
#include "protocol/codec/av.h"

namespace macula {

/// Low-delay H.264 decoder through libavcodec: one access unit in, one picture out. After an access unit that is
/// broken, truncated or missing (a gap in the order of pictures), every further one fails until a keyframe comes: a
/// picture predicted from a wrong one is never shown. A gap of a multiple of the stream's frame number cycle (16 or
/// more pictures) and changed bits that still parse go unnoticed; the transport's authentication is what keeps bits.
/// One thread at a time.
///
/// It decodes on one thread: libavcodec finds missing macroblocks only there, and for 3024x1680 that is 4.6 ms
/// instead of 2.6 ms on two.
class AvDecoder {
public:
    /// Largest access unit that is looked at.
    static constexpr std::size_t kMaxAccessUnit_bytes = std::size_t{16} << 20;

    /// Errors: `option` when libavcodec lacks H.264, `internal` when memory is short.
    static Expected<AvDecoder> open();

    /// The picture stays valid until the next call. Errors: `protocol`.
    Expected<const AVFrame*> decode(std::span<const std::uint8_t> bytes);

private:
    AvDecoder(AvContext context, AvContext parser_context, AvParser parser, AvFrame frame, AvPacket packet)
        : context_(std::move(context)),
          parser_context_(std::move(parser_context)),
          parser_(std::move(parser)),
          frame_(std::move(frame)),
          packet_(std::move(packet)) {}

    Expected<void> check_order();
    Expected<void> decode_packet();

    AvContext context_;
    AvContext parser_context_;
    AvParser parser_;
    AvFrame frame_;
    AvPacket packet_;
    bool waits_for_keyframe_ = true;
    int picture_order_ = 0;       ///< of the last picture; 0 is a keyframe
    int picture_order_step_ = 0;  ///< 1 or 2, as the stream has it; 0: not known yet
};

}  // namespace macula
