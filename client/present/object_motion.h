#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x3.hpp>

#include "client/present/compositor.h"
#include "client/present/taa_kernel.h"

namespace macula {

/// By what an object's points move in world space during `time_s`: exp(time_s * velocity * place^-1), which is exact
/// for a steady turn, screw or growth. No motion if its place cannot be inverted or the motion is absurdly fast.
glm::dmat4x3 motion_ahead(const MovingObject& object, double time_s);

/// By what they moved since a frame before. False if its place cannot be inverted.
bool motion_back(const MovingObject& before, const MovingObject& now, glm::dmat4x3& before_from_now);

/// What both compositors must know of objects that move by themselves: for each block the slot (taa_kernel.h) of what
/// is seen there, and for each slot the warp of its pixels. Frames in which nothing moves cost nothing. One thread at a
/// time.
class ObjectMotion {
public:
    /// How far ahead of, or behind, its frame an object is moved; beyond it, it waits.
    static constexpr std::int64_t kMaxAhead_ns = 100'000'000;

    explicit ObjectMotion(const Display& display);

    /// Takes a new frame, seen before from `world_from_eye_before`.
    void accept(const NewFrame& frame, const PerEye<Pose>& world_from_eye_before);
    /// Whether the new frame or the one before has moving objects. If not, the maps and warps below are of no use.
    [[nodiscard]] bool accumulates() const { return accumulates_; }
    /// Slots of the new frame's blocks, both eyes side by side.
    [[nodiscard]] const std::vector<std::uint8_t>& now() const { return now_; }
    /// Those of the frame before, numbered like the new frame's; kGoneSlot where it no longer shows the object.
    [[nodiscard]] const std::vector<std::uint8_t>& before() const { return before_; }
    /// To the view before, by slot; an object that was not seen in it lands nowhere.
    [[nodiscard]] std::span<const kernels::ViewWarp> to_before(std::size_t eye) const { return to_before_[eye]; }

    /// Places everything as it is at a time, seen from `world_from_eye`. False if nothing moves.
    bool place(const PerEye<Pose>& world_from_eye, std::int64_t time_ns);
    /// Slots of the objects that may now be seen in each block: the nearest whose pixels come to lie there.
    [[nodiscard]] const std::vector<std::uint8_t>& shown() const { return shown_; }
    /// Inverse depth at which such an object is seen there, from now's view.
    [[nodiscard]] const std::vector<float>& shown_depth() const { return shown_depth_; }
    /// From what is shown to the newest frame, by slot.
    [[nodiscard]] std::span<const kernels::ViewWarp> from_shown(std::size_t eye) const { return from_shown_[eye]; }

private:
    void number_like_now(std::span<const MovingObject> before);
    void mark_shown(std::size_t eye, const std::vector<kernels::ViewWarp>& shown_from_frame);
    [[nodiscard]] EyeView view(std::size_t eye, const Pose& world_from_eye) const;

    Display display_;
    int columns_;  ///< blocks of both eyes in a row
    int rows_;
    bool accumulates_ = false;
    std::int64_t display_time_ns_ = 0;
    PerEye<Pose> world_from_eye_;
    std::vector<MovingObject> objects_;
    std::vector<std::uint8_t> now_;
    std::vector<std::uint8_t> before_;
    std::vector<float> depth_;
    PerEye<std::vector<kernels::ViewWarp>> to_before_;
    std::vector<std::uint8_t> shown_;
    std::vector<float> shown_depth_;
    PerEye<std::vector<kernels::ViewWarp>> from_shown_;
};

}  // namespace macula
