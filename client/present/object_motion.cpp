#include "client/present/object_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "client/present/view_warp.h"

namespace macula {
namespace {

using kernels::kBlock_px;
using kernels::kGoneSlot;
using kernels::kSlots;
using kernels::Landing;
using kernels::ViewWarp;

/// Neither flat nor shrunk to nothing, so that what follows from its inverse stays within the range of floats.
bool invertible(const glm::dmat3& m) {
    const glm::dvec3 size(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
    return std::min({size.x, size.y, size.z}) > 1e-6 && std::abs(glm::determinant(m)) > 1e-9 * size.x * size.y * size.z;
}

/// By scaling and squaring (Higham, Functions of Matrices, 10.3), with a Taylor series whose terms fall below 1e-16.
glm::dmat4 exponential(const glm::dmat4& m, double norm) {
    const int squarings = std::max(0, static_cast<int>(std::ceil(std::log2(std::max(norm, 1e-30)))) + 2);
    const glm::dmat4 small = m * std::ldexp(1.0, -squarings);
    glm::dmat4 term(1.0);
    glm::dmat4 sum(1.0);
    for (int k = 1; k <= 10; ++k) {
        term = term * small * (1.0 / k);
        sum += term;
    }
    for (int i = 0; i < squarings; ++i) sum = sum * sum;
    return sum;
}

double largest_entry(const glm::dmat4& m) {
    double largest = 0.0;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(m[column][row]));
    }
    return largest;
}

/// Lands nowhere.
ViewWarp no_warp() {
    return {glm::vec4(0.0F), glm::vec4(0.0F), glm::vec4(0.0F)};
}

std::size_t index(int i) {
    return static_cast<std::size_t>(i);
}

}  // namespace

glm::dmat4x3 motion_ahead(const MovingObject& object, double time_s) {
    const glm::dmat3 linear(object.world_from_object);
    if (!invertible(linear)) return glm::dmat4x3(1.0);
    // About the object's origin, so that nothing depends on where the world's lies.
    const glm::dvec3 origin(object.world_from_object[3]);
    glm::dmat4 rate(glm::dmat3(object.velocity_per_s) * glm::inverse(linear));
    rate[3] = glm::dvec4(object.velocity_per_s[3], 0.0);
    const double turn = largest_entry(glm::dmat4(glm::dmat3(rate))) * std::abs(time_s);
    if (turn > 100.0) return glm::dmat4x3(1.0);
    const glm::dmat4 ahead = exponential(rate * time_s, turn);
    glm::dmat4x3 moved(ahead);
    moved[3] += origin - glm::dmat3(ahead) * origin;
    return moved;
}

bool motion_back(const MovingObject& before, const MovingObject& now, glm::dmat4x3& before_from_now) {
    const glm::dmat3 linear(now.world_from_object);
    if (!invertible(linear)) return false;
    const glm::dmat3 moved = glm::dmat3(before.world_from_object) * glm::inverse(linear);
    const glm::dvec3 origin = glm::dvec3(before.world_from_object[3]) - moved * glm::dvec3(now.world_from_object[3]);
    before_from_now = glm::dmat4x3(moved[0], moved[1], moved[2], origin);
    return true;
}

ObjectMotion::ObjectMotion(const Display& display)
    : display_(display),
      columns_(kEyeCount * display.eye_width_px / kBlock_px),
      rows_(display.eye_height_px / kBlock_px) {}

EyeView ObjectMotion::view(std::size_t eye, const Pose& world_from_eye) const {
    return {world_from_eye, display_.eyes[eye].tangents, display_.eye_width_px, display_.eye_height_px};
}

void ObjectMotion::accept(const NewFrame& frame, const PerEye<Pose>& world_from_eye_before) {
    accumulates_ = !objects_.empty() || !frame.moving.empty();
    world_from_eye_ = frame.world_from_eye;
    display_time_ns_ = frame.display_time_ns;
    if (!accumulates_) return;
    const std::size_t blocks = index(columns_) * index(rows_);
    now_.resize(blocks);
    std::swap(now_, before_);
    now_.resize(blocks);
    const std::vector<MovingObject> objects_before =
        std::exchange(objects_, {frame.moving.begin(), frame.moving.end()});
    if (frame.moving_map != nullptr && !objects_.empty()) {
        std::ranges::copy(frame.moving_map->texels, now_.begin());
        depth_ = frame.depth->texels;
    } else {
        std::ranges::fill(now_, std::uint8_t{0});
    }
    number_like_now(objects_before);
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        const EyeView to = view(eye, world_from_eye_before[eye]);
        const EyeView from = view(eye, world_from_eye_[eye]);
        to_before_[eye].assign(kSlots, no_warp());
        to_before_[eye][0] = make_view_warp(to, from);
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            const auto same = std::ranges::find(objects_before, objects_[i].id, &MovingObject::id);
            glm::dmat4x3 before_from_now;
            if (same == objects_before.end() || !motion_back(*same, objects_[i], before_from_now)) continue;
            to_before_[eye][i + 1] = make_view_warp(to, from, before_from_now);
        }
    }
}

/// Slots of the frame before are changed to those that its objects have now.
void ObjectMotion::number_like_now(std::span<const MovingObject> before) {
    std::array<std::uint8_t, kSlots> slot_now{};
    for (std::size_t i = 0; i < before.size(); ++i) {
        const auto same = std::ranges::find(objects_, before[i].id, &MovingObject::id);
        slot_now[i + 1] = static_cast<std::uint8_t>(same == objects_.end() ? kGoneSlot : same - objects_.begin() + 1);
    }
    for (std::uint8_t& slot : before_) slot = slot_now[slot];
}

bool ObjectMotion::place(const PerEye<Pose>& world_from_eye, std::int64_t time_ns) {
    if (objects_.empty()) return false;
    const std::int64_t ahead_ns = std::clamp(time_ns - display_time_ns_, -kMaxAhead_ns, kMaxAhead_ns);
    const double ahead_s = 1e-9 * static_cast<double>(ahead_ns);
    const std::size_t blocks = index(columns_) * index(rows_);
    shown_.assign(blocks, 0);
    shown_depth_.assign(blocks, 0.0F);
    std::vector<ViewWarp> shown_from_frame(objects_.size() + 1);
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        const EyeView frame = view(eye, world_from_eye_[eye]);
        const EyeView shown = view(eye, world_from_eye[eye]);
        from_shown_[eye].assign(kSlots, no_warp());
        from_shown_[eye][0] = make_view_warp(frame, shown);
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            shown_from_frame[i + 1] = make_view_warp(shown, frame, motion_ahead(objects_[i], ahead_s));
            // exp(-t A) undoes exp(t A), since both are about the place that the object has in the frame.
            from_shown_[eye][i + 1] = make_view_warp(frame, shown, motion_ahead(objects_[i], -ahead_s));
        }
        mark_shown(eye, shown_from_frame);
    }
    return true;
}

/// Marks the blocks that the rectangle around each moving block comes to touch.
void ObjectMotion::mark_shown(std::size_t eye, const std::vector<ViewWarp>& shown_from_frame) {
    const int columns = columns_ / kEyeCount;
    const int first = static_cast<int>(eye) * columns;
    const auto edge = static_cast<float>(kBlock_px);
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::size_t block = index(row * columns_ + first + column);
            const std::uint8_t slot = now_[block];
            if (slot == 0) continue;
            const float x = edge * static_cast<float>(column);
            const float y = edge * static_cast<float>(row);
            float left = 1e9F;
            float right = -1e9F;
            float top = 1e9F;
            float bottom = -1e9F;
            float nearest = 0.0F;
            bool in_front = true;
            for (int corner = 0; corner < 4; ++corner) {
                const Landing landing = kernels::land(shown_from_frame[slot], x + (corner % 2 == 0 ? 0.0F : edge),
                                                      y + (corner / 2 == 0 ? 0.0F : edge), depth_[block]);
                in_front = in_front && landing.in_front > 0.0F;
                left = std::min(left, landing.x);
                right = std::max(right, landing.x);
                top = std::min(top, landing.y);
                bottom = std::max(bottom, landing.y);
                nearest = std::max(nearest, landing.inverse_depth);
            }
            const auto block_of = [edge](float place, int blocks) {
                return static_cast<int>(std::clamp(std::floor(place / edge), -1.0F, static_cast<float>(blocks)));
            };
            // What comes so near that a block fills a good part of the picture is not worth its time.
            constexpr float kLargest_px = 64.0F;
            if (!in_front || right - left > kLargest_px || bottom - top > kLargest_px) continue;
            const int last_y = std::min(block_of(bottom, rows_), rows_ - 1);
            const int last_x = std::min(block_of(right, columns), columns - 1);
            for (int to_y = std::max(block_of(top, rows_), 0); to_y <= last_y; ++to_y) {
                for (int to_x = std::max(block_of(left, columns), 0); to_x <= last_x; ++to_x) {
                    const std::size_t to = index(to_y * columns_ + first + to_x);
                    if (nearest <= shown_depth_[to]) continue;
                    shown_depth_[to] = nearest;
                    shown_[to] = slot;
                }
            }
        }
    }
}

}  // namespace macula
