// Encoders with too few bits: what a picture is worth then, that frames keep to the rate, and how soon the picture is
// good again when it becomes easy. A small display, so that 1 Mbit/s is little for it and .1 Mbit/s nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "protocol/codec/codec.h"
#include "tests/stability/case.h"
#include "tests/stability/machinery_shots.h"
#include "tests/support/codec_pictures.h"

namespace macula::test {
namespace {

constexpr int kWidth_px = 376;
constexpr int kHeight_px = 208;
constexpr double kRate_hz = 90.0;
constexpr int kFrames = 40;
constexpr int kSettled = 20;  ///< frames from which on pictures are judged

/// Rings that grow finer to the corners, up to a period of 2.5 pixels; the centre moves by a pixel a frame.
ColorImage zone_plate(int i) {
    ColorImage picture(kWidth_px, kHeight_px);
    for (int y = 0; y < kHeight_px; ++y) {
        for (int x = 0; x < kWidth_px; ++x) {
            const float dx = static_cast<float>(x - i) - 0.5F * kWidth_px;
            const float dy = static_cast<float>(y) - 0.5F * kHeight_px;
            const float value = 0.5F + 0.5F * std::cos(0.0055F * (dx * dx + dy * dy));
            picture.at(x, y) = rgba(value, value, value);
        }
    }
    return picture;
}

ColorImage noise(int i) {
    return noise_picture(kWidth_px, kHeight_px, static_cast<std::uint32_t>(i));
}

ColorImage bunny_box(int i) {
    return bunny_box_shots().shot[static_cast<std::size_t>(i)].picture.color;
}

using PictureAt = std::function<ColorImage(int i)>;

struct Coded {
    std::vector<double> psnr_db;
    std::vector<double> foveal_psnr_db;
    std::vector<double> bytes;
    int errors = 0;
    CasePictures last;
    [[nodiscard]] double settled_psnr_db() const { return mean(psnr_db); }
    [[nodiscard]] double settled_foveal_psnr_db() const { return mean(foveal_psnr_db); }

private:
    static double mean(const std::vector<double>& values) {
        double sum = 0.0;
        for (std::size_t i = kSettled; i < values.size(); ++i) sum += values[i];
        return sum / static_cast<double>(values.size() - kSettled);
    }
};

/// 1 for each pixel of both eyes that is farther than 10 degrees from straight ahead.
const std::vector<std::uint8_t>& outside_fovea() {
    static const std::vector<std::uint8_t> outside = [] {
        const Display& display = bunny_box_shots().display;
        std::vector<std::uint8_t> mask(static_cast<std::size_t>(kWidth_px) * kHeight_px, 1);
        const float limit = std::tan(10.0F * std::numbers::pi_v<float> / 180.0F);
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const int x = static_cast<int>(i % kWidth_px);
            const int y = static_cast<int>(i / kWidth_px);
            const std::size_t eye = x < kWidth_px / 2 ? kLeftEye : kRightEye;
            const Tangents& t = display.eyes[eye].tangents;
            const float u = (static_cast<float>(x % (kWidth_px / 2)) + 0.5F) / (kWidth_px / 2.0F);
            const float v = (static_cast<float>(y) + 0.5F) / kHeight_px;
            if (std::hypot(t.left + u * (t.right - t.left), t.top + v * (t.bottom - t.top)) < limit) mask[i] = 0;
        }
        return mask;
    }();
    return outside;
}

Coded code(const PictureAt& picture_at, std::int64_t rate_bps) {
    const auto encoder = make_video_encoder({"libx264", kWidth_px, kHeight_px, kRate_hz, rate_bps, 1}).value();
    const auto decoder = make_video_decoder("h264").value();
    Coded coded;
    ColorImage shown;
    for (int i = 0; i < kFrames; ++i) {
        const ColorImage picture = picture_at(i);
        const auto unit = encoder->encode(picture, false);
        if (!unit || !decoder->decode(unit->bytes, shown)) {
            ++coded.errors;
            continue;
        }
        coded.psnr_db.push_back(psnr_db(shown, picture));
        coded.foveal_psnr_db.push_back(visible_psnr_db(shown, picture, outside_fovea()));
        coded.bytes.push_back(static_cast<double>(unit->bytes.size()));
        coded.last = {shown, picture};
    }
    return coded;
}

struct Hard {
    std::string name;
    PictureAt picture_at;
    double least_db;  ///< PSNR at 25, 1 and .1 Mbit/s
    double least_poor_db;
    double least_starved_db;
};

constexpr const char* kLeastReason = "measured at this size, less 2 dB: libx264 goes on with what it has";

TEST(Starved, EncodersKeepToTheRateAndGoOn) {
    for (const Hard& hard : {Hard{"zone-plate", zone_plate, 53.0, 19.6, 7.4}, Hard{"noise", noise, 19.5, 8.9, 8.8},
                             Hard{"bunny-box", bunny_box, 38.0, 25.0, 13.0}}) {
        for (const auto& [rate_bps, least_db] : {std::pair(std::int64_t{25'000'000}, hard.least_db),
                                                 std::pair(std::int64_t{1'000'000}, hard.least_poor_db),
                                                 std::pair(std::int64_t{100'000}, hard.least_starved_db)}) {
            const Coded coded = code(hard.picture_at, rate_bps);
            const std::string name = "machinery/starved-" + hard.name + "-" + std::to_string(rate_bps / 1000) + "k";
            const double share_bytes = static_cast<double>(rate_bps) / 8.0 / kRate_hz;
            check({name, "pictures that could not be coded", static_cast<double>(coded.errors), Side::at_most, 0.0,
                   "too few bits are no error"});
            if (coded.errors > 0) continue;
            check({name, "PSNR (dB)", coded.settled_psnr_db(), Side::at_least, least_db, kLeastReason},
                  [&coded] { return coded.last; });
            state(name, "PSNR within 10 deg of the axis (dB)", coded.settled_foveal_psnr_db(),
                  "of a foveated picture this is the part with detail, of others any part");
            check({name, "largest frame but the first, of its share of the rate",
                   *std::max_element(coded.bytes.begin() + 1, coded.bytes.end()) / share_bytes, Side::at_most, 1.25,
                   "the rate buffer of one frame, as codec_test has it"});
            check({name, "keyframe (bytes)", coded.bytes[0], Side::at_most, std::max(1.25 * share_bytes, 1100.0),
                   "the same, or what 312 macroblocks cost at the coarsest step: 973 bytes"});
        }
    }
}

/// Noise takes all the bits for ten frames; then the picture is easy.
TEST(Starved, PicturesAreGoodAgainWhenBitsComeBack) {
    constexpr int kEvent = 10;
    struct Rate {
        std::int64_t bps;
        int frames;
    };
    const auto easy = [](int i) { return smooth_picture(kWidth_px, kHeight_px, i); };
    for (const Rate& rate : {Rate{3'000'000, 12}, Rate{1'000'000, 13}, Rate{100'000, 26}}) {
        const Coded never = code(easy, rate.bps);
        const Coded starved = code([&easy](int i) { return i < kEvent ? noise(i) : easy(i); }, rate.bps);
        ASSERT_EQ(never.errors + starved.errors, 0);
        int until = kEvent;
        for (int i = kEvent; i < kFrames; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (starved.psnr_db[at] < never.psnr_db[at] - 1.0) until = i + 1;
        }
        check({"machinery/starved-then-easy-" + std::to_string(rate.bps / 1000) + "k",
               "frames until within 1 dB of a stream that never starved", static_cast<double>(until - kEvent),
               Side::at_most, static_cast<double>(rate.frames),
               "measured 9, 10 and 22, and a third: the step grows finer frame by frame as the rate allows"},
              [&starved] { return starved.last; });
    }
}

}  // namespace
}  // namespace macula::test
