#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "masks/sample_plan.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "server/render/reconstructor.h"
#include "server/render/tracer.h"

namespace macula::testing {

/// Traces one pixel of every visible tile; tiles are of level 1.
class FakeSampler : public Sampler {
public:
    FakeSampler(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

    void plan(const PlanRequest& request, SamplePlan& plan) override {
        last_gaze_ = request.gaze_eye;
        plan.width_px = width_px_;
        plan.height_px = height_px_;
        plan.phase_px = request.phase_px;
        plan.tiles_x = tiles(width_px_, request.phase_px.x) + 2;
        plan.tiles_y = tiles(height_px_, request.phase_px.y) + 2;
        plan.level.assign(static_cast<std::size_t>(plan.tiles_x * plan.tiles_y), 0);
        plan.traced_in_window = 0;
        for (int y = 1; y + 1 < plan.tiles_y; ++y)
            for (int x = 1; x + 1 < plan.tiles_x; ++x) {
                plan.level[static_cast<std::size_t>(y * plan.tiles_x + x)] = 1;
                ++plan.traced_in_window;
            }
    }
    [[nodiscard]] glm::vec3 last_gaze() const { return last_gaze_; }

private:
    static int tiles(int extent_px, int phase_px) {
        const int shift_px = phase_px % kTileEdge_px;
        return (extent_px + shift_px + kTileEdge_px - 1) / kTileEdge_px;
    }
    int width_px_;
    int height_px_;
    glm::vec3 last_gaze_{0.0F};
};

/// Counts its calls.
class FakeTracer : public Tracer {
public:
    TraceCounts trace(std::span<const TraceTask> tasks, double time_s) const noexcept override {
        ++calls;
        tasks_per_call = static_cast<int>(tasks.size());
        last_time_s = time_s;
        return {};
    }
    [[nodiscard]] std::string name() const override { return "fake"; }
    [[nodiscard]] std::size_t memory_bytes() const override { return 0; }

    mutable std::atomic<int> calls{0};
    mutable std::atomic<int> tasks_per_call{0};
    mutable std::atomic<double> last_time_s{-1.0};
};

/// Fills the left eye's rows with 1, the right eye's with 2.
class FakeReconstructor : public Reconstructor {
public:
    Expected<void> reconstruct(const SamplePlan& plan, const Samples& /*samples*/,
                               const ReconstructTarget& target) override {
        if (broken) return fail(ErrorCode::graphics, "the context is lost");
        const Rgba8 color = ++calls_ % 2 == 1 ? 1 : 2;
        for (int y = 0; y < plan.height_px; ++y)
            for (int x = 0; x < plan.width_px; ++x) {
                target.color[static_cast<std::size_t>(y) * target.color_stride_px + static_cast<std::size_t>(x)] =
                    color;
                target.inverse_depth_per_m[static_cast<std::size_t>(y) * target.depth_stride_px +
                                           static_cast<std::size_t>(x)] = 0.5F;
            }
        return {};
    }
    [[nodiscard]] std::string name() const override { return "fake"; }

    std::atomic<bool> broken{false};

private:
    int calls_ = 0;
};

/// The access unit is the first pixel of each eye, one byte each.
class FakeVideoEncoder : public VideoEncoder {
public:
    Expected<EncodedFrame> encode(const ColorImage& picture, bool force_keyframe) override {
        const auto byte = [](Rgba8 color) { return static_cast<std::uint8_t>(color); };
        return EncodedFrame{{byte(picture.at(0, 0)), byte(picture.at(picture.width_px - 1, 0))}, force_keyframe};
    }
};

/// The access unit is a constant byte.
class FakeDepthEncoder : public DepthEncoder {
public:
    Expected<EncodedFrame> encode(const InverseDepthImage& /*full*/, float /*near_m*/, bool force_keyframe) override {
        return EncodedFrame{{7}, force_keyframe};
    }
};

}  // namespace macula::testing
