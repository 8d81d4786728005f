// Streams that change their size while they run, as when a client comes back with another display and something between
// mixes the streams up: decoders follow, a client shows no picture of a size that it did not ask for, and goes on with
// its own.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "client/stream/frame_decoder.h"
#include "protocol/codec/depth_plane.h"
#include "tests/stability/case.h"
#include "tests/support/codec_pictures.h"

namespace macula::test {
namespace {

constexpr int kHeight_px = 128;

/// Codes smooth pictures and a room's depth.
class Stream {
public:
    explicit Stream(int width_px) : width_px_(width_px) {
        color_ = make_video_encoder({"libx264", width_px, kHeight_px, 90.0, 4'000'000, 1}).value();
        depth_ = make_depth_encoder({width_px, kHeight_px, 90.0, 1}).value();
    }
    [[nodiscard]] ColorImage picture(int i) const { return smooth_picture(width_px_, kHeight_px, 2 * i); }
    Frame frame(int i, bool keyframe) {
        Frame frame;
        frame.id = static_cast<std::uint64_t>(i) + 1;
        frame.near_m = 0.5F;
        EncodedFrame color = color_->encode(picture(i), keyframe).value();
        EncodedFrame depth = depth_->encode(room_depth(width_px_, kHeight_px, i), frame.near_m, keyframe).value();
        frame.keyframe = color.keyframe && depth.keyframe;
        frame.color = std::move(color.bytes);
        frame.depth = std::move(depth.bytes);
        return frame;
    }

private:
    int width_px_;
    std::unique_ptr<VideoEncoder> color_;
    std::unique_ptr<DepthEncoder> depth_;
};

TEST(Size, OfAStreamMayChangeAtAKeyframe) {
    const auto decoder = make_video_decoder("h264").value();
    const auto depth_decoder = make_depth_decoder().value();
    Stream small(256);
    Stream large(384);
    ColorImage shown;
    InverseDepthImage depth;
    double least_db = 99.0;
    int wrong = 0;
    int i = 0;
    for (int change = 0; change < 6; ++change) {
        Stream& stream = change % 2 == 0 ? small : large;
        for (int after = 0; after < 5; ++after, ++i) {
            const Frame frame = stream.frame(i, after == 0);
            const ColorImage picture = stream.picture(i);
            if (!decoder->decode(frame.color, shown) || !depth_decoder->decode(frame.depth, frame.near_m, depth) ||
                shown.width_px != picture.width_px || depth.width_px != picture.width_px / kDepthBlock_px) {
                ++wrong;
                continue;
            }
            least_db = std::min(least_db, psnr_db(shown, picture));
        }
    }
    check({"machinery/stream-changes-size", "pictures missing or of the wrong size", static_cast<double>(wrong),
           Side::at_most, 0.0, "a keyframe has the size with it"});
    check({"machinery/stream-changes-size", "least PSNR (dB)", least_db, Side::at_least, 30.0,
           "that of a stream that does not change: what was there before shows nowhere"});
}

TEST(Size, ThatWasNotAskedForIsNotShown) {
    FrameDecoder decoder = FrameDecoder::make("h264", 256, kHeight_px).value();
    Stream own(256);
    Stream other(384);
    constexpr int kFrames = 24;
    int wrong_shown = 0;
    int good_from = -1;
    double least_db = 99.0;
    for (int i = 0; i < kFrames; ++i) {
        const bool stray = i >= 8 && i < 12;
        ReceivedFrame received;
        // The own stream goes on with a keyframe three frames after the other's last.
        received.frame = stray ? other.frame(i, i == 8) : own.frame(i, i == 0 || i == 15);
        if (!decoder.decode(received)) continue;
        if (stray || received.color.width_px != 256 || (i >= 12 && i < 15)) ++wrong_shown;
        if (i >= 12 && good_from < 0) good_from = i;
        least_db = std::min(least_db, psnr_db(received.color, own.picture(i)));
    }
    check({"machinery/stray-stream", "pictures shown that were not asked for", static_cast<double>(wrong_shown),
           Side::at_most, 0.0, "those of another size, and those that were predicted from them"});
    check({"machinery/stray-stream", "frames from the keyframe until one is shown", good_from - 15.0, Side::at_most,
           0.0, "the keyframe is shown"});
    check({"machinery/stray-stream", "first frame shown after it", static_cast<double>(good_from), Side::at_least, 15.0,
           "none before the keyframe"});
    check({"machinery/stray-stream", "least PSNR (dB)", least_db, Side::at_least, 30.0, "that of a stream by itself"});
}

}  // namespace
}  // namespace macula::test
