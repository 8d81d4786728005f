#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "protocol/base/error.h"
#include "protocol/base/image.h"
#include "protocol/codec/codec.h"

namespace macula {

/// What a depth encoder is opened with: the size of the full picture, both eyes side by side. The width is a multiple
/// of 8, so that no block lies in both eyes, the height of 4; 64x64 at least.
struct DepthEncoderOptions {
    int width_px = 0;
    int height_px = 0;
    double frame_rate_hz = 90.0;
    int threads = 0;  ///< 0: one for each core, at most 8
};

/// Encodes inverse depth as a quarter-resolution plane of 8-bit codes (depth_plane.h), without loss, in an H.264 stream
/// of its own. The stream does not carry near_m: it travels with the frame. Its keyframes are the first picture and
/// the forced ones, so a caller who forces those of colour and depth together gets them together. One thread at a
/// time.
class DepthEncoder {
public:
    DepthEncoder() = default;
    DepthEncoder(const DepthEncoder&) = delete;
    DepthEncoder& operator=(const DepthEncoder&) = delete;
    virtual ~DepthEncoder() = default;
    /// `near_m` > 0 is the depth of the largest code. It may differ from frame to frame; each change costs bytes, since
    /// it shifts all codes.
    virtual Expected<EncodedFrame> encode(const InverseDepthImage& full, float near_m, bool force_keyframe) = 0;
};

/// Counterpart of DepthEncoder. Malformed input yields `protocol`; the decoder then recovers at the next keyframe.
/// One thread at a time.
class DepthDecoder {
public:
    DepthDecoder() = default;
    DepthDecoder(const DepthDecoder&) = delete;
    DepthDecoder& operator=(const DepthDecoder&) = delete;
    virtual ~DepthDecoder() = default;
    /// `quarter` gets one inverse depth (1/m) for each 4x4 block of the full picture; 0 is nothing hit.
    virtual Expected<void> decode(std::span<const std::uint8_t> bytes, float near_m, InverseDepthImage& quarter) = 0;
};

/// Errors: `option` for a size that does not fit, or a libavcodec without libx264.
Expected<std::unique_ptr<DepthEncoder>> make_depth_encoder(const DepthEncoderOptions& options);

/// Errors: `option` when libavcodec has no H.264 decoder.
Expected<std::unique_ptr<DepthDecoder>> make_depth_decoder();

}  // namespace macula
