#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "masks/display.h"
#include "protocol/base/error.h"
#include "protocol/base/image.h"
#include "protocol/message/message.h"

namespace macula {

/// A frame as it comes from the server, decoded. Both eyes side by side.
struct NewFrame {
    const ColorImage* color = nullptr;
    const InverseDepthImage* depth = nullptr;  ///< nearest surface of each 4x4 block
    PerEye<Pose> world_from_eye;               ///< what `color` is a picture from
    PerEye<const EyeSamplingMessage*> sampling{};
    std::span<const std::uint8_t> rank_tile;  ///< Welcome's
    int rank_tile_size_px = 0;
    std::int64_t display_time_ns = 0;  ///< at which `moving` stands; the time that show() is told is of the same clock
    std::span<const MovingObject> moving;
    /// What moves by itself: for each 4x4 block 0 or index into `moving` + 1; null if that is empty.
    const Image<std::uint8_t>* moving_map = nullptr;
    bool continues = true;  ///< whether the frames before are of the same session, so that there is a history
};

/// What the user sees is made of the frames that came and of where the head is now: temporal anti-aliasing when a
/// frame comes, late reprojection when a picture is shown. One thread at a time.
class Compositor {
public:
    Compositor() = default;
    Compositor(const Compositor&) = delete;
    Compositor& operator=(const Compositor&) = delete;
    virtual ~Compositor() = default;

    /// Takes a frame into the history. Errors: `graphics` if the GL context is lost.
    virtual Expected<void> accumulate(const NewFrame& frame) = 0;

    /// Fills `picture` with what the eyes see from these poses at this time: rotation exactly, translation by depth,
    /// and what moves by itself where it then is. Errors: `graphics`.
    virtual Expected<void> show(const PerEye<Pose>& world_from_eye, std::int64_t time_ns, ColorImage& picture) = 0;

    /// For logs: "C++", "GL (llvmpipe ...)".
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace macula
