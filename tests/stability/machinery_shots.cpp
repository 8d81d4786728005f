#include "tests/stability/machinery_shots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/codec/codec.h"
#include "scenes/load.h"
#include "server/render/reconstructor.h"
#include "tests/support/law_for_share.h"
#include "tests/support/small_display.h"

namespace macula::test {
namespace {

constexpr std::int64_t kPeriod_ns = 11'111'111;

/// A sway of 2 s, at most 25 deg/s, with a little pitch.
Pose head_at(int frame) {
    const float phase = 2.0F * std::numbers::pi_v<float> * static_cast<float>(frame) / 180.0F;
    const float yaw_rad = 0.14F * std::sin(phase);
    const float pitch_rad = 0.02F * std::sin(2.0F * phase);
    const glm::quat turned =
        glm::angleAxis(yaw_rad, glm::vec3(0.0F, 1.0F, 0.0F)) * glm::angleAxis(pitch_rad, glm::vec3(1.0F, 0.0F, 0.0F));
    return {turned, glm::vec3(0.05F * std::sin(phase), 0.0F, 0.0F)};
}

FrameMaker make_maker(const Display& display, const std::shared_ptr<const Scene>& scene,
                      const std::shared_ptr<const Tracer>& tracer, const std::shared_ptr<const TileTables>& tables,
                      bool foveated) {
    FrameMaker::Parts parts;
    parts.scene = scene;
    parts.image_depth = true;
    parts.tracer = tracer;
    for (const Eye eye : {kLeftEye, kRightEye}) {
        std::optional<AcuityLaw> law;
        if (foveated) law = law_for_share(display, eye, 0.18);
        parts.samplers[eye] = std::make_unique<TileSampler>(display, eye, law, tables);
    }
    parts.reconstructor = make_cpu_reconstructor(tables);
    return {display, std::move(parts)};
}

Shots make_shots() {
    Shots shots;
    shots.display = small_display();
    const auto scene = load_scene("bunny-box").value().scene;
    const std::shared_ptr<const Tracer> tracer = make_embree_tracer(scene).value();
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    shots.rank_tile = std::shared_ptr<const RankTile>(tables, &tables->rank_tile());
    FrameMaker foveated = make_maker(shots.display, scene, tracer, tables, true);
    FrameMaker full = make_maker(shots.display, scene, tracer, tables, false);
    shots.shot.resize(kShots);
    for (int i = 0; i < kShots; ++i) {
        Track track;
        track.id = static_cast<std::uint64_t>(i) + 1;
        track.pose_time_ns = track.gaze_time_ns = track.display_time_ns = i * kPeriod_ns;
        track.start_from_head = head_at(i);
        Shot& shot = shots.shot[static_cast<std::size_t>(i)];
        EXPECT_TRUE(foveated.make(track, track.pose_time_ns, shot.picture));
        Picture whole;
        EXPECT_TRUE(full.make(track, track.pose_time_ns, whole));
        shot.reference = std::move(whole.color);
    }
    shots.hidden.resize(shots.shot[0].reference.texels.size());
    for (const Eye eye : {kLeftEye, kRightEye}) {
        const std::vector<std::uint8_t> of_eye = hidden_pixels(shots.display, eye);
        const int width_px = shots.display.eye_width_px;
        for (std::size_t i = 0; i < of_eye.size(); ++i) {
            const std::size_t y = i / static_cast<std::size_t>(width_px);
            const std::size_t x = i % static_cast<std::size_t>(width_px) + static_cast<std::size_t>(eye * width_px);
            shots.hidden[y * static_cast<std::size_t>(shots.width_px()) + x] = of_eye[i];
        }
    }
    return shots;
}

}  // namespace

const Shots& bunny_box_shots() {
    static const Shots shots = make_shots();
    return shots;
}

std::int64_t fair_bit_rate_bps(const Display& display) {
    constexpr double kViveWidth_px = 1512.0;
    const double share = display.eye_width_px / kViveWidth_px;
    return std::lround(share * static_cast<double>(VideoEncoderOptions().bit_rate_bps));
}

NewFrame new_frame(const ReceivedFrame& received, const RankTile& rank_tile, bool continues) {
    NewFrame frame;
    frame.color = &received.color;
    frame.depth = &received.depth;
    frame.world_from_eye = received.frame.world_from_eye;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) frame.sampling[eye] = &received.frame.sampling[eye];
    frame.rank_tile = rank_tile.rank;
    frame.rank_tile_size_px = RankTile::kEdge_px;
    frame.display_time_ns = received.frame.display_time_ns;
    frame.moving = received.frame.moving;
    frame.moving_map = &received.moving_map;
    frame.continues = continues;
    return frame;
}

double visible_psnr_db(const ColorImage& shown, const ColorImage& reference, const std::vector<std::uint8_t>& hidden) {
    double squares = 0.0;
    double values = 0.0;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
        if (hidden[i] != 0) continue;
        for (int shift = 0; shift < 24; shift += 8) {
            const double d = static_cast<double>(shown.texels[i] >> shift & 255U) -
                             static_cast<double>(reference.texels[i] >> shift & 255U);
            squares += d * d;
            values += 1.0;
        }
    }
    return squares == 0.0 ? 99.0 : 10.0 * std::log10(255.0 * 255.0 * values / squares);
}

}  // namespace macula::test
