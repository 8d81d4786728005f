#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "client/present/make_compositor.h"
#include "client/present/sampling_row.h"
#include "client/present/view_warp.h"

namespace macula {
namespace {

using namespace kernels;

constexpr int kRowsPerTask = 8;

/// One eye's history: planes of the two words of taa_kernel.h.
struct History {
    std::vector<std::uint32_t> red_green;
    std::vector<std::uint32_t> blue_precision;
};

/// Smallest and largest of the colours around each pixel of a row, channel by channel: 3x3, edges repeated.
struct ColorBox {
    std::vector<std::uint32_t> low;
    std::vector<std::uint32_t> high;

    explicit ColorBox(int width) : low(static_cast<std::size_t>(width) + 2), high(low.size()) {}

    /// Rows are `width` pixels; pixel x ends up at index x of low and high.
    void fill(const Rgba8* above, const Rgba8* here, const Rgba8* below, int width) {
        auto* low_bytes = reinterpret_cast<std::uint8_t*>(low.data());
        auto* high_bytes = reinterpret_cast<std::uint8_t*>(high.data());
        const auto* a = reinterpret_cast<const std::uint8_t*>(above);
        const auto* b = reinterpret_cast<const std::uint8_t*>(here);
        const auto* c = reinterpret_cast<const std::uint8_t*>(below);
        const int bytes = 4 * width;
        for (int i = 0; i < bytes; ++i) {
            low_bytes[4 + i] = std::min(std::min(a[i], b[i]), c[i]);
            high_bytes[4 + i] = std::max(std::max(a[i], b[i]), c[i]);
        }
        const auto edges = static_cast<std::size_t>(width);
        low[0] = low[1];
        high[0] = high[1];
        low[edges + 1] = low[edges];
        high[edges + 1] = high[edges];
        // Ascending: each result stands where no later one reads.
        for (int i = 0; i < bytes; ++i) {
            low_bytes[i] = std::min(std::min(low_bytes[i], low_bytes[i + 4]), low_bytes[i + 8]);
            high_bytes[i] = std::max(std::max(high_bytes[i], high_bytes[i + 4]), high_bytes[i + 8]);
        }
    }
};

/// Memory of one row in work.
struct RowScratch {
    explicit RowScratch(int width)
        : precision(static_cast<std::size_t>(width)), slack(static_cast<std::size_t>(width)), box(width) {}
    std::vector<float> precision;
    std::vector<float> slack;
    ColorBox box;
};

class CpuCompositor final : public Compositor {
public:
    CpuCompositor(const Display& display, const TaaWeights& weights)
        : display_(display), weights_(weights), width_(display.eye_width_px), height_(display.eye_height_px) {
        const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
        for (int eye = 0; eye < kEyeCount; ++eye) {
            hidden_[static_cast<std::size_t>(eye)] = hidden_pixels(display, static_cast<Eye>(eye));
        }
        for (auto* histories : {&before_, &after_}) {
            for (History& history : *histories) {
                history.red_green.resize(pixels);
                history.blue_precision.resize(pixels);
            }
        }
        stable_ = ColorImage(2 * width_, height_, 0xFF000000U);
        depth_ = depth_before_ = InverseDepthImage(2 * width_ / kBlock_px, height_ / kBlock_px);
    }

    Expected<void> accumulate(const NewFrame& frame) override {
        std::swap(before_, after_);
        std::swap(depth_before_.texels, depth_.texels);
        const PerEye<Pose> poses_before = std::exchange(world_from_eye_, frame.world_from_eye);
        depth_.texels = frame.depth->texels;
        PerEye<ViewWarp> warps;
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            warps[eye] = make_view_warp(view(eye, poses_before[eye]), view(eye, world_from_eye_[eye]));
        }
        const bool continues = frame.continues && std::exchange(has_history_, true);
        for_rows([&](std::size_t eye, int y, RowScratch& scratch) {
            accumulate_row(frame, eye, y, warps[eye], continues ? 1.0F : 0.0F, scratch);
        });
        return {};
    }

    Expected<void> show(const PerEye<Pose>& world_from_eye, ColorImage& picture) override {
        if (picture.width_px != stable_.width_px || picture.height_px != stable_.height_px) {
            picture = ColorImage(stable_.width_px, stable_.height_px);
        }
        PerEye<ViewWarp> warps;
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            warps[eye] = make_view_warp(view(eye, world_from_eye_[eye]), view(eye, world_from_eye[eye]));
        }
        for_rows([&](std::size_t eye, int y, RowScratch&) { show_row(eye, y, warps[eye], picture); });
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

    void accumulate_row(const NewFrame& frame, std::size_t eye, int y, const ViewWarp& warp_in, float continues,
                        RowScratch& scratch) {
        const int width = width_;
        const int height = height_;
        const std::size_t eye_x = eye * static_cast<std::size_t>(width);
        const std::size_t row_begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        fill_sampling_row(weights_, *frame.sampling[eye], frame.rank_tile, frame.rank_tile_size_px, y,
                          std::span(hidden_[eye]).subspan(row_begin, static_cast<std::size_t>(width)),
                          scratch.precision, scratch.slack);
        const Rgba8* color_row = frame.color->row(y) + eye_x;
        scratch.box.fill(frame.color->row(std::max(y - 1, 0)) + eye_x, color_row,
                         frame.color->row(std::min(y + 1, height - 1)) + eye_x, width);

        const ViewWarp warp = warp_in;
        const TaaWeights weights = weights_;
        const int depth_stride = depth_.width_px;
        const std::size_t depth_x = eye_x / kBlock_px;
        const float* __restrict depth_row = depth_.row(y / kBlock_px) + depth_x;
        const float* __restrict depth_before = depth_before_.texels.data() + depth_x;
        const Rgba8* __restrict color = color_row;
        const float* __restrict precision = scratch.precision.data();
        const float* __restrict slack = scratch.slack.data();
        const std::uint32_t* __restrict low = scratch.box.low.data();
        const std::uint32_t* __restrict high = scratch.box.high.data();
        const std::uint32_t* __restrict red_green = before_[eye].red_green.data();
        const std::uint32_t* __restrict blue_precision = before_[eye].blue_precision.data();
        std::uint32_t* __restrict red_green_out = after_[eye].red_green.data() + row_begin;
        std::uint32_t* __restrict blue_precision_out = after_[eye].blue_precision.data() + row_begin;
        Rgba8* __restrict stable = stable_.row(y) + eye_x;
        for (int x = 0; x < width; ++x) {
            const Landing landing =
                land(warp, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, depth_row[x / kBlock_px]);
            const Footprint taps = footprint(landing.x, landing.y, width, height);
            const int at = taps.y * width + taps.x;
            const vec4 history = bilinear(unpack_history(red_green[at], blue_precision[at]),
                                          unpack_history(red_green[at + 1], blue_precision[at + 1]),
                                          unpack_history(red_green[at + width], blue_precision[at + width]),
                                          unpack_history(red_green[at + width + 1], blue_precision[at + width + 1]),
                                          taps.right, taps.lower);
            const float seen = depth_before[depth_block(landing.x, landing.y, width, height, depth_stride)];
            const float trust = continues * history_trust(weights, landing, taps, seen, width, height);
            vec4 now = unpack_color(color[x]);
            now.w = precision[x];
            const vec4 result = kernels::accumulate(weights, now, history, trust, unpack_color(low[x]),
                                                    unpack_color(high[x]), slack[x]);
            red_green_out[x] = pack_red_green(result);
            blue_precision_out[x] = pack_blue_precision(result);
            stable[x] = pack_color(result);
        }
    }

    void show_row(std::size_t eye, int y, const ViewWarp& warp_in, ColorImage& picture) const {
        const int width = width_;
        const int height = height_;
        const std::size_t eye_x = eye * static_cast<std::size_t>(width);
        const ViewWarp warp = warp_in;
        const int stride = stable_.width_px;
        const int depth_stride = depth_.width_px;
        const float* __restrict depth = depth_.texels.data() + eye_x / kBlock_px;
        const Rgba8* __restrict color = stable_.texels.data() + eye_x;
        Rgba8* __restrict out = picture.row(y) + eye_x;
        for (int x = 0; x < width; ++x) {
            const float px = static_cast<float>(x) + 0.5F;
            const float py = static_cast<float>(y) + 0.5F;
            Landing landing = land(warp, px, py, 0.0F);
            // Which surface lands here is only known there: look, correct, look again.
            for (int step = 0; step < 2; ++step) {
                const float there = depth[depth_block(landing.x, landing.y, width, height, depth_stride)];
                landing = land(warp, px, py, inverse_depth_here(warp, px, py, there));
            }
            const Footprint taps = footprint(landing.x, landing.y, width, height);
            const int at = taps.y * stride + taps.x;
            out[x] = pack_color(bilinear(unpack_color(color[at]), unpack_color(color[at + 1]),
                                         unpack_color(color[at + stride]), unpack_color(color[at + stride + 1]),
                                         taps.right, taps.lower));
        }
    }

    Display display_;
    TaaWeights weights_;
    int width_;
    int height_;
    PerEye<std::vector<std::uint8_t>> hidden_;
    PerEye<History> before_;
    PerEye<History> after_;
    PerEye<Pose> world_from_eye_;
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
