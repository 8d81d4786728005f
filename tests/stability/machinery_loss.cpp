// Frames that never reach the client's decoder, reach it twice, late or out of order: when the picture is good again,
// and what is seen until then. Transport delivers in order, so this is what a datagram media plane, a proxy or a defect
// would do. Server and client take turns: shots are coded, FrameDecoder and compositor show them, and what the client
// reports reaches the server when another kReportFrames frames have left.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "protocol/codec/depth_plane.h"
#include "server/service/keyframe_wish.h"
#include "tests/stability/case.h"
#include "tests/stability/machinery_shots.h"

namespace macula::test {
namespace {

/// As many as SessionOptions keeps in flight.
constexpr int kReportFrames = 3;
/// The first frame that something happens to: by then temporal accumulation has settled.
constexpr int kEvent = 16;

/// The frames, by number, that reach the client at step `i`, in their order. None has a number above `i`.
using Network = std::function<std::vector<int>(int i)>;

/// What a run showed.
struct Watched {
    std::vector<double> psnr_db;  ///< at each step
    int keyframes = 0;            ///< that were sent, beyond the first
    int undecodable = 0;
    int steps_back = 0;        ///< times when the newest frame in the history was older than before
    int blocks_unlike = 0;     ///< of all depth pictures that were decoded, against what was sent: coded without loss
    int first_shown = kShots;  ///< step
    double least_db = std::numeric_limits<double>::infinity();  ///< of psnr_db from kEvent on
    CasePictures worst;                                         ///< when it was that
};

/// Codes the shots as Session does.
class Server {
public:
    explicit Server(const Shots& shots) : shots_(shots) {
        const std::int64_t rate_bps = fair_bit_rate_bps(shots.display);
        color_ = make_video_encoder({"libx264", shots.width_px(), shots.height_px(), 90.0, rate_bps, 1}).value();
        depth_ = make_depth_encoder({shots.width_px(), shots.height_px(), 90.0, 1}).value();
    }

    Frame code(int i) {
        const bool keyframe = wish_.begin();
        if (keyframe && i > 0) ++keyframes_;
        const Picture& picture = shots_.shot[static_cast<std::size_t>(i)].picture;
        Frame frame = picture.frame;
        EncodedFrame color = color_->encode(picture.color, keyframe).value();
        EncodedFrame depth = depth_->encode(picture.inverse_depth, frame.near_m, keyframe).value();
        frame.id = static_cast<std::uint64_t>(i) + 1;
        wish_.coded(frame.id);
        frame.keyframe = color.keyframe && depth.keyframe;
        frame.color = std::move(color.bytes);
        frame.depth = std::move(depth.bytes);
        return frame;
    }
    void learn_failure(std::uint64_t id) { wish_.failed(id); }
    [[nodiscard]] int keyframes() const { return keyframes_; }

private:
    const Shots& shots_;
    KeyframeWish wish_;
    int keyframes_ = 0;
    std::unique_ptr<VideoEncoder> color_;
    std::unique_ptr<DepthEncoder> depth_;
};

/// Decodes and shows as the client does.
class Client {
public:
    explicit Client(const Shots& shots)
        : shots_(shots),
          decoder_(FrameDecoder::make("h264", shots.width_px(), shots.height_px()).value()),
          compositor_(make_cpu_compositor(shots.display, default_taa_weights())),
          shown_(shots.width_px(), shots.height_px(), 0xFF000000U),
          codes_(shown_.texels.size() / (kDepthBlock_px * kDepthBlock_px)) {}

    /// False if the frame could not be decoded.
    bool take(const Frame& frame, Watched& watched) {
        ReceivedFrame received;
        received.frame = frame;
        if (decoder_.repeats(frame)) return true;
        if (!decoder_.decode(received)) return false;
        EXPECT_TRUE(compositor_->accumulate(new_frame(received, *shots_.rank_tile, newest_ != 0)));
        if (frame.id < newest_) ++watched.steps_back;
        newest_ = frame.id;
        count_unlike_blocks(received, watched);
        return true;
    }

    const ColorImage& show(const Frame& now) {
        if (shows()) {
            const auto done = compositor_->show(now.world_from_eye, now.display_time_ns, shown_);
            EXPECT_TRUE(done);
        }
        return shown_;
    }
    [[nodiscard]] bool shows() const { return newest_ != 0; }

private:
    void count_unlike_blocks(const ReceivedFrame& received, Watched& watched) {
        const float near_m = received.frame.near_m;
        const Shot& shot = shots_.shot[received.frame.id - 1];
        nearest_depth_codes(shot.picture.inverse_depth, near_m, codes_.data(), received.depth.width_px);
        for (std::size_t i = 0; i < codes_.size(); ++i) {
            if (received.depth.texels[i] != inverse_depth_of(codes_[i], near_m)) ++watched.blocks_unlike;
        }
    }

    const Shots& shots_;
    FrameDecoder decoder_;
    std::unique_ptr<Compositor> compositor_;
    std::uint64_t newest_ = 0;  ///< id of the newest frame in the history; 0: none
    ColorImage shown_;
    std::vector<std::uint8_t> codes_;
};

Watched play(const Network& network) {
    const Shots& shots = bunny_box_shots();
    Server server(shots);
    Client client(shots);
    std::vector<Frame> sent;
    // By the step at which it is known.
    std::vector<std::vector<std::uint64_t>> failed(std::size_t{kShots} + kReportFrames);
    Watched watched;
    for (int i = 0; i < kShots; ++i) {
        for (const std::uint64_t id : failed[static_cast<std::size_t>(i)]) server.learn_failure(id);
        sent.push_back(server.code(i));
        for (const int number : network(i)) {
            const Frame& frame = sent[static_cast<std::size_t>(number)];
            if (client.take(frame, watched)) continue;
            ++watched.undecodable;
            failed[static_cast<std::size_t>(i + kReportFrames)].push_back(frame.id);
        }
        const Shot& shot = shots.shot[static_cast<std::size_t>(i)];
        const ColorImage& shown = client.show(shot.picture.frame);
        if (client.shows()) watched.first_shown = std::min(watched.first_shown, i);
        watched.psnr_db.push_back(visible_psnr_db(shown, shot.reference, shots.hidden));
        if (i >= kEvent && watched.psnr_db.back() < watched.least_db) {
            watched.least_db = watched.psnr_db.back();
            watched.worst = {shown, shot.reference};
        }
    }
    watched.keyframes = server.keyframes();
    return watched;
}

/// All frames arrive but those for which `lost` holds.
Watched play_without(const std::function<bool(int i)>& lost) {
    return play([&lost](int i) { return lost(i) ? std::vector<int>{} : std::vector<int>{i}; });
}

const Watched& undisturbed() {
    static const Watched watched = play_without([](int) { return false; });
    return watched;
}

/// Steps from `from` until none is more than 1 dB worse than undisturbed.
int frames_until_good(const Watched& watched, int from) {
    int until = from;
    for (int i = from; i < kShots; ++i) {
        const auto step = static_cast<std::size_t>(i);
        if (watched.psnr_db[step] < undisturbed().psnr_db[step] - 1.0) until = i + 1;
    }
    return until - from;
}

/// What must hold whatever happens to frames.
void check_sanity(const std::string& name, const Watched& watched) {
    check({name, "depth blocks unlike those sent", static_cast<double>(watched.blocks_unlike), Side::at_most, 0.0,
           "depth is coded without loss: one that differs was predicted from a wrong picture, and its colours too"},
          [&watched] { return watched.worst; });
    check({name, "frames older than what was shown", static_cast<double>(watched.steps_back), Side::at_most, 0.0,
           "what is shown never goes back in time"});
}

/// The frames that pass before a keyframe can arrive: the lost one, and those that leave until its report is back.
constexpr int kWay = 1 + kReportFrames;

void check_recovery(const std::string& name, const Watched& watched, int lost) {
    check_sanity(name, watched);
    check({name, "frames until within 1 dB of undisturbed", static_cast<double>(frames_until_good(watched, kEvent)),
           Side::at_most, static_cast<double>(lost + kReportFrames + 1),
           "the lost ones, those that leave before the report of the first gap is back, and one: the keyframe is good"},
          [&watched] { return watched.worst; });
    check({name, "keyframes sent", static_cast<double>(watched.keyframes), Side::at_most, 1.0,
           "one answers all reports of frames from before it"});
    check({name, "least PSNR meanwhile (dB)", watched.least_db, Side::at_least, 14.0,
           "the last good picture, turned to where the head is: 16.3 dB after 19 frames of 25 deg/s, whose edge was "
           "never "
           "seen"},
          [&watched] { return watched.worst; });
}

TEST(Loss, OfOneFrameOrABurstEndsWithOneKeyframe) {
    // 16 is the cycle of the stream's own picture numbers.
    for (const int lost : {1, 10, 16}) {
        const Watched watched = play_without([lost](int i) { return i >= kEvent && i < kEvent + lost; });
        check_recovery("machinery/lost-" + std::to_string(lost), watched, lost);
    }
}

TEST(Loss, OfEachSecondFrame) {
    constexpr int kLossy = 12;
    const std::string name = "machinery/lost-each-second";
    const Watched watched = play_without([](int i) { return i >= kEvent && i < kEvent + kLossy && i % 2 == 0; });
    check_sanity(name, watched);
    check({name, "frames until within 1 dB, from the last loss on",
           static_cast<double>(frames_until_good(watched, kEvent + kLossy - 1)), Side::at_most, kWay + 1.0,
           "as after a single loss"},
          [&watched] { return watched.worst; });
    check({name, "keyframes sent", static_cast<double>(watched.keyframes), Side::at_most,
           static_cast<double>(kLossy) / kWay + 1.0, "one for each way there and back"});
}

TEST(Loss, OfTheFirstKeyframe) {
    const std::string name = "machinery/lost-first-keyframe";
    const Watched watched = play_without([](int i) { return i == 0; });
    check_sanity(name, watched);
    check({name, "frames until something is shown", static_cast<double>(watched.first_shown), Side::at_most, kWay,
           "the lost one, and those that leave until its report is back"});
    check({name, "keyframes sent again", static_cast<double>(watched.keyframes), Side::at_most, 1.0,
           "one answers all reports of frames from before it"});
    check({name, "PSNR lost for ever (dB)", undisturbed().psnr_db.back() - watched.psnr_db.back(), Side::at_most, 0.3,
           "the stream is then like any other; measured -.1 to .1"},
          [&watched] { return watched.worst; });
}

TEST(Loss, OfTheKeyframeThatAnswersALoss) {
    const std::string name = "machinery/lost-forced-keyframe";
    const Watched watched = play_without([](int i) { return i == kEvent || i == kEvent + kWay; });
    check_sanity(name, watched);
    check({name, "frames until within 1 dB of undisturbed", static_cast<double>(frames_until_good(watched, kEvent)),
           Side::at_most, 2.0 * kWay + 1.0, "two losses, one after the other, and one frame"},
          [&watched] { return watched.worst; });
    check({name, "keyframes sent", static_cast<double>(watched.keyframes), Side::at_most, 2.0,
           "the lost one and the one that takes its place"});
}

TEST(Order, FramesThatComeTwiceChangeNothing) {
    const std::string name = "machinery/repeated";
    const Watched watched = play([](int i) {
        return i < kEvent ? std::vector<int>{i, i} : std::vector<int>{i, i - 7, i};
    });
    check_sanity(name, watched);
    double largest_db = 0.0;
    for (std::size_t i = 0; i < watched.psnr_db.size(); ++i) {
        largest_db = std::max(largest_db, std::abs(watched.psnr_db[i] - undisturbed().psnr_db[i]));
    }
    check({name, "PSNR unlike undisturbed (dB)", largest_db, Side::at_most, 0.0, "a repeated frame is not decoded"},
          [&watched] { return watched.worst; });
    check({name, "keyframes sent", static_cast<double>(watched.keyframes), Side::at_most, 0.0, "nothing is missing"});
}

TEST(Order, FramesThatChangePlacesCostAKeyframe) {
    const Watched watched = play([](int i) {
        if (i == kEvent) return std::vector<int>{};
        return i == kEvent + 1 ? std::vector<int>{i, i - 1} : std::vector<int>{i};
    });
    check_recovery("machinery/swapped", watched, 1);
}

/// Held back together, then delivered in order at once: what TCP does when a packet is lost.
TEST(Order, FramesThatComeLateAreShownWhenTheyCome) {
    for (const int late : {5, 18, 36}) {
        const std::string name = "machinery/late-" + std::to_string(late);
        const Watched watched = play([late](int i) {
            std::vector<int> arriving;
            if (i < kEvent || i >= kEvent + late) arriving.push_back(i);
            for (int held = kEvent; i == kEvent + late && held < i; ++held) {
                arriving.insert(arriving.end() - 1, held);
            }
            return arriving;
        });
        check_sanity(name, watched);
        check({name, "frames until within 1 dB of undisturbed", static_cast<double>(frames_until_good(watched, kEvent)),
               Side::at_most, static_cast<double>(late), "good with the first picture after the pause"},
              [&watched] { return watched.worst; });
        check(
            {name, "keyframes sent", static_cast<double>(watched.keyframes), Side::at_most, 0.0, "nothing is missing"});
    }
}

}  // namespace
}  // namespace macula::test
