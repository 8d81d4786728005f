#include "server/service/frame_maker.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "protocol/base/clock.h"
#include "server/service/pacing.h"

namespace macula {

namespace {

template <class T>
void resize(Image<T>& image, int width_px, int height_px) {
    if (image.width_px != width_px || image.height_px != height_px) image = Image<T>(width_px, height_px);
}

EyeSamplingMessage tile_levels(const SamplePlan& plan) {
    EyeSamplingMessage message;
    message.phase_px = plan.phase_px;
    message.tiles_x = plan.tiles_x - 2;
    message.tiles_y = plan.tiles_y - 2;
    message.level.reserve(static_cast<std::size_t>(message.tiles_x) * static_cast<std::size_t>(message.tiles_y));
    for (int y = 1; y <= message.tiles_y; ++y) {
        const auto row = plan.level.begin() + static_cast<std::ptrdiff_t>(y) * plan.tiles_x;
        message.level.insert(message.level.end(), row + 1, row + 1 + message.tiles_x);
    }
    return message;
}

/// Level whose density is the nearest in log to `samples` among `pixels`; 0 for none.
std::uint8_t nearest_level(int samples, int pixels) {
    if (samples == 0) return 0;
    const auto squared = [](int value) { return std::int64_t{value} * value; };
    int level = 1;
    // The boundary between two levels is the root of their product.
    while (level < kFullLevel &&
           squared(samples * kTileArea_px) > squared(pixels) * kLevelCounts[level] * kLevelCounts[level + 1])
        ++level;
    return static_cast<std::uint8_t>(level);
}

EyeSamplingMessage counted_levels(const SamplePlan& plan) {
    EyeSamplingMessage message;
    message.exact = false;
    message.tiles_x = (plan.width_px + kTileEdge_px - 1) / kTileEdge_px;
    message.tiles_y = (plan.height_px + kTileEdge_px - 1) / kTileEdge_px;
    const auto tiles = static_cast<std::size_t>(message.tiles_x) * static_cast<std::size_t>(message.tiles_y);
    std::vector<int> samples(tiles);
    for (const std::uint32_t address : plan.trace_order) {
        const SamplePosition at = plan.position[address];
        if (at.x_px < 0 || at.y_px < 0 || at.x_px >= plan.width_px || at.y_px >= plan.height_px) continue;
        const int pixel = at.y_px * plan.width_px + at.x_px;
        if (plan.hidden != nullptr && (*plan.hidden)[pixel] != 0) continue;
        ++samples[at.y_px / kTileEdge_px * message.tiles_x + at.x_px / kTileEdge_px];
    }
    std::vector<int> visible(tiles);
    for (int y = 0; y < plan.height_px; ++y) {
        int* of_row = visible.data() + static_cast<std::ptrdiff_t>(y / kTileEdge_px) * message.tiles_x;
        for (int tile = 0; tile < message.tiles_x; ++tile) {
            const int begin = tile * kTileEdge_px;
            const int pixels = std::min(kTileEdge_px, plan.width_px - begin);
            of_row[tile] += pixels;
            if (plan.hidden == nullptr) continue;
            const std::uint8_t* hidden = plan.hidden->data() + static_cast<std::ptrdiff_t>(y) * plan.width_px + begin;
            of_row[tile] -= std::accumulate(hidden, hidden + pixels, 0);
        }
    }
    message.level.resize(tiles);
    for (std::size_t tile = 0; tile < tiles; ++tile) message.level[tile] = nearest_level(samples[tile], visible[tile]);
    return message;
}

}  // namespace

FrameMaker::FrameMaker(Display display, Parts parts)
    : display_(std::move(display)),
      parts_(std::move(parts)),
      method_(std::make_shared<MethodParts>(MethodParts{std::move(parts_.samplers), std::move(parts_.reconstructor)})),
      clock_(parts_.scene_start_ns),
      motion_(parts_.scene) {
    for (Samples& samples : samples_) samples.keep_image_depth = parts_.image_depth;
}

void FrameMaker::use(std::shared_ptr<MethodParts> method, std::uint32_t choice) {
    method_ = std::move(method);
    choice_ = choice;
    // A sampler may find in a plan what it wrote itself, but not what another one did.
    plans_ = {};
}

Expected<void> FrameMaker::make(const Track& track, std::int64_t track_received_ns, Picture& picture) {
    Frame& frame = picture.frame;
    frame = Frame{};
    frame.track_id = track.id;
    frame.pose_time_ns = track.pose_time_ns;
    frame.gaze_time_ns = track.gaze_time_ns;
    frame.display_time_ns = track.display_time_ns;
    frame.near_m = parts_.scene->near_m;
    frame.choice = choice_;
    frame.times.track_received_ns = track_received_ns;
    frame.times.begin_ns = now_ns();

    const glm::ivec2 phase_px = phase_of_frame(frame_index_);
    if (parts_.shifts_phase) ++frame_index_;
    const PerEye<EyeView> views = eye_views(display_, parts_.scene->world_from_start * predict_head(track));
    std::array<TraceTask, kEyeCount> tasks;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        const glm::vec3 gaze_head = gaze_[eye].update(track.gaze[eye], track.gaze_time_ns);
        const Pose eye_from_head = display_.eyes[eye].head_from_eye.inverse();
        frame.gaze[eye] = glm::normalize(eye_from_head.direction(gaze_head));
        frame.world_from_eye[eye] = views[eye].world_from_eye;
        method_->samplers[eye]->plan({frame.gaze[eye], phase_px}, plans_[eye]);
        frame.sampling[eye] = sampling_message(plans_[eye]);
        frame.traced += plans_[eye].traced_in_window;
        tasks[eye] = {&views[eye], &plans_[eye], &samples_[eye]};
    }
    frame.times.plan_ns = now_ns();

    const double time_s = clock_.display_time_s(track, track_received_ns);
    parts_.tracer->trace(tasks, time_s);
    frame.times.trace_ns = now_ns();

    if (auto done = reconstruct(picture); !done) return done;
    if (motion_.anything_moves()) motion_.find(time_s, plans_, samples_, picture.inverse_depth, frame);
    frame.times.reconstruct_ns = now_ns();
    return {};
}

Expected<void> FrameMaker::reconstruct(Picture& picture) {
    const int width_px = display_.eye_width_px;
    resize(picture.color, kEyeCount * width_px, display_.eye_height_px);
    resize(picture.inverse_depth, kEyeCount * width_px, display_.eye_height_px);
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        const std::size_t left_px = eye * static_cast<std::size_t>(width_px);
        const ReconstructTarget target{
            picture.color.texels.data() + left_px, static_cast<std::size_t>(picture.color.width_px),
            picture.inverse_depth.texels.data() + left_px, static_cast<std::size_t>(picture.inverse_depth.width_px)};
        Samples& samples = samples_[eye];
        // Reprojection moves what is seen, not the surface that it is seen in.
        if (parts_.image_depth) samples.inverse_depth_per_m.swap(samples.image_inverse_depth_per_m);
        auto done = method_->reconstructor->reconstruct(plans_[eye], samples, target);
        if (parts_.image_depth) samples.inverse_depth_per_m.swap(samples.image_inverse_depth_per_m);
        if (!done) return done;
    }
    return {};
}

EyeSamplingMessage sampling_message(const SamplePlan& plan) {
    return plan.has_tiles() ? tile_levels(plan) : counted_levels(plan);
}

}  // namespace macula
