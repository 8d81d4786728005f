#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "masks/display.h"
#include "masks/rank_tile.h"
#include "masks/sample_plan.h"
#include "protocol/base/clock.h"
#include "protocol/base/error.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "scenes/scene.h"
#include "server/render/reconstructor.h"
#include "server/render/tracer.h"

namespace macula {

/// What the sessions of a server share, and how they get what is their own. The functions may be called from
/// several threads at once.
struct Supplies {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Tracer> tracer;
    /// This machine's time at which the scene's animation began, for all sessions.
    std::int64_t scene_start_ns = now_ns();
    /// Whether the scene shows images in mirrors or behind glass (scenes/needs.h), so that the depth of frames is
    /// theirs.
    bool image_depth = false;
    std::shared_ptr<const RankTile> rank_tile;
    std::string renderer;          ///< tracer and reconstruction, for the client's log
    std::string codec = "h264";    ///< protocol name of what make_color_encoder codes ("h264")
    std::string default_sampling;  ///< method for clients that leave the choice to the server

    // `sampling` is the name of a method (server/method.h). Errors: `option`, if it is unknown.
    std::function<Expected<std::unique_ptr<Sampler>>(const Display&, Eye, const std::string& sampling)> make_sampler;
    std::function<Expected<std::unique_ptr<Reconstructor>>(const std::string& sampling)> make_reconstructor;
    std::function<Expected<std::unique_ptr<VideoEncoder>>(int width_px, int height_px, double frame_rate_hz)>
        make_color_encoder;
    std::function<Expected<std::unique_ptr<DepthEncoder>>(int width_px, int height_px, double frame_rate_hz)>
        make_depth_encoder;
};

}  // namespace macula
