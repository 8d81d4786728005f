#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "protocol/codec/codec.h"
#include "protocol/codec/color_convert.h"
#include "protocol/codec/depth_codec.h"
#include "tests/support/codec_pictures.h"

namespace macula {
namespace {

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 176;

VideoEncoderOptions options(std::int64_t bit_rate_bps = 4'000'000) {
    VideoEncoderOptions o;
    o.width_px = kWidth_px;
    o.height_px = kHeight_px;
    o.bit_rate_bps = bit_rate_bps;
    o.threads = 2;
    return o;
}

std::unique_ptr<VideoEncoder> encoder(const VideoEncoderOptions& o = options()) {
    auto made = make_video_encoder(o);
    if (!made) ADD_FAILURE() << made.error().message;
    return made ? std::move(*made) : nullptr;
}

std::unique_ptr<VideoDecoder> decoder() {
    auto made = make_video_decoder("h264");
    if (!made) ADD_FAILURE() << made.error().message;
    return made ? std::move(*made) : nullptr;
}

/// Access units of the moving smooth picture; each in `keyframes` is forced to be a keyframe.
std::vector<EncodedFrame> stream(int count, const std::vector<int>& keyframes = {}) {
    const auto e = encoder();
    std::vector<EncodedFrame> units;
    for (int i = 0; i < count; ++i) {
        const bool force = std::ranges::find(keyframes, i) != keyframes.end();
        units.push_back(e->encode(smooth_picture(kWidth_px, kHeight_px, 2 * i), force).value());
    }
    return units;
}

std::string option_error(const VideoEncoderOptions& o) {
    const auto made = make_video_encoder(o);
    if (made) return "accepted";
    EXPECT_EQ(made.error().code, ErrorCode::option);
    return made.error().message;
}

struct Planes {
    explicit Planes(int width, int height)
        : chroma_width(width / 2), y(width * height), u(width * height / 4), v(width * height / 4) {}
    Yuv420Planes<std::uint8_t> out() {
        return {y.data(), u.data(), v.data(), 2 * chroma_width, chroma_width, chroma_width};
    }
    [[nodiscard]] Yuv420Planes<const std::uint8_t> in() const {
        return {y.data(), u.data(), v.data(), 2 * chroma_width, chroma_width, chroma_width};
    }
    int chroma_width;
    std::vector<std::uint8_t> y, u, v;
};

TEST(ColorConvert, PrimariesHaveTheCodesOfBt709) {
    // BT.709, limited range: Y' = 16 + 219 (.2126 R + .7152 G + .0722 B), Cb and Cr = 128 + 224 (B - Y) / 1.8556 and
    // 128 + 224 (R - Y) / 1.5748.
    struct Case {
        Rgba8 rgba;
        int y, u, v;
    };
    for (const Case& c :
         {Case{0xff000000U, 16, 128, 128}, Case{0xffffffffU, 235, 128, 128}, Case{0xff0000ffU, 63, 102, 240},
          Case{0xff00ff00U, 173, 42, 26}, Case{0xffff0000U, 32, 240, 118}}) {
        Planes planes(2, 2);
        yuv420_from_rgba(ColorImage(2, 2, c.rgba), planes.out());
        EXPECT_EQ(planes.y[0], c.y) << std::hex << c.rgba;
        EXPECT_EQ(planes.u[0], c.u) << std::hex << c.rgba;
        EXPECT_EQ(planes.v[0], c.v) << std::hex << c.rgba;
    }
}

TEST(ColorConvert, EveryGreyComesBackWithinOneCode) {
    for (Rgba8 grey = 0; grey < 256; ++grey) {
        Planes planes(2, 2);
        yuv420_from_rgba(ColorImage(2, 2, grey * 0x010101U | 0xff000000U), planes.out());
        ColorImage back(2, 2);
        rgba_from_yuv420(planes.in(), back);
        const Rgba8 c = back.at(1, 1);
        EXPECT_EQ(c >> 24, 255U);
        EXPECT_EQ(c & 255U, c >> 8 & 255U);
        EXPECT_EQ(c & 255U, c >> 16 & 255U);
        EXPECT_NEAR(static_cast<int>(c & 255U), static_cast<int>(grey), 1);
    }
}

TEST(ColorConvert, ChromaIsTheMeanOfItsFourPixels) {
    ColorImage picture(4, 2, 0xff000000U);
    picture.at(0, 0) = 0xff0000ffU;  // one red of four: a quarter of red's distance from grey
    Planes planes(4, 2);
    yuv420_from_rgba(picture, planes.out());
    EXPECT_EQ(planes.v[0], 128 + (240 - 128) / 4);
    EXPECT_EQ(planes.v[1], 128);
    EXPECT_EQ(planes.y[0], 63);
    EXPECT_EQ(planes.y[1], 16);
}

TEST(VideoEncoder, UnknownNameListsTheEncoders) {
    auto o = options();
    o.codec = "h265_magic";
    const std::string message = option_error(o);
    EXPECT_NE(message.find("h265_magic"), std::string::npos) << message;
    EXPECT_NE(message.find("libx264"), std::string::npos) << message;
    o.codec = "mpeg4";  // exists, but is no H.264
    EXPECT_NE(option_error(o).find("libx264"), std::string::npos);
}

TEST(VideoEncoder, EveryListedEncoderWorksOrSaysWhatToDo) {
    auto o = options();
    o.codec = "none";
    std::string names = option_error(o);
    names = names.substr(names.rfind(':') + 2) + ", ";
    std::vector<std::string> working;
    for (std::size_t at = 0; at < names.size(); at = names.find(", ", at) + 2) {
        o.codec = names.substr(at, names.find(", ", at) - at);
        const auto made = make_video_encoder(o);
        if (!made) {
            EXPECT_EQ(made.error().code, ErrorCode::option);
            EXPECT_NE(made.error().message.find(o.codec), std::string::npos) << made.error().message;
            EXPECT_NE(made.error().message.find("libx264"), std::string::npos) << made.error().message;
            std::printf("%s\n", made.error().message.c_str());
            continue;
        }
        const auto encoded = (*made)->encode(smooth_picture(kWidth_px, kHeight_px), true);
        ASSERT_TRUE(encoded) << encoded.error().message;
        EXPECT_TRUE(encoded->keyframe) << o.codec;
        working.push_back(o.codec);
    }
    EXPECT_NE(std::ranges::find(working, "libx264"), working.end());
}

TEST(VideoEncoder, RefusesSizesAndRatesByName) {
    auto o = options();
    o.width_px = 321;
    EXPECT_NE(option_error(o).find("even width and height, not 321x176"), std::string::npos);
    o = options();
    o.height_px = 175;
    EXPECT_NE(option_error(o).find("320x175"), std::string::npos);
    o = options();
    o.width_px = 16384;
    EXPECT_NE(option_error(o).find("8192x4096"), std::string::npos);
    o = options();
    o.width_px = 0;
    EXPECT_NE(option_error(o).find("16x16"), std::string::npos);
    o = options();
    o.frame_rate_hz = 0.0;
    EXPECT_NE(option_error(o).find("frame rate"), std::string::npos);
    EXPECT_NE(option_error(options(0)).find("bit rate"), std::string::npos);
    o = options();
    o.threads = -1;
    EXPECT_NE(option_error(o).find("threads"), std::string::npos);
}

TEST(VideoEncoder, RefusesAPictureOfAnotherSize) {
    const auto e = encoder();
    const auto encoded = e->encode(ColorImage(kWidth_px, kHeight_px - 2), false);
    ASSERT_FALSE(encoded);
    EXPECT_NE(encoded.error().message.find("320x174"), std::string::npos) << encoded.error().message;
}

TEST(VideoDecoder, RefusesAnUnknownCodec) {
    const auto made = make_video_decoder("vp8");
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::option);
    EXPECT_NE(made.error().message.find("h264"), std::string::npos);
}

TEST(VideoCodec, RoundTripKeepsTheQualityThatTheRateBuys) {
    struct Case {
        const char* name;
        ColorImage (*picture)(int, int, int);
        std::int64_t bit_rate_bps;
        double psnr_db;  // about 3 dB below what was measured
    };
    const auto noise = [](int w, int h, int i) { return noise_picture(w, h, static_cast<std::uint32_t>(i)); };
    for (const Case& c : {Case{"smooth", smooth_picture, 500'000, 32.0},
                          Case{"smooth", smooth_picture, 4'000'000, 45.0}, Case{"text", text_picture, 4'000'000, 34.0},
                          Case{"text", text_picture, 30'000'000, 38.0}, Case{"noise", noise, 60'000'000, 42.0}}) {
        const auto e = encoder(options(c.bit_rate_bps));
        const auto d = decoder();
        ColorImage shown;
        double psnr = 0.0;
        for (int i = 0; i < 12; ++i) {
            const ColorImage picture = c.picture(kWidth_px, kHeight_px, i);
            const auto encoded = e->encode(picture, false);
            ASSERT_TRUE(encoded) << encoded.error().message;
            EXPECT_EQ(encoded->keyframe, i == 0);
            const auto decoded = d->decode(encoded->bytes, shown);
            ASSERT_TRUE(decoded) << decoded.error().message;
            ASSERT_EQ(shown.width_px, kWidth_px);
            ASSERT_EQ(shown.height_px, kHeight_px);
            psnr = psnr_db(picture, shown);
        }
        EXPECT_GT(psnr, c.psnr_db) << c.name << " at " << c.bit_rate_bps << " bit/s";
        std::printf("%s at %lld bit/s: %.1f dB\n", c.name, static_cast<long long>(c.bit_rate_bps), psnr);
    }
}

TEST(VideoCodec, ForcedKeyframeIsEnoughForAFreshDecoder) {
    const auto units = stream(8, {5});
    for (int i = 0; i < 8; ++i) EXPECT_EQ(units[i].keyframe, i == 0 || i == 5) << i;
    const auto d = decoder();
    ColorImage shown;
    for (int i = 5; i < 8; ++i) {
        const auto decoded = d->decode(units[i].bytes, shown);
        ASSERT_TRUE(decoded) << decoded.error().message;
        EXPECT_GT(psnr_db(smooth_picture(kWidth_px, kHeight_px, 2 * i), shown), 30.0);
    }
}

TEST(VideoDecoder, StartsOnlyAtAKeyframe) {
    const auto units = stream(4, {3});
    const auto d = decoder();
    ColorImage shown;
    for (int i = 1; i < 3; ++i) {
        const auto decoded = d->decode(units[i].bytes, shown);
        ASSERT_FALSE(decoded);
        EXPECT_EQ(decoded.error().code, ErrorCode::protocol);
    }
    EXPECT_TRUE(d->decode(units[3].bytes, shown));
}

/// Feeds a stream in which unit 4 is replaced (empty vector: left out) and expects failure from unit 4 or 5 to the
/// keyframe 8, and pictures of full quality elsewhere.
void expect_recovery(const std::vector<EncodedFrame>& units, const std::vector<std::uint8_t>& fourth) {
    const auto d = decoder();
    ColorImage shown;
    for (int i = 0; i < 12; ++i) {
        if (i == 4 && fourth.empty()) continue;
        const auto decoded = d->decode(i == 4 ? fourth : units[i].bytes, shown);
        ASSERT_EQ(decoded.has_value(), i < 4 || i >= 8) << "unit " << i;
        if (!decoded) {
            EXPECT_EQ(decoded.error().code, ErrorCode::protocol);
            EXPECT_FALSE(decoded.error().message.empty());
        } else {
            EXPECT_GT(psnr_db(smooth_picture(kWidth_px, kHeight_px, 2 * i), shown), 30.0) << "unit " << i;
        }
    }
}

TEST(VideoDecoder, RecoversAtTheNextKeyframe) {
    const auto units = stream(12, {8});
    const auto& whole = units[4].bytes;
    expect_recovery(units, {});                                                 // lost
    expect_recovery(units, {whole.begin(), whole.begin() + whole.size() / 2});  // truncated
    expect_recovery(units, {whole.begin(), whole.begin() + whole.size() * 9 / 10});
    expect_recovery(units, {0x00});  // not H.264 at all
    expect_recovery(units, std::vector<std::uint8_t>(1000, 0xa5));
    expect_recovery(units, units[3].bytes);  // the one before, again
}

TEST(VideoDecoder, ATruncatedKeyframeIsNoKeyframe) {
    const auto units = stream(4, {3});
    const auto d = decoder();
    ColorImage shown;
    const std::span<const std::uint8_t> keyframe(units[0].bytes);
    EXPECT_FALSE(d->decode(keyframe.first(keyframe.size() / 2), shown));
    EXPECT_FALSE(d->decode(units[1].bytes, shown));
    EXPECT_TRUE(d->decode(units[3].bytes, shown));
}

TEST(VideoDecoder, ADepthStreamIsNoPicture) {
    const auto depth = make_depth_encoder({.width_px = 2 * kWidth_px, .height_px = kHeight_px});
    ASSERT_TRUE(depth);
    const auto unit = (*depth)->encode(room_depth(2 * kWidth_px, kHeight_px), 0.5F, false);
    ASSERT_TRUE(unit);
    ColorImage shown;
    const auto decoded = decoder()->decode(unit->bytes, shown);
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error().code, ErrorCode::protocol);
    const auto depth_decoder = make_depth_decoder();
    ASSERT_TRUE(depth_decoder);
    InverseDepthImage quarter;
    EXPECT_TRUE((*depth_decoder)->decode(unit->bytes, 0.5F, quarter));
    EXPECT_FALSE((*depth_decoder)->decode(stream(1)[0].bytes, 0.5F, quarter));
}

TEST(VideoDecoder, RefusesAnEmptyUnit) {
    const auto d = decoder();
    ColorImage shown;
    const auto decoded = d->decode({}, shown);
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error().code, ErrorCode::protocol);
}

// What the rate buffer of one frame promises, whatever the pictures are: the stream's mean, and a single frame's size,
// in shares of the rate.
constexpr double kMeanTolerance = 1.05;
constexpr double kFrameTolerance = 1.25;

TEST(VideoEncoder, BitRateStaysWithinTheLimit) {
    for (const std::int64_t rate : {std::int64_t{4'000'000}, std::int64_t{20'000'000}}) {
        const auto e = encoder(options(rate));
        double bytes = 0.0;
        std::size_t largest = 0;
        constexpr int kFrames = 45;
        for (int i = 0; i < kFrames; ++i) {
            const auto encoded =
                e->encode(noise_picture(kWidth_px, kHeight_px, static_cast<std::uint32_t>(i)), i % 15 == 14);
            ASSERT_TRUE(encoded);
            bytes += static_cast<double>(encoded->bytes.size());
            largest = std::max(largest, encoded->bytes.size());
        }
        const double frame_bytes = static_cast<double>(rate) / 8.0 / 90.0;
        EXPECT_LT(bytes / kFrames, kMeanTolerance * frame_bytes);
        EXPECT_LT(static_cast<double>(largest), kFrameTolerance * frame_bytes);
        EXPECT_GT(bytes / kFrames, 0.4 * frame_bytes);  // and the rate is used where the picture needs it
        std::printf("%lld bit/s: mean %.2f, largest %.2f of a frame's share\n", static_cast<long long>(rate),
                    bytes / kFrames / frame_bytes, static_cast<double>(largest) / frame_bytes);
    }
}

TEST(VideoEncoder, KeyframeIsTheSizeOfAnyOtherFrame) {
    const auto e = encoder(options(20'000'000));
    std::size_t largest_other = 0;
    std::size_t keyframe = 0;
    for (int i = 0; i < 20; ++i) {
        const auto encoded = e->encode(text_picture(kWidth_px, kHeight_px, 3 * i), i == 15);
        ASSERT_TRUE(encoded);
        if (i == 15)
            keyframe = encoded->bytes.size();
        else if (i > 0)
            largest_other = std::max(largest_other, encoded->bytes.size());
    }
    EXPECT_LT(static_cast<double>(keyframe), 1.3 * static_cast<double>(largest_other));
}

}  // namespace
}  // namespace macula
