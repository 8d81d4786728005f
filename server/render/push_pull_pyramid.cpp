#include "server/render/push_pull_pyramid.h"

#include <algorithm>

#include "server/kernels/push_pull.h"
#include "server/render/parallel_ranges.h"

namespace macula {

namespace {

constexpr int kRowGrain = 16;
constexpr float kNearest = 1.0e30F;

std::vector<std::uint16_t> zeros(int count) {
    return std::vector<std::uint16_t>(static_cast<std::size_t>(count));
}

}  // namespace

void PushPullPyramid::Level::resize(int new_width, int new_height) {
    width = new_width;
    height = new_height;
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (auto& plane : channel) plane.resize(pixels);
    weight.resize(pixels);
    inverse_depth.resize(pixels);
}

/// Makes rows of a level from the finer one: sums down the columns of three rows, then across three columns.
class PushPullPyramid::PullRows {
public:
    explicit PullRows(int fine_width)
        : fine_width_(fine_width),
          channel_{zeros(fine_width + 2), zeros(fine_width + 2), zeros(fine_width + 2)},
          weight_(zeros(fine_width + 2)),
          depth_sum_(weight_.size()),
          nearest_(weight_.size()),
          farthest_(weight_.size(), kNearest) {}

    void clear() {
        for (auto& sums : channel_) std::fill(sums.begin(), sums.end(), std::uint16_t{0});
        std::fill(weight_.begin(), weight_.end(), std::uint16_t{0});
        std::fill(depth_sum_.begin(), depth_sum_.end(), 0.0F);
        std::fill(nearest_.begin(), nearest_.end(), 0.0F);
        std::fill(farthest_.begin(), farthest_.end(), kNearest);
    }

    /// Adds a row of the sample image `kernel` times.
    void add(const Rgba8* color, const float* inverse_depth, unsigned kernel) {
        const auto scale = static_cast<std::uint16_t>(kernel * kernels::kChannelScale * kernels::kFullWeight);
        const auto weight = static_cast<std::uint16_t>(kernel * kernels::kFullWeight);
        for (unsigned c = 0; c < 3; ++c) {
            std::uint16_t* const sums = channel_[c].data() + 1;
            for (int x = 0; x < fine_width_; ++x) {
                const auto code = static_cast<std::uint16_t>((color[x] >> (8 * c)) & 255U);
                sums[x] = static_cast<std::uint16_t>(
                    sums[x] + (inverse_depth[x] < 0.0F ? 0 : static_cast<std::uint16_t>(code * scale)));
            }
        }
        std::uint16_t* const weights = weight_.data() + 1;
        for (int x = 0; x < fine_width_; ++x)
            weights[x] = static_cast<std::uint16_t>(weights[x] + (inverse_depth[x] < 0.0F ? 0 : weight));
        const auto depth_weight = static_cast<float>(weight);
        add_depths(inverse_depth, [&](int x) { return inverse_depth[x] < 0.0F ? 0.0F : depth_weight; });
    }

    /// Adds a row of a level `kernel` times.
    void add(const Level& fine, int y, unsigned kernel) {
        const std::size_t row = fine.row(y);
        for (std::size_t c = 0; c < 3; ++c) accumulate(fine.channel[c].data() + row, kernel, channel_[c]);
        const std::uint16_t* const weight = fine.weight.data() + row;
        accumulate(weight, kernel, weight_);
        const auto scale = static_cast<float>(kernel);
        add_depths(fine.inverse_depth.data() + row, [&](int x) { return scale * static_cast<float>(weight[x]); });
    }

    void write(Level& coarse, int y) const {
        const std::size_t row = coarse.row(y);
        const bool coarsest = coarse.width == 1 && coarse.height == 1;
        std::uint16_t* const weights = coarse.weight.data() + row;
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint16_t* const to = coarse.channel[c].data() + row;
            for (int x = 0; x < coarse.width; ++x) {
                const unsigned total = across(weight_, x);
                const unsigned weight = coarsest ? 1U : kernels::pulled_weight(total);
                to[x] = static_cast<std::uint16_t>(kernels::pulled_channel(across(channel_[c], x), total) * weight);
            }
        }
        float* const depths = coarse.inverse_depth.data() + row;
        for (int x = 0; x < coarse.width; ++x) {
            const unsigned total = across(weight_, x);
            weights[x] = static_cast<std::uint16_t>(kernels::pulled_weight(total));
            const std::size_t i = 2 * static_cast<std::size_t>(x);
            const float sum = depth_sum_[i] + 2.0F * depth_sum_[i + 1] + depth_sum_[i + 2];
            const float nearest = std::max(std::max(nearest_[i], nearest_[i + 1]), nearest_[i + 2]);
            const float farthest = std::min(std::min(farthest_[i], farthest_[i + 1]), farthest_[i + 2]);
            depths[x] = total == 0 ? 0.0F : kernels::pulled_inverse_depth(sum, total, nearest, farthest);
        }
    }

private:
    void accumulate(const std::uint16_t* from, unsigned kernel, std::vector<std::uint16_t>& to) const {
        std::uint16_t* const sums = to.data() + 1;
        const auto scale = static_cast<std::uint16_t>(kernel);
        for (int x = 0; x < fine_width_; ++x)
            sums[x] = static_cast<std::uint16_t>(sums[x] + static_cast<std::uint16_t>(from[x] * scale));
    }
    template <class Weight>
    void add_depths(const float* depth, Weight&& weight) {
        float* const sums = depth_sum_.data() + 1;
        float* const nearest = nearest_.data() + 1;
        float* const farthest = farthest_.data() + 1;
        for (int x = 0; x < fine_width_; ++x) {
            const float w = weight(x);
            sums[x] += w * depth[x];
            nearest[x] = std::max(nearest[x], w > 0.0F ? depth[x] : 0.0F);
            farthest[x] = std::min(farthest[x], w > 0.0F ? depth[x] : kNearest);
        }
    }
    /// Kernel (1, 2, 1) at column x of the coarser level. Entry i of a sum is column i - 1.
    static unsigned across(const std::vector<std::uint16_t>& sums, int x) {
        const std::size_t i = 2 * static_cast<std::size_t>(x);
        return static_cast<unsigned>(sums[i]) + 2U * sums[i + 1] + sums[i + 2];
    }

    int fine_width_;
    std::array<std::vector<std::uint16_t>, 3> channel_;
    std::vector<std::uint16_t> weight_;
    std::vector<float> depth_sum_;
    std::vector<float> nearest_;
    std::vector<float> farthest_;
};

/// What a row of a finer level is given by the coarser one: sums of four of its pixels.
class PushPullPyramid::PushRows {
public:
    PushRows(const Level& coarse, int fine_width)
        : coarse_(coarse),
          fine_width_(fine_width),
          column_(static_cast<std::size_t>(coarse.width) + 1),
          column_depth_(column_.size()),
          column_nearest_(column_.size()),
          column_farthest_(column_.size()) {
        // Whole pairs of columns, of which the last may lie outside.
        const std::size_t columns = 2 * static_cast<std::size_t>(coarse.width);
        for (auto& sums : channel) sums.resize(columns);
        depth_sum.resize(columns);
        nearest.resize(columns);
        farthest.resize(columns);
    }

    void make(int y) {
        const std::size_t first = coarse_.row(y / 2);
        const std::size_t last = coarse_.row(std::min((y + 1) / 2, coarse_.height - 1));
        const auto columns = static_cast<std::size_t>(coarse_.width);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint16_t* const plane = coarse_.channel[c].data();
            for (std::size_t x = 0; x < columns; ++x)
                column_[x] = static_cast<std::uint16_t>(plane[first + x] + plane[last + x]);
            column_[columns] = column_[columns - 1];
            std::uint16_t* const to = channel[c].data();
            for (std::size_t x = 0; x < columns; ++x) {
                to[2 * x] = static_cast<std::uint16_t>(2 * column_[x]);
                to[2 * x + 1] = static_cast<std::uint16_t>(column_[x] + column_[x + 1]);
            }
        }
        const float* const upper = coarse_.inverse_depth.data() + first;
        const float* const lower = coarse_.inverse_depth.data() + last;
        for (std::size_t x = 0; x < columns; ++x) {
            column_depth_[x] = upper[x] + lower[x];
            column_nearest_[x] = std::max(upper[x], lower[x]);
            column_farthest_[x] = std::min(upper[x], lower[x]);
        }
        column_depth_[columns] = column_depth_[columns - 1];
        column_nearest_[columns] = column_nearest_[columns - 1];
        column_farthest_[columns] = column_farthest_[columns - 1];
        for (std::size_t x = 0; x < columns; ++x) {
            depth_sum[2 * x] = 2.0F * column_depth_[x];
            depth_sum[2 * x + 1] = column_depth_[x] + column_depth_[x + 1];
            nearest[2 * x] = column_nearest_[x];
            nearest[2 * x + 1] = std::max(column_nearest_[x], column_nearest_[x + 1]);
            farthest[2 * x] = column_farthest_[x];
            farthest[2 * x + 1] = std::min(column_farthest_[x], column_farthest_[x + 1]);
        }
    }
    [[nodiscard]] int fine_width() const { return fine_width_; }

    // Per column of the finer level.
    std::array<std::vector<std::uint16_t>, 3> channel;
    std::vector<float> depth_sum;
    std::vector<float> nearest;
    std::vector<float> farthest;

private:
    const Level& coarse_;
    int fine_width_;
    std::vector<std::uint16_t> column_;  ///< sums of two rows; one more at the end repeats the last
    std::vector<float> column_depth_;
    std::vector<float> column_nearest_;
    std::vector<float> column_farthest_;
};

void PushPullPyramid::push(const Level& coarse, Level& fine) {
    parallel_ranges(0, fine.height, kRowGrain, [&](int first, int last) {
        PushRows from(coarse, fine.width);
        for (int y = first; y < last; ++y) {
            from.make(y);
            const std::size_t row = fine.row(y);
            std::uint16_t* const weight = fine.weight.data() + row;
            for (std::size_t c = 0; c < 3; ++c) {
                std::uint16_t* const channel = fine.channel[c].data() + row;
                const std::uint16_t* const sums = from.channel[c].data();
                for (int x = 0; x < fine.width; ++x)
                    channel[x] = static_cast<std::uint16_t>(kernels::pushed_channel(sums[x], channel[x], weight[x]));
            }
            float* const depth = fine.inverse_depth.data() + row;
            for (int x = 0; x < fine.width; ++x)
                depth[x] = kernels::pushed_inverse_depth(from.depth_sum[x], from.nearest[x], from.farthest[x], depth[x],
                                                         weight[x]);
        }
    });
}

void PushPullPyramid::show(const SamplePlan& plan, const SampleImage& image, const Level& coarse,
                           const ReconstructTarget& target) {
    parallel_ranges(0, plan.height_px, kRowGrain, [&](int first, int last) {
        PushRows from(coarse, image.width_px);
        for (int y = first; y < last; ++y) {
            from.make(y + image.guard_px);
            const std::size_t own = image.index({0, y});
            const Rgba8* const sample_color = image.color.data() + own;
            const float* const sample_depth = image.inverse_depth_per_m.data() + own;
            const std::uint16_t* const red = from.channel[0].data() + image.guard_px;
            const std::uint16_t* const green = from.channel[1].data() + image.guard_px;
            const std::uint16_t* const blue = from.channel[2].data() + image.guard_px;
            Rgba8* const color = target.color + static_cast<std::size_t>(y) * target.color_stride_px;
            for (int x = 0; x < plan.width_px; ++x) {
                const Rgba8 pushed = kernels::shown_channel(red[x]) | kernels::shown_channel(green[x]) << 8 |
                                     kernels::shown_channel(blue[x]) << 16 | kernels::kOpaqueBlack;
                color[x] = sample_depth[x] < 0.0F ? pushed : sample_color[x];
            }
            const float* const sum = from.depth_sum.data() + image.guard_px;
            const float* const nearest = from.nearest.data() + image.guard_px;
            const float* const farthest = from.farthest.data() + image.guard_px;
            float* const depth = target.inverse_depth_per_m + static_cast<std::size_t>(y) * target.depth_stride_px;
            for (int x = 0; x < plan.width_px; ++x) {
                const float pushed = kernels::pushed_inverse_depth(sum[x], nearest[x], farthest[x], 0.0F, 0U);
                depth[x] = sample_depth[x] < 0.0F ? pushed : sample_depth[x];
            }
            if (!plan.hidden) continue;
            const std::uint8_t* const hidden =
                plan.hidden->data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(plan.width_px);
            for (int x = 0; x < plan.width_px; ++x) {
                color[x] = hidden[x] != 0 ? kernels::kOpaqueBlack : color[x];
                depth[x] = hidden[x] != 0 ? 0.0F : depth[x];
            }
        }
    });
}

void PushPullPyramid::reconstruct(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target) {
    int width = image.width_px;
    int height = image.height_px;
    std::size_t count = 0;
    do {
        const int fine_width = width;
        const int fine_height = height;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
        if (levels_.size() == count) levels_.emplace_back();
        levels_[count].resize(width, height);
        const Level* const fine = count == 0 ? nullptr : &levels_[count - 1];
        parallel_ranges(0, height, kRowGrain, [&](int first, int last) {
            PullRows rows(fine_width);
            for (int y = first; y < last; ++y) {
                rows.clear();
                for (int dy = -1; dy <= 1; ++dy) {
                    const int from = 2 * y + dy;
                    if (from < 0 || from >= fine_height) continue;
                    const unsigned kernel = dy == 0 ? 2 : 1;
                    const auto start = static_cast<std::size_t>(from) * static_cast<std::size_t>(fine_width);
                    if (fine == nullptr)
                        rows.add(image.color.data() + start, image.inverse_depth_per_m.data() + start, kernel);
                    else
                        rows.add(*fine, from, kernel);
                }
                rows.write(levels_[count], y);
            }
        });
        ++count;
    } while (width > 1 || height > 1);
    for (std::size_t l = count - 1; l > 0; --l) push(levels_[l], levels_[l - 1]);
    show(plan, image, levels_[0], target);
}

}  // namespace macula
