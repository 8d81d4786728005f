#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "protocol/base/image.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "protocol/message/message.h"

namespace macula {

/// A frame as the presenter gets it.
struct ReceivedFrame {
    Frame frame;              ///< its streams are decoded and emptied
    std::size_t bytes = 0;    ///< of the message
    ColorImage color;         ///< both eyes side by side
    InverseDepthImage depth;  ///< one value for each 4x4 block of `color`: its nearest surface
    /// Which of Frame::moving is seen in each of these blocks: 0, or its index + 1; empty if none moves.
    Image<std::uint8_t> moving_map;
    std::int64_t received_ns = 0;
    std::int64_t decoded_ns = 0;
    std::uint64_t connection = 0;  ///< counts connections: frames of different ones share no history
    std::shared_ptr<const Welcome> welcome;
};

/// The two decoders of one connection. Frames refer to the ones before, so each is decoded, and after one that
/// could not be, or that never came, nothing is until the next keyframe. Their ids, which have no gaps, tell what is
/// missing: the numbers in the streams come round again after 16 pictures. One thread at a time.
class FrameDecoder {
public:
    /// Errors: `option` when libavcodec has no decoder of that name.
    static Expected<FrameDecoder> make(const std::string& codec, int width_px, int height_px);

    /// Whether this frame came before, or comes after a newer one: it is of no use.
    [[nodiscard]] bool repeats(const Frame& frame) const { return frame.id <= newest_id_; }

    /// Decodes `frame.frame`, which does not repeat, into `frame.color`, `frame.depth` and `frame.moving_map`. Errors:
    /// `protocol`, also while a keyframe is waited for.
    Expected<void> decode(ReceivedFrame& frame);

private:
    Expected<void> decode_moving_map(ReceivedFrame& frame) const;

    FrameDecoder(std::unique_ptr<VideoDecoder> color, std::unique_ptr<DepthDecoder> depth, int width_px, int height_px)
        : color_(std::move(color)), depth_(std::move(depth)), width_px_(width_px), height_px_(height_px) {}

    std::unique_ptr<VideoDecoder> color_;
    std::unique_ptr<DepthDecoder> depth_;
    int width_px_;
    int height_px_;
    bool needs_keyframe_ = true;
    std::uint64_t newest_id_ = 0;  ///< of all frames that came
};

}  // namespace macula
