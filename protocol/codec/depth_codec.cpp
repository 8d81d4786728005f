#include "protocol/codec/depth_codec.h"

#include <array>

#include "protocol/codec/av_decoder.h"
#include "protocol/codec/av_encoder.h"
#include "protocol/codec/depth_plane.h"

namespace macula {
namespace {

/// Keeps codes and inverse depths finite; false for not-a-number.
bool usable_near(float near_m) {
    return near_m >= 1e-4F && near_m <= 1e4F;
}

Error near_error(ErrorCode code, float near_m) {
    return {code, "a near depth of " + std::to_string(near_m) + " m; 0.0001 to 10000 are allowed"};
}

class AvDepthEncoder final : public DepthEncoder {
public:
    AvDepthEncoder(AvEncoder encoder, int width_px, int height_px)
        : encoder_(std::move(encoder)), width_px_(width_px), height_px_(height_px) {}

    Expected<EncodedFrame> encode(const InverseDepthImage& full, float near_m, bool force_keyframe) override {
        if (full.width_px != width_px_ || full.height_px != height_px_) {
            return fail(ErrorCode::internal, "a depth picture of " + std::to_string(full.width_px) + "x" +
                                                 std::to_string(full.height_px) + " went to an encoder of " +
                                                 std::to_string(width_px_) + "x" + std::to_string(height_px_));
        }
        if (!usable_near(near_m)) return tl::unexpected(near_error(ErrorCode::internal, near_m));
        const auto frame = encoder_.picture();
        if (!frame) return tl::unexpected(frame.error());
        nearest_depth_codes(full, near_m, (*frame)->data[0], (*frame)->linesize[0]);
        return encoder_.encode(force_keyframe);
    }

private:
    AvEncoder encoder_;
    int width_px_;
    int height_px_;
};

class AvDepthDecoder final : public DepthDecoder {
public:
    explicit AvDepthDecoder(AvDecoder decoder) : decoder_(std::move(decoder)) {}

    Expected<void> decode(std::span<const std::uint8_t> bytes, float near_m, InverseDepthImage& quarter) override {
        const auto frame = decoder_.decode(bytes);
        if (!frame) return tl::unexpected(frame.error());
        if (!usable_near(near_m)) return tl::unexpected(near_error(ErrorCode::protocol, near_m));
        const AVFrame& codes = **frame;
        // libavcodec decodes monochrome H.264 into 4:2:0 with grey chroma.
        if (codes.format != AV_PIX_FMT_YUVJ420P && codes.format != AV_PIX_FMT_GRAY8) {
            return fail(ErrorCode::protocol, "a depth stream that is not 8-bit monochrome of full range");
        }
        if (quarter.width_px != codes.width || quarter.height_px != codes.height) {
            quarter = InverseDepthImage(codes.width, codes.height);
        }
        std::array<float, kMaxDepthCode + 1> inverse_depth{};
        for (int code = 0; code <= kMaxDepthCode; ++code) {
            inverse_depth[code] = inverse_depth_of(static_cast<std::uint8_t>(code), near_m);
        }
        for (int y = 0; y < quarter.height_px; ++y) {
            const std::uint8_t* in = codes.data[0] + static_cast<std::ptrdiff_t>(y) * codes.linesize[0];
            float* out = quarter.row(y);
            for (int x = 0; x < quarter.width_px; ++x) out[x] = inverse_depth[in[x]];
        }
        return {};
    }

private:
    AvDecoder decoder_;
};

}  // namespace

Expected<std::unique_ptr<DepthEncoder>> make_depth_encoder(const DepthEncoderOptions& options) {
    if (options.width_px < 64 || options.height_px < 64 || options.width_px % (2 * kDepthBlock_px) != 0 ||
        options.height_px % kDepthBlock_px != 0) {
        return fail(ErrorCode::option,
                    "a depth stream needs a width that is a multiple of 8 and a height that is a "
                    "multiple of 4, each at least 64, not " +
                        std::to_string(options.width_px) + "x" + std::to_string(options.height_px));
    }
    auto encoder = AvEncoder::open({.codec = "libx264",
                                    .width_px = options.width_px / kDepthBlock_px,
                                    .height_px = options.height_px / kDepthBlock_px,
                                    .format = AV_PIX_FMT_GRAY8,
                                    .frame_rate_hz = options.frame_rate_hz,
                                    .bit_rate_bps = 0,
                                    .threads = options.threads});
    if (!encoder) return tl::unexpected(encoder.error());
    return std::make_unique<AvDepthEncoder>(std::move(*encoder), options.width_px, options.height_px);
}

Expected<std::unique_ptr<DepthDecoder>> make_depth_decoder() {
    auto decoder = AvDecoder::open();
    if (!decoder) return tl::unexpected(decoder.error());
    return std::make_unique<AvDepthDecoder>(std::move(*decoder));
}

}  // namespace macula
