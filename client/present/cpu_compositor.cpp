#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "client/present/cpu_rows.h"
#include "client/present/make_compositor.h"
#include "client/present/object_motion.h"
#include "client/present/sampling_row.h"
#include "client/present/view_warp.h"

namespace macula {
namespace {

using kernels::kBlock_px;
using kernels::TaaWeights;
using kernels::ViewWarp;

constexpr int kRowsPerTask = 8;

/// Memory of one row in work.
struct RowScratch {
    explicit RowScratch(int width) : precision(static_cast<std::size_t>(width)) {}
    std::vector<float> precision;
};

class CpuCompositor final : public Compositor {
public:
    CpuCompositor(const Display& display, const TaaWeights& weights)
        : display_(display),
          weights_(weights),
          width_(display.eye_width_px),
          height_(display.eye_height_px),
          motion_(display) {
        const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
        for (int eye = 0; eye < kEyeCount; ++eye) {
            hidden_[static_cast<std::size_t>(eye)] = hidden_pixels(display, static_cast<Eye>(eye));
        }
        for (auto* histories : {&before_, &after_}) {
            for (auto& history : *histories) history.resize(pixels);
        }
        stable_ = ColorImage(2 * width_, height_, 0xFF000000U);
        depth_ = depth_before_ = InverseDepthImage(2 * width_ / kBlock_px, height_ / kBlock_px);
    }

    Expected<void> accumulate(const NewFrame& frame) override {
        std::swap(before_, after_);
        std::swap(depth_before_.texels, depth_.texels);
        const PerEye<Pose> poses_before = std::exchange(world_from_eye_, frame.world_from_eye);
        depth_.texels = frame.depth->texels;
        motion_.accept(frame, poses_before);
        PerEye<ViewWarp> warps;
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            warps[eye] = make_view_warp(view(eye, poses_before[eye]), view(eye, world_from_eye_[eye]));
        }
        const bool continues = frame.continues && std::exchange(has_history_, true);
        for_rows([&](std::size_t eye, int y, RowScratch& scratch) {
            accumulate_eye_row(frame, eye, y, warps[eye], continues ? 1.0F : 0.0F, scratch);
        });
        return {};
    }

    Expected<void> show(const PerEye<Pose>& world_from_eye, std::int64_t time_ns, ColorImage& picture) override {
        if (picture.width_px != stable_.width_px || picture.height_px != stable_.height_px) {
            picture = ColorImage(stable_.width_px, stable_.height_px);
        }
        PerEye<ViewWarp> warps;
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            warps[eye] = make_view_warp(view(eye, world_from_eye_[eye]), view(eye, world_from_eye[eye]));
        }
        const bool moves = motion_.place(world_from_eye, time_ns);
        for_rows([&](std::size_t eye, int y, RowScratch&) { show_eye_row(eye, y, warps[eye], moves, picture); });
        return {};
    }

    [[nodiscard]] std::string name() const override { return "C++"; }

private:
    [[nodiscard]] EyeView view(std::size_t eye, const Pose& world_from_eye) const {
        return {world_from_eye, display_.eyes[eye].tangents, width_, height_};
    }

    template <class Row>
    void for_rows(Row&& row) {
        const int tasks_per_eye = (height_ + kRowsPerTask - 1) / kRowsPerTask;
        tbb::parallel_for(tbb::blocked_range<int>(0, kEyeCount * tasks_per_eye),
                          [&](const tbb::blocked_range<int>& range) {
                              RowScratch scratch(width_);
                              for (int task = range.begin(); task != range.end(); ++task) {
                                  const int begin = task % tasks_per_eye * kRowsPerTask;
                                  for (int y = begin; y < std::min(begin + kRowsPerTask, height_); ++y) {
                                      row(static_cast<std::size_t>(task / tasks_per_eye), y, scratch);
                                  }
                              }
                          });
    }

    [[nodiscard]] std::span<const std::uint8_t> hidden_row(std::size_t eye, int y) const {
        const auto width = static_cast<std::size_t>(width_);
        return std::span(hidden_[eye]).subspan(static_cast<std::size_t>(y) * width, width);
    }
    [[nodiscard]] EyeDepth eye_depth(const InverseDepthImage& depth, std::size_t eye) const {
        return {depth.texels.data() + static_cast<int>(eye) * width_ / kBlock_px, depth.width_px};
    }

    [[nodiscard]] EyeSlots eye_slots(const std::vector<std::uint8_t>& slots, std::size_t eye,
                                     std::span<const ViewWarp> warps) const {
        return {slots.data() + static_cast<int>(eye) * width_ / kBlock_px, kEyeCount * width_ / kBlock_px,
                warps.data()};
    }

    void accumulate_eye_row(const NewFrame& frame, std::size_t eye, int y, const ViewWarp& warp, float continues,
                            RowScratch& scratch) {
        const int eye_x = static_cast<int>(eye) * width_;
        fill_sampling_row(weights_, *frame.sampling[eye], frame.rank_tile, frame.rank_tile_size_px, y,
                          hidden_row(eye, y), scratch.precision);
        AccumulateRow row;
        row.y = y;
        row.width = width_;
        row.height = height_;
        row.warp = warp;
        row.weights = weights_;
        row.continues = continues;
        row.color = frame.color->row(y) + eye_x;
        row.depth = depth_.row(y / kBlock_px) + eye_x / kBlock_px;
        row.precision = scratch.precision.data();
        row.depth_before = eye_depth(depth_before_, eye);
        row.moves = motion_.accumulates() && weights_.knows_motion != 0;
        if (row.moves) {
            row.now = eye_slots(motion_.now(), eye, motion_.to_before(eye));
            row.before = eye_slots(motion_.before(), eye, motion_.to_before(eye));
        }
        row.history = before_[eye].data();
        row.history_out = after_[eye].data() + static_cast<std::ptrdiff_t>(y) * width_;
        row.color_out = stable_.row(y) + eye_x;
        accumulate_row(row);
    }

    void show_eye_row(std::size_t eye, int y, const ViewWarp& warp, bool moves, ColorImage& picture) const {
        const int eye_x = static_cast<int>(eye) * width_;
        ShowRow row;
        row.y = y;
        row.width = width_;
        row.height = height_;
        row.warp = warp;
        row.depth = eye_depth(depth_, eye);
        row.color = {stable_.texels.data() + eye_x, stable_.width_px};
        row.moves = moves;
        if (moves) {
            row.now = eye_slots(motion_.now(), eye, motion_.from_shown(eye));
            row.shown = eye_slots(motion_.shown(), eye, motion_.from_shown(eye));
            row.shown_depth = motion_.shown_depth().data() + (row.shown.blocks - motion_.shown().data());
        }
        row.hidden = hidden_row(eye, y).data();
        row.out = picture.row(y) + eye_x;
        show_row(row);
    }

    Display display_;
    TaaWeights weights_;
    int width_;
    int height_;
    PerEye<std::vector<std::uint8_t>> hidden_;
    PerEye<std::vector<HistoryTexel>> before_;
    PerEye<std::vector<HistoryTexel>> after_;
    PerEye<Pose> world_from_eye_;
    ObjectMotion motion_;
    InverseDepthImage depth_;
    InverseDepthImage depth_before_;
    ColorImage stable_;  ///< what accumulation made of the last frame
    bool has_history_ = false;
};

}  // namespace

std::unique_ptr<Compositor> make_cpu_compositor(const Display& display, const kernels::TaaWeights& weights) {
    return std::make_unique<CpuCompositor>(display, weights);
}

}  // namespace macula
