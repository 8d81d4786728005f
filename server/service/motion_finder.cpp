#include "server/service/motion_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/mat4x3.hpp>

#include "protocol/codec/depth_plane.h"
#include "protocol/message/byte_map.h"
#include "protocol/message/limits.h"

namespace macula {
namespace {

/// Velocities are differences over this time to both sides.
constexpr double kStep_s = 0.002;

float largest_entry(const glm::mat4x3& m) {
    float largest = 0.0F;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
    }
    return largest;
}

/// Derivative of a place. Where one side is much faster than the other, the object jumps or its animation begins anew
/// there, which is no velocity: the slower side counts.
glm::mat4x3 velocity(const glm::mat4& before, const glm::mat4& now, const glm::mat4& after) {
    const auto per_second = static_cast<float>(1.0 / kStep_s);
    const glm::mat4x3 from_before = glm::mat4x3(now - before) * per_second;
    const glm::mat4x3 to_after = glm::mat4x3(after - now) * per_second;
    const float speed_before = largest_entry(from_before);
    const float speed_after = largest_entry(to_after);
    if (speed_before > 2.0F * speed_after) return to_after;
    if (speed_after > 2.0F * speed_before) return from_before;
    return (from_before + to_after) * 0.5F;
}

std::size_t index(int block) {
    return static_cast<std::size_t>(block);
}

/// How many blocks away the next sample of a plan may be.
int reach_blocks(const SamplePlan& plan) {
    // The sparsest tiles have four samples. Elsewhere, a hole is hardly ever wider than twice the distance of samples.
    if (plan.has_tiles() || plan.spacing.empty()) return 4;
    const float widest_px = 2.0F * *std::max_element(plan.spacing.begin(), plan.spacing.end());
    return 1 + static_cast<int>(widest_px) / kDepthBlock_px;
}

/// Whether a client accepts it; what it would refuse counts as still.
bool within_limits(const MovingObject& object) {
    // Written so that not-a-number is outside.
    return largest_entry(object.world_from_object) <= kMaxMagnitude &&
           largest_entry(object.velocity_per_s) <= kMaxMagnitude;
}

}  // namespace

MotionFinder::MotionFinder(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {
    node_of_object_.assign(scene_->instances.size() + 1, -1);
    if (!scene_->animation.present()) return;
    for (std::size_t i = 0; i < scene_->instances.size(); ++i) {
        node_of_object_[i + 1] = scene_->instances[i].node;
        if (scene_->instances[i].node >= 0) moves_ = true;
    }
    slot_of_node_.resize(scene_->animation.nodes.size());
    count_.resize(scene_->animation.nodes.size());
}

void MotionFinder::find(double time_s, const PerEye<SamplePlan>& plans, const PerEye<Samples>& samples,
                        const InverseDepthImage& inverse_depth, Frame& frame) {
    frame.moving.clear();
    frame.moving_map.clear();
    if (!moves_) return;
    count_samples(plans, samples);
    if (seen_nodes_.empty()) return;
    list_objects(time_s, frame);
    if (frame.moving.empty()) return;

    blocks_.columns = inverse_depth.width_px / kEyeCount / kDepthBlock_px;
    blocks_.rows = inverse_depth.height_px / kDepthBlock_px;
    map_.resize(static_cast<std::size_t>(kEyeCount * blocks_.columns) * static_cast<std::size_t>(blocks_.rows));
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        map_samples(plans[eye], samples[eye]);
        const auto left_px = static_cast<std::ptrdiff_t>(eye) * blocks_.columns * kDepthBlock_px;
        fill_between(reach_blocks(plans[eye]), inverse_depth.texels.data() + left_px, inverse_depth.width_px);
        for (int row = 0; row < blocks_.rows; ++row) {
            std::copy_n(blocks_.slot.begin() + static_cast<std::ptrdiff_t>(row) * blocks_.columns, blocks_.columns,
                        map_.begin() +
                            (static_cast<std::ptrdiff_t>(row) * kEyeCount + static_cast<int>(eye)) * blocks_.columns);
        }
    }
    frame.moving_map = pack_map(map_);
}

void MotionFinder::count_samples(const PerEye<SamplePlan>& plans, const PerEye<Samples>& samples) {
    for (const int node : seen_nodes_) count_[static_cast<std::size_t>(node)] = 0;
    seen_nodes_.clear();
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        for (const std::uint32_t address : plans[eye].trace_order) {
            const int node = node_of_object_[samples[eye].object_id[address]];
            if (node < 0) continue;
            if (count_[static_cast<std::size_t>(node)]++ == 0) seen_nodes_.push_back(node);
        }
    }
}

void MotionFinder::list_objects(double time_s, Frame& frame) {
    std::ranges::fill(slot_of_node_, std::uint8_t{0});
    // By the number of their samples, which are densest where the eye looks; the order of ties does not matter, but
    // shall not depend on that of the samples.
    std::ranges::sort(seen_nodes_, [this](int a, int b) {
        const std::uint32_t count_a = count_[static_cast<std::size_t>(a)];
        const std::uint32_t count_b = count_[static_cast<std::size_t>(b)];
        return count_a != count_b ? count_a > count_b : a < b;
    });
    pose_nodes(scene_->animation, time_s - kStep_s, before_);
    pose_nodes(scene_->animation, time_s, now_);
    pose_nodes(scene_->animation, time_s + kStep_s, after_);
    for (const int seen : seen_nodes_) {
        if (frame.moving.size() == kMaxMovingObjects) break;
        const auto node = static_cast<std::size_t>(seen);
        const MovingObject object{static_cast<std::uint32_t>(node + 1), glm::mat4x3(now_[node]),
                                  velocity(before_[node], now_[node], after_[node])};
        if (!within_limits(object)) continue;
        frame.moving.push_back(object);
        slot_of_node_[node] = static_cast<std::uint8_t>(frame.moving.size());
    }
}

std::uint8_t MotionFinder::slot_of(std::uint32_t object_id) const {
    const int node = node_of_object_[object_id];
    return node < 0 ? std::uint8_t{0} : slot_of_node_[static_cast<std::size_t>(node)];
}

/// What the nearest sample in each block hit.
void MotionFinder::map_samples(const SamplePlan& plan, const Samples& samples) {
    const auto count = static_cast<std::size_t>(blocks_.columns) * static_cast<std::size_t>(blocks_.rows);
    blocks_.nearest_per_m.assign(count, -1.0F);
    blocks_.slot.assign(count, 0);
    for (const std::uint32_t address : plan.trace_order) {
        const SamplePosition at = plan.position[address];
        // Guard samples lie outside the picture.
        if (at.x_px < 0 || at.y_px < 0) continue;
        const int column = at.x_px / kDepthBlock_px;
        const int row = at.y_px / kDepthBlock_px;
        if (column >= blocks_.columns || row >= blocks_.rows) continue;
        const auto block = static_cast<std::size_t>(row) * static_cast<std::size_t>(blocks_.columns) +
                           static_cast<std::size_t>(column);
        const float depth_per_m = samples.inverse_depth_per_m[address];
        if (depth_per_m <= blocks_.nearest_per_m[block]) continue;
        blocks_.nearest_per_m[block] = depth_per_m;
        blocks_.slot[block] = slot_of(samples.object_id[address]);
    }
}

/// Blocks without a sample get the slot of a neighbour. Only blocks near a moving one need an answer. From any block,
/// the next sample is at most `reach` blocks away.
void MotionFinder::fill_between(int reach, const float* inverse_depth, std::ptrdiff_t stride) {
    find_empty(reach);
    for (int pass = 0; pass < reach && !empty_.empty(); ++pass) {
        filled_.clear();
        still_empty_.clear();
        for (const int block : empty_) {
            const int neighbour = neighbour_like(block, inverse_depth, stride);
            if (neighbour < 0)
                still_empty_.push_back(block);
            else
                filled_.emplace_back(block, neighbour);
        }
        // After the pass, so that what is filled does not depend on the order. A block that was empty is nobody's
        // neighbour in its own pass.
        for (const auto& [block, neighbour] : filled_) {
            blocks_.nearest_per_m[index(block)] = blocks_.nearest_per_m[index(neighbour)];
            blocks_.slot[index(block)] = blocks_.slot[index(neighbour)];
        }
        std::swap(empty_, still_empty_);
    }
}

/// Sets `empty_` to the blocks without a sample that lie within `reach` blocks of the rectangle around all moving ones.
void MotionFinder::find_empty(int reach) {
    int left = blocks_.columns;
    int right = -1;
    int top = blocks_.rows;
    int bottom = -1;
    for (int row = 0; row < blocks_.rows; ++row) {
        for (int column = 0; column < blocks_.columns; ++column) {
            if (blocks_.slot[index(row * blocks_.columns + column)] == 0) continue;
            left = std::min(left, column);
            right = std::max(right, column);
            top = std::min(top, row);
            bottom = row;
        }
    }
    empty_.clear();
    if (right < 0) return;
    for (int row = std::max(top - reach, 0); row <= std::min(bottom + reach, blocks_.rows - 1); ++row) {
        for (int column = std::max(left - reach, 0); column <= std::min(right + reach, blocks_.columns - 1); ++column) {
            const int block = row * blocks_.columns + column;
            if (blocks_.nearest_per_m[index(block)] < 0.0F) empty_.push_back(block);
        }
    }
}

/// Of the blocks around one, that whose slot it takes, or -1 if none is known: where they differ, the one whose depth
/// is most like that of the block's nearest pixel, which was interpolated.
int MotionFinder::neighbour_like(int block, const float* inverse_depth, std::ptrdiff_t stride) const {
    const int column = block % blocks_.columns;
    const int row = block / blocks_.columns;
    std::array<int, 8> known{};
    std::size_t count = 0;
    bool differ = false;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, blocks_.rows - 1); ++y) {
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, blocks_.columns - 1); ++x) {
            const int other = y * blocks_.columns + x;
            if (blocks_.nearest_per_m[index(other)] < 0.0F) continue;
            known[count++] = other;
            differ = differ || blocks_.slot[index(other)] != blocks_.slot[index(known[0])];
        }
    }
    if (count == 0) return -1;
    if (!differ) return known[0];
    float here_per_m = 0.0F;
    for (int y = 0; y < kDepthBlock_px; ++y) {
        const float* pixels = inverse_depth + (row * kDepthBlock_px + y) * stride + column * kDepthBlock_px;
        here_per_m = std::max(here_per_m, *std::max_element(pixels, pixels + kDepthBlock_px));
    }
    const auto difference = [&](int other) { return std::abs(blocks_.nearest_per_m[index(other)] - here_per_m); };
    return *std::min_element(known.begin(), known.begin() + count,
                             [&](int a, int b) { return difference(a) < difference(b); });
}

}  // namespace macula
