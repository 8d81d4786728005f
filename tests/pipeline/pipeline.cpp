#include "tests/pipeline/pipeline.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "protocol/base/clock.h"
#include "protocol/message/byte_map.h"
#include "scenes/load.h"
#include "scenes/needs.h"
#include "server/method_parts.h"
#include "server/offline/accumulate.h"
#include "server/render/reconstructor_factory.h"
#include "tests/pipeline/ablation.h"
#include "tests/stability/scenes.h"
#include "tests/support/plans.h"

namespace macula::test {

namespace {

double milliseconds(std::int64_t from_ns, std::int64_t to_ns) {
    return 1e-6 * static_cast<double>(to_ns - from_ns);
}

kernels::TaaWeights taa_weights(const Row& row) {
    kernels::TaaWeights weights = default_taa_weights();
    if (row.taa == "paper") weights = paper_taa_weights();
    if (row.taa == "off") weights = no_taa_weights();
    return ablated_taa_weights(weights, row.without);
}

/// Row::mbits for this display.
std::int64_t bit_rate(const Row& row, const Display& display) {
    constexpr double kVivePixels = 1512.0 * 1680.0;
    const double share = static_cast<double>(display.eye_width_px) * display.eye_height_px / kVivePixels;
    return static_cast<std::int64_t>(1e6 * row.mbits * std::sqrt(share));
}

Track track_of(const Moment& measured, const Moment& shown, std::uint64_t id) {
    Track track;
    track.id = id;
    track.pose_time_ns = track.gaze_time_ns = measured.time_ns;
    track.display_time_ns = shown.time_ns;
    track.start_from_head = measured.start_from_head;
    track.linear_velocity_m_s = measured.linear_velocity_m_s;
    track.angular_velocity_rad_s = measured.angular_velocity_rad_s;
    track.gaze = {GazeSample{measured.gaze_head, measured.confidence},
                  GazeSample{measured.gaze_head, measured.confidence}};
    return track;
}

PerEye<Pose> eye_poses(const Display& display, const Pose& world_from_head) {
    PerEye<Pose> poses;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) poses[eye] = world_from_head * display.eyes[eye].head_from_eye;
    return poses;
}

}  // namespace

Expected<Stage> make_stage(const std::string& scene, const std::set<std::string>& without) {
    if (auto made = test_scene(scene)) return make_stage(std::move(made), without);
    auto loaded = load_scene(scene);
    if (!loaded) return tl::unexpected(loaded.error());
    return make_stage(loaded->scene, without);
}

Expected<Stage> make_stage(std::shared_ptr<const Scene> scene, const std::set<std::string>& without) {
    Stage stage;
    auto tracer = make_embree_tracer(scene, ablated_tracer_options(without));
    if (!tracer) return tl::unexpected(tracer.error());
    stage.scene = std::move(scene);
    stage.tracer = ablated_tracer(*std::move(tracer), without);
    stage.tables = std::make_shared<const TileTables>(make_rank_tile());
    stage.meshes = std::make_shared<MeshShelf>(std::filesystem::path(), [](const std::string&) {});
    return stage;
}

Expected<Display> display_of_row(const std::string& name) {
    const std::size_t slash = name.rfind('/');
    if (slash == std::string::npos) return load_display(name);
    int divisor = 0;
    const char* end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + slash + 1, end, divisor);
    if (read.ec != std::errc() || read.ptr != end || divisor < 1)
        return load_display(name);  // the path of a display file
    auto display = load_display(name.substr(0, slash));
    if (!display) return display;
    // Protocol and depth blocks want multiples of 4.
    display->eye_width_px = display->eye_width_px / divisor / 4 * 4;
    display->eye_height_px = display->eye_height_px / divisor / 4 * 4;
    if (display->eye_width_px < 64 || display->eye_height_px < 64)
        return fail(ErrorCode::option, "display=" + name + ": less than 64 pixels remain");
    return display;
}

Expected<Pipeline> Pipeline::make(const Stage& stage, const Row& row) {
    Pipeline pipeline;
    pipeline.stage_ = stage;
    auto display = display_of_row(row.display);
    if (!display) return tl::unexpected(display.error());
    pipeline.display_ = ablated_display(*display, row.without);
    const auto method = parse_method(row.method);
    if (!method) return tl::unexpected(method.error());

    FrameMaker::Parts parts;
    parts.scene = stage.scene;
    const SceneNeeds needs = scene_needs(*stage.scene);
    parts.image_depth = needs.has(kNeedMirrors) || needs.has(kNeedTransmission) || needs.has(kNeedRefraction);
    parts.tracer = stage.tracer;
    parts.shifts_phase = row.taa != "off";
    for (const Eye eye : {kLeftEye, kRightEye}) {
        auto sampler = make_sampler(*method, ablated_sampler_display(pipeline.display_, row.without), eye, stage.tables,
                                    *stage.meshes, ablated_sampler_options(row.without));
        if (!sampler) return tl::unexpected(sampler.error());
        parts.samplers[eye] = *std::move(sampler);
    }
    // Software GL would add its own noise to times, and there is no other here that all machines have.
    const auto factory = make_reconstructor_factory({.reconstruct_on = "cpu"}, stage.tables);
    if (!factory) return tl::unexpected(factory.error());
    auto reconstructor = (*factory)->make(method->reconstruction);
    if (!reconstructor) return tl::unexpected(reconstructor.error());
    parts.reconstructor = *std::move(reconstructor);
    pipeline.maker_ = std::make_unique<FrameMaker>(pipeline.display_, std::move(parts));

    const int width_px = kEyeCount * pipeline.display_.eye_width_px;
    const int height_px = pipeline.display_.eye_height_px;
    const double rate_hz = pipeline.display_.refresh_hz;
    if (row.codec == "h264") {
        auto encoder =
            make_video_encoder({"libx264", width_px, height_px, rate_hz, bit_rate(row, pipeline.display_), 0});
        if (!encoder) return tl::unexpected(encoder.error());
        pipeline.color_encoder_ = *std::move(encoder);
        auto decoder = make_video_decoder("h264");
        if (!decoder) return tl::unexpected(decoder.error());
        pipeline.color_decoder_ = *std::move(decoder);
    }
    auto depth_encoder = make_depth_encoder({width_px, height_px, rate_hz, 0});
    if (!depth_encoder) return tl::unexpected(depth_encoder.error());
    pipeline.depth_encoder_ = *std::move(depth_encoder);
    auto depth_decoder = make_depth_decoder();
    if (!depth_decoder) return tl::unexpected(depth_decoder.error());
    pipeline.depth_decoder_ = *std::move(depth_decoder);
    pipeline.compositor_ = make_cpu_compositor(pipeline.display_, taa_weights(row));
    const RankTile& tile = stage.tables->rank_tile();
    pipeline.rank_tile_.assign(tile.rank.begin(), tile.rank.end());
    return pipeline;
}

Expected<void> Pipeline::transmit() {
    const Frame& frame = picture_.frame;
    const std::int64_t begin_ns = now_ns();
    Expected<EncodedFrame> color;
    if (color_encoder_ != nullptr) color = color_encoder_->encode(picture_.color, false);
    if (!color) return tl::unexpected(color.error());
    const Expected<EncodedFrame> depth = depth_encoder_->encode(picture_.inverse_depth, frame.near_m, false);
    if (!depth) return tl::unexpected(depth.error());
    const std::int64_t encoded_ns = now_ns();
    if (color_decoder_ == nullptr) {
        decoded_ = picture_.color;
    } else if (auto done = color_decoder_->decode(color->bytes, decoded_); !done) {
        return done;
    }
    if (auto done = depth_decoder_->decode(depth->bytes, frame.near_m, depth_); !done) return done;
    moving_map_ = Image<std::uint8_t>(depth_.width_px, depth_.height_px);
    if (!frame.moving.empty()) {
        auto map = unpack_map(frame.moving_map, moving_map_.texels.size());
        if (!map) return tl::unexpected(map.error());
        moving_map_.texels = *std::move(map);
    }
    times_.encode = milliseconds(begin_ns, encoded_ns);
    times_.decode = milliseconds(encoded_ns, now_ns());
    bytes_ = color->bytes.size() + depth->bytes.size() + frame.moving_map.size();
    return {};
}

Expected<const ColorImage*> Pipeline::frame(const Moment& measured, const Moment& shown) {
    if (auto made = maker_->make(track_of(measured, shown, next_id_++), measured.time_ns, picture_); !made)
        return tl::unexpected(made.error());
    const Frame& frame = picture_.frame;
    times_.plan = milliseconds(frame.times.begin_ns, frame.times.plan_ns);
    times_.trace = milliseconds(frame.times.plan_ns, frame.times.trace_ns);
    times_.reconstruct = milliseconds(frame.times.trace_ns, frame.times.reconstruct_ns);
    traced_share_ = static_cast<double>(frame.traced) / static_cast<double>(picture_.color.texels.size());
    if (auto sent = transmit(); !sent) return tl::unexpected(sent.error());

    NewFrame input;
    input.color = &decoded_;
    input.depth = &depth_;
    input.world_from_eye = frame.world_from_eye;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) input.sampling[eye] = &frame.sampling[eye];
    input.rank_tile = rank_tile_;
    input.rank_tile_size_px = RankTile::kEdge_px;
    input.display_time_ns = frame.display_time_ns;
    input.moving = frame.moving;
    input.moving_map = &moving_map_;
    input.continues = next_id_ > 2;
    const std::int64_t begin_ns = now_ns();
    if (auto done = compositor_->accumulate(input); !done) return tl::unexpected(done.error());
    const std::int64_t accumulated_ns = now_ns();
    const Pose world_from_head = stage_.scene->world_from_start * shown.start_from_head;
    if (auto done = compositor_->show(eye_poses(display_, world_from_head), shown.time_ns, shown_); !done)
        return tl::unexpected(done.error());
    times_.accumulate = milliseconds(begin_ns, accumulated_ns);
    times_.show = milliseconds(accumulated_ns, now_ns());
    return &shown_;
}

ColorImage reference_picture(const Stage& stage, const Display& display, const Moment& moment, int spp) {
    Shot shot;
    shot.view = eye_views(display, stage.scene->world_from_start * moment.start_from_head)[kLeftEye];
    shot.plan = full_plan(shot.view.width_px, shot.view.height_px);
    accumulate(*stage.tracer, {&shot, 1}, spp, 1e-9 * static_cast<double>(moment.time_ns), stage.scene->exposure, {});
    ColorImage picture(shot.view.width_px, shot.view.height_px);
    picture.texels = std::move(shot.samples.color);
    return picture;
}

ColorImage left_eye(const ColorImage& stereo) {
    ColorImage picture(stereo.width_px / kEyeCount, stereo.height_px);
    for (int y = 0; y < picture.height_px; ++y) std::copy_n(stereo.row(y), picture.width_px, picture.row(y));
    return picture;
}

}  // namespace macula::test
