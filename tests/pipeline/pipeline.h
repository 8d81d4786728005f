#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "client/present/compositor.h"
#include "masks/display.h"
#include "masks/tile_tables.h"
#include "protocol/base/error.h"
#include "protocol/base/image.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "scenes/scene.h"
#include "server/mesh_shelf.h"
#include "server/render/tracer.h"
#include "server/service/frame_maker.h"
#include "tests/pipeline/row.h"
#include "tests/pipeline/scenario.h"

namespace macula::test {

/// What rows of one scene share.
struct Stage {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Tracer> tracer;
    std::shared_ptr<const TileTables> tables;
    std::shared_ptr<MeshShelf> meshes;
};

/// Loads a scene and builds what traces it. `without`: parts that are switched off (Row). Errors: those of load_scene()
/// and make_embree_tracer().
Expected<Stage> make_stage(const std::string& scene, const std::set<std::string>& without = {});
/// The same for a scene that a test has made.
Expected<Stage> make_stage(std::shared_ptr<const Scene> scene, const std::set<std::string>& without = {});

/// A display by the name in a Row: `vive/4` is vive with edges of a quarter (multiples of 4 px) and the same frustum.
/// Errors: those of load_display(); `option` for a divisor that is not a number above 0.
Expected<Display> display_of_row(const std::string& name);

/// Times of the stages of one stereo frame, milliseconds.
struct StageMilliseconds {
    double plan = 0.0;
    double trace = 0.0;
    double reconstruct = 0.0;
    double encode = 0.0;
    double decode = 0.0;
    double accumulate = 0.0;
    double show = 0.0;
    [[nodiscard]] double server() const { return plan + trace + reconstruct; }
    [[nodiscard]] double all() const { return server() + encode + decode + accumulate + show; }
};

/// Server and client without the network between: FrameMaker, codecs, decoder and compositor, each as the programs use
/// it, on both eyes. One thread at a time.
class Pipeline {
public:
    /// Errors: those of the parts, `option` for a method, a TAA or a codec that does not exist.
    static Expected<Pipeline> make(const Stage& stage, const Row& row);

    /// Makes the frame that `measured` asks for, sends it through the codecs and takes it into the history; then shows
    /// it to eyes at `shown`, whose time is not before. The picture, both eyes side by side, is valid until the next
    /// call. Errors: those of the parts.
    Expected<const ColorImage*> frame(const Moment& measured, const Moment& shown);

    [[nodiscard]] const Display& display() const { return display_; }
    /// Of the last frame.
    [[nodiscard]] const StageMilliseconds& times() const { return times_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }            ///< of both streams
    [[nodiscard]] double traced_share() const { return traced_share_; }   ///< of both eyes' pixels
    [[nodiscard]] const Picture& rendered() const { return picture_; }    ///< before coding
    [[nodiscard]] const ColorImage& decoded() const { return decoded_; }  ///< before accumulation

private:
    Pipeline() = default;
    /// Codes the rendered picture and decodes it.
    Expected<void> transmit();

    Stage stage_;
    Display display_;
    std::unique_ptr<FrameMaker> maker_;
    std::unique_ptr<VideoEncoder> color_encoder_;  ///< null: colours are not coded
    std::unique_ptr<DepthEncoder> depth_encoder_;
    std::unique_ptr<VideoDecoder> color_decoder_;
    std::unique_ptr<DepthDecoder> depth_decoder_;
    std::unique_ptr<Compositor> compositor_;
    std::vector<std::uint8_t> rank_tile_;
    Picture picture_;
    ColorImage decoded_;
    InverseDepthImage depth_;
    Image<std::uint8_t> moving_map_;
    ColorImage shown_;
    StageMilliseconds times_;
    std::size_t bytes_ = 0;
    double traced_share_ = 0.0;
    std::uint64_t next_id_ = 1;
};

/// What the left eye of `display` should see at a moment: `spp` rays through every pixel, averaged in linear light.
ColorImage reference_picture(const Stage& stage, const Display& display, const Moment& moment, int spp = 64);

/// The left eye of a stereo picture.
ColorImage left_eye(const ColorImage& stereo);

}  // namespace macula::test
