#pragma once

#include <cstdint>
#include <memory>

#include "masks/display.h"
#include "masks/sample_plan.h"
#include "protocol/base/image.h"
#include "protocol/message/message.h"
#include "scenes/scene.h"
#include "server/render/reconstructor.h"
#include "server/render/tracer.h"
#include "server/service/motion_finder.h"
#include "server/service/prediction.h"
#include "server/service/scene_clock.h"

namespace macula {

/// A rendered stereo frame before coding: both eyes side by side, left eye left, and a Frame message that says
/// everything that made it, still without id and streams.
struct Picture {
    Frame frame;
    ColorImage color;
    InverseDepthImage inverse_depth;
};

/// What a method (server/method.h) consists of in one session. One thread at a time.
struct MethodParts {
    PerEye<std::unique_ptr<Sampler>> samplers;
    std::unique_ptr<Reconstructor> reconstructor;
};

/// Makes the pictures of one session: predicts, plans, traces, reconstructs. One thread at a time.
class FrameMaker {
public:
    /// What a session renders with. The tracer is shared with other sessions; samplers and reconstructor are its own.
    struct Parts {
        std::shared_ptr<const Scene> scene;  ///< shared with the other sessions, too
        std::int64_t scene_start_ns = 0;     ///< this machine's time at which its animation began
        /// Whether the depth of a frame is that of the images in mirrors and behind glass (Samples).
        bool image_depth = false;
        /// Whether the rank tile is shifted from frame to frame (phase_of_frame), for clients that accumulate; without,
        /// every frame has the phase of the first.
        bool shifts_phase = true;
        std::shared_ptr<const Tracer> tracer;
        // The method that the session begins with.
        PerEye<std::unique_ptr<Sampler>> samplers;
        std::unique_ptr<Reconstructor> reconstructor;
    };

    FrameMaker(Display display, Parts parts);

    /// Renders what the Track asks for, the scene as it stands when the frame is shown; a scene that moves needs no
    /// other occasion for a frame, since Tracks come as often as the tracker delivers. `track_received_ns` is this
    /// machine's time. `picture` is overwritten, its memory reused. Errors: `graphics` if the reconstructor's context
    /// is lost.
    Expected<void> make(const Track& track, std::int64_t track_received_ns, Picture& picture);

    /// Makes all further frames by another method; they carry the id of the choice. Nobody else uses the method while
    /// frames are made with it.
    void use(std::shared_ptr<MethodParts> method, std::uint32_t choice);

private:
    Expected<void> reconstruct(Picture& picture);

    Display display_;
    Parts parts_;  ///< but for the method
    std::shared_ptr<MethodParts> method_;
    std::uint32_t choice_ = 0;
    SceneClock clock_;
    MotionFinder motion_;
    PerEye<GazeHold> gaze_;
    PerEye<SamplePlan> plans_;
    PerEye<Samples> samples_;
    std::uint64_t frame_index_ = 0;
};

/// What the client must know of a plan: of tiles, the levels without the guard ring, and the phase. Of other plans,
/// which ranks cannot tell, how densely the visible pixels of each 16x16 tile of the window were traced: the level
/// nearest in log, 0 where no sample lies.
EyeSamplingMessage sampling_message(const SamplePlan& plan);

}  // namespace macula
