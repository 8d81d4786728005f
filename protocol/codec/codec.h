#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/error.h"
#include "protocol/base/image.h"

namespace macula {

/// What a video encoder is opened with.
struct VideoEncoderOptions {
    std::string codec = "libx264";  ///< libavcodec encoder name; hardware encoders by theirs
    int width_px = 0;               ///< both eyes side by side; even
    int height_px = 0;
    double frame_rate_hz = 90.0;  ///< for rate control
    std::int64_t bit_rate_bps = 25'000'000;
    int threads = 0;  ///< 0: one for each core, at most 8
};

/// One encoded picture.
struct EncodedFrame {
    std::vector<std::uint8_t> bytes;
    bool keyframe = false;
};

/// Low-delay video encoder: one picture in, one access unit out, no reordering. One thread at a time.
class VideoEncoder {
public:
    VideoEncoder() = default;
    VideoEncoder(const VideoEncoder&) = delete;
    VideoEncoder& operator=(const VideoEncoder&) = delete;
    virtual ~VideoEncoder() = default;
    /// Encodes a picture of the options' size; `force_keyframe` makes it decodable on its own.
    virtual Expected<EncodedFrame> encode(const ColorImage& picture, bool force_keyframe) = 0;
};

/// Counterpart of VideoEncoder. Malformed input yields `protocol`; the decoder then recovers at the next
/// keyframe. One thread at a time.
class VideoDecoder {
public:
    VideoDecoder() = default;
    VideoDecoder(const VideoDecoder&) = delete;
    VideoDecoder& operator=(const VideoDecoder&) = delete;
    virtual ~VideoDecoder() = default;
    virtual Expected<void> decode(std::span<const std::uint8_t> bytes, ColorImage& picture) = 0;
};

/// Errors: `option` when libavcodec has no such encoder or it refuses the options.
Expected<std::unique_ptr<VideoEncoder>> make_video_encoder(const VideoEncoderOptions& options);

/// `codec` is the protocol's name ("h264"). Errors: `option` for an unknown name.
Expected<std::unique_ptr<VideoDecoder>> make_video_decoder(const std::string& codec);

}  // namespace macula
