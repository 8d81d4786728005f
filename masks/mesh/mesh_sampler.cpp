#include "masks/mesh/mesh_sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include <glm/common.hpp>

#include "masks/sample_order.h"

namespace macula {
namespace {

using glm::ivec2;

constexpr int kBlock = kMeshBlockEdge_px;

/// Rays that a tracer takes at a time.
constexpr std::size_t kPacket = 16;

/// Pixel (8, 8) of a block is at most this far from any other.
constexpr int kFromMiddle_px = kBlock / 2;

static_assert(kMeshReach_px <= EdgeDistance::kMargin_px);

std::string size_text(ivec2 size_px) {
    return std::to_string(size_px.x) + "x" + std::to_string(size_px.y);
}

/// Alone so that the compiler vectorises it.
void write_positions(std::span<const std::uint8_t> in_block, ivec2 block_px, SamplePosition* to) {
    const auto x = static_cast<std::int16_t>(block_px.x);
    const auto y = static_cast<std::int16_t>(block_px.y);
    for (std::size_t i = 0; i < in_block.size(); ++i) {
        to[i].x_px = static_cast<std::int16_t>(x + in_block[i] % kBlock);
        to[i].y_px = static_cast<std::int16_t>(y + in_block[i] / kBlock);
    }
}

}  // namespace

Expected<void> check_mask_covers(const SampleMesh& mesh, const Display& display) {
    if (mesh.width_px >= display.eye_width_px && mesh.height_px >= display.eye_height_px) return {};
    return fail(ErrorCode::input_file, "sampling mask of " + size_text({mesh.width_px, mesh.height_px}) +
                                           " pixels: it must cover an eye of " +
                                           size_text({display.eye_width_px, display.eye_height_px}));
}

MeshSampler::MeshSampler(const Display& display, Eye eye, std::shared_ptr<const MeshTable> table, int step_px)
    : tangents_(display.eyes[eye].tangents),
      size_px_(display.eye_width_px, display.eye_height_px),
      table_(std::move(table)),
      step_px_(step_px),
      hidden_(std::make_shared<const std::vector<std::uint8_t>>(hidden_pixels(display, eye))),
      edge_distance_(size_px_, *hidden_),
      marked_(edge_distance_.size()) {
    if (auto covers = check_mask_covers(table_->mesh(), display); !covers)
        throw std::invalid_argument(covers.error().message);
    if (step_px < 1) throw std::invalid_argument("mesh sampler: step_px must be 1 or more");
    const ivec2 most = (size_px_ - 1) / kBlock + 2;
    for (int y = 0; y < most.y; ++y) {
        for (int x = 0; x < most.x; ++x) morton_blocks_.emplace_back(x, y);
    }
    std::sort(morton_blocks_.begin(), morton_blocks_.end(), [](const ivec2& a, const ivec2& b) {
        return morton(static_cast<std::uint32_t>(a.x), static_cast<std::uint32_t>(a.y)) <
               morton(static_cast<std::uint32_t>(b.x), static_cast<std::uint32_t>(b.y));
    });
}

void MeshSampler::plan(const PlanRequest& request, SamplePlan& plan) {
    const ivec2 origin_px = origin_for(request.gaze_eye);
    find_blocks(origin_px);

    plan.width_px = size_px_.x;
    plan.height_px = size_px_.y;
    plan.hidden = hidden_;
    plan.mesh = table_;
    plan.mesh_origin_px = origin_px;
    std::size_t most = needed_px_.size();
    for (const auto* places : {&packet_blocks_, &other_blocks_}) {
        for (const Place& place : *places) most += table_->blocks().sites(place.block);
    }
    plan.position.resize(most);
    plan.spacing.resize(most);
    std::size_t visible = 0;
    // Blocks of whole packets come first and stay aligned to packets, so that those of a full block are 4x4 pixels.
    for (const auto* places : {&packet_blocks_, &other_blocks_}) {
        for (const Place& place : *places) visible = write_block(place, origin_px, visible, plan);
    }
    plan.traced_in_window = static_cast<std::uint32_t>(visible);
    write_needed(origin_px, visible, plan);
    plan.position.resize(visible + needed_px_.size());
    plan.spacing.resize(visible + needed_px_.size());
    plan.trace_order.resize(visible + needed_px_.size());
    std::iota(plan.trace_order.begin(), plan.trace_order.end(), 0U);

    // What the fields of another kind of sampler may hold.
    plan.place.clear();
    plan.untraced.clear();
    plan.phase_px = ivec2(0);
    plan.origin_px = ivec2(0);
    plan.tiles_x = 0;
    plan.tiles_y = 0;
    plan.level.clear();
    plan.offset.clear();
    plan.incomplete.clear();
    plan.grids = {};
}

ivec2 MeshSampler::origin_for(const glm::vec3& gaze_eye) const {
    // Less than this before the eye, or behind it, is far beyond any frustum; and farther off is no different.
    constexpr float kLeastCosine = 1e-3F;
    constexpr float kFar = 1e3F;
    const float depth = std::max(-gaze_eye.z, kLeastCosine);
    const glm::vec2 share((gaze_eye.x / depth - tangents_.left) / (tangents_.right - tangents_.left),
                          (tangents_.top - gaze_eye.y / depth) / (tangents_.top - tangents_.bottom));
    const SampleMesh& mesh = table_->mesh();
    const ivec2 mask_px(mesh.width_px, mesh.height_px);
    ivec2 origin_px;
    for (int axis = 0; axis < 2; ++axis) {
        const float pixel = std::clamp(share[axis], -kFar, kFar) * static_cast<float>(size_px_[axis]);
        const int gaze = static_cast<int>(std::floor(pixel / static_cast<float>(step_px_))) * step_px_ + step_px_ / 2;
        origin_px[axis] = std::clamp(mesh.gaze_px[axis] - gaze, 0, mask_px[axis] - size_px_[axis]);
    }
    return origin_px;
}

/// Lists the blocks that are seen, by how their sites fill packets, and finds what is needed of the unseen.
void MeshSampler::find_blocks(ivec2 origin_px) {
    packet_blocks_.clear();
    other_blocks_.clear();
    needed_px_.clear();
    const MeshBlocks& blocks = table_->blocks();
    const ivec2 first = origin_px / kBlock;
    const ivec2 last = (origin_px + size_px_ - 1) / kBlock;
    for (const ivec2& step : morton_blocks_) {
        const ivec2 block = first + step;
        if (block.x > last.x || block.y > last.y) continue;
        const int middle_px = edge_distance_.at(block * kBlock + kBlock / 2 - origin_px);
        if (middle_px <= -kFromMiddle_px) continue;  // no pixel of it is visible
        const bool seen_whole = middle_px > kFromMiddle_px;
        const bool packets = seen_whole && blocks.sites(block) % kPacket == 0;
        (packets ? packet_blocks_ : other_blocks_).push_back({block, seen_whole});
        const int reach_px = blocks.reach_px(block);
        if (middle_px - kFromMiddle_px <= reach_px) find_needed(block, reach_px, origin_px);
    }
    for (const ivec2& site : needed_px_) marked_[edge_distance_.index(site)] = 0;
}

/// Adds the sites that are not visible and that a visible pixel of the block interpolates.
void MeshSampler::find_needed(ivec2 block, int reach_px, ivec2 origin_px) {
    const ivec2 begin = glm::max(block * kBlock - origin_px, ivec2(0));
    const ivec2 end = glm::min((block + 1) * kBlock - origin_px, size_px_);
    const std::span<const MeshPixel> pixels = table_->pixels();
    const auto mask_width = static_cast<std::size_t>(table_->mesh().width_px);
    for (int y = begin.y; y < end.y; ++y) {
        const std::int8_t* distance_px = edge_distance_.row(y);
        const MeshPixel* entries =
            &pixels[static_cast<std::size_t>(y + origin_px.y) * mask_width + static_cast<std::size_t>(origin_px.x)];
        const auto seen = [distance_px, stride = edge_distance_.stride()](int x, int dx, int dy) {
            return distance_px[x + dx + dy * stride] > 0;
        };
        for (int x = begin.x; x < end.x; ++x) {
            if (distance_px[x] <= 0 || distance_px[x] > reach_px) continue;
            const MeshPixel& p = entries[x];
            if (seen(x, p.ax, p.ay) && seen(x, p.bx, p.by) && seen(x, p.cx, p.cy)) continue;
            need({x + p.ax, y + p.ay});
            need({x + p.bx, y + p.by});
            need({x + p.cx, y + p.cy});
        }
    }
}

void MeshSampler::need(ivec2 site_px) {
    if (edge_distance_.at(site_px) > 0) return;
    std::uint8_t& marked = marked_[edge_distance_.index(site_px)];
    if (marked != 0) return;
    marked = 1;
    needed_px_.push_back(site_px);
}

/// Writes the block's visible sites from address `first` on; returns the address after the last.
std::size_t MeshSampler::write_block(const Place& place, ivec2 origin_px, std::size_t first, SamplePlan& plan) const {
    const MeshBlocks::Block block = table_->blocks().block(place.block);
    SamplePosition* const position = plan.position.data() + first;
    float* const spacing_px = plan.spacing.data() + first;
    write_positions(block.pixel, place.block * kBlock - origin_px, position);
    std::copy(block.spacing_px.begin(), block.spacing_px.end(), spacing_px);
    if (place.seen_whole) return first + block.pixel.size();
    std::size_t visible = 0;
    for (std::size_t i = 0; i < block.pixel.size(); ++i) {
        if (edge_distance_.at({position[i].x_px, position[i].y_px}) <= 0) continue;
        position[visible] = position[i];
        spacing_px[visible++] = spacing_px[i];
    }
    return first + visible;
}

void MeshSampler::write_needed(ivec2 origin_px, std::size_t first, SamplePlan& plan) const {
    for (const ivec2& site : needed_px_) {
        const ivec2 in_mask = site + origin_px;
        const MeshBlocks::Block block = table_->blocks().block(in_mask / kBlock);
        const auto pixel = static_cast<std::uint8_t>(in_mask.y % kBlock * kBlock + in_mask.x % kBlock);
        const auto found = std::find(block.pixel.begin(), block.pixel.end(), pixel) - block.pixel.begin();
        plan.position[first] = {static_cast<std::int16_t>(site.x), static_cast<std::int16_t>(site.y)};
        plan.spacing[first++] = block.spacing_px[static_cast<std::size_t>(found)];
        const bool inside = site.x >= 0 && site.y >= 0 && site.x < size_px_.x && site.y < size_px_.y;
        plan.traced_in_window += inside ? 1U : 0U;
    }
}

}  // namespace macula
