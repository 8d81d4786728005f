#include "server/service/frame_maker.h"

#include <algorithm>
#include <array>
#include <utility>

#include <glm/geometric.hpp>

#include "protocol/base/clock.h"
#include "server/service/pacing.h"

namespace macula {

namespace {

template <class T>
void resize(Image<T>& image, int width_px, int height_px) {
    if (image.width_px != width_px || image.height_px != height_px) image = Image<T>(width_px, height_px);
}

}  // namespace

FrameMaker::FrameMaker(Display display, const Pose& world_from_start, float near_m, Parts parts)
    : display_(std::move(display)), world_from_start_(world_from_start), near_m_(near_m), parts_(std::move(parts)) {}

Expected<void> FrameMaker::make(const Track& track, std::int64_t track_received_ns, Picture& picture) {
    Frame& frame = picture.frame;
    frame = Frame{};
    frame.track_id = track.id;
    frame.pose_time_ns = track.pose_time_ns;
    frame.gaze_time_ns = track.gaze_time_ns;
    frame.display_time_ns = track.display_time_ns;
    frame.near_m = near_m_;
    frame.times.track_received_ns = track_received_ns;
    frame.times.begin_ns = now_ns();

    const glm::ivec2 phase_px = phase_of_frame(frame_index_++);
    const PerEye<EyeView> views = eye_views(display_, world_from_start_ * predict_head(track));
    std::array<TraceTask, kEyeCount> tasks;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        const glm::vec3 gaze_head = gaze_[eye].update(track.gaze[eye], track.gaze_time_ns);
        const Pose eye_from_head = display_.eyes[eye].head_from_eye.inverse();
        frame.gaze[eye] = glm::normalize(eye_from_head.direction(gaze_head));
        frame.world_from_eye[eye] = views[eye].world_from_eye;
        parts_.samplers[eye]->plan({frame.gaze[eye], phase_px}, plans_[eye]);
        frame.sampling[eye] = sampling_message(plans_[eye]);
        frame.traced += plans_[eye].traced_in_window;
        tasks[eye] = {&views[eye], &plans_[eye], &samples_[eye]};
    }
    frame.times.plan_ns = now_ns();

    parts_.tracer->trace(tasks);
    frame.times.trace_ns = now_ns();

    const int width_px = display_.eye_width_px;
    resize(picture.color, kEyeCount * width_px, display_.eye_height_px);
    resize(picture.inverse_depth, kEyeCount * width_px, display_.eye_height_px);
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        const std::size_t left_px = eye * static_cast<std::size_t>(width_px);
        const ReconstructTarget target{
            picture.color.texels.data() + left_px, static_cast<std::size_t>(picture.color.width_px),
            picture.inverse_depth.texels.data() + left_px, static_cast<std::size_t>(picture.inverse_depth.width_px)};
        if (auto done = parts_.reconstructor->reconstruct(plans_[eye], samples_[eye], target); !done) return done;
    }
    frame.times.reconstruct_ns = now_ns();
    return {};
}

EyeSamplingMessage sampling_message(const SamplePlan& plan) {
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

}  // namespace macula
