#include "server/render/nearest_search.h"

#include <algorithm>
#include <array>
#include <bit>

#include "protocol/gl/kernel_language.h"
#include "server/render/lanes.h"
#include "server/render/nearest_offsets.h"
#include "server/render/parallel_ranges.h"

namespace macula::kernels {

namespace {

struct NearestSource {
    const SampleImage& image;
    const NearestColumns& columns;
    const std::vector<SamplePosition>& offsets;

    [[nodiscard]] std::size_t index(ivec2 pixel) const {
        return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(image.width_px) +
               static_cast<std::size_t>(pixel.x);
    }
};

ivec2 nearby(const NearestSource& source, int i) {
    const SamplePosition offset = source.offsets[static_cast<std::size_t>(i)];
    return {offset.x_px, offset.y_px};
}
bool has_sample(const NearestSource& source, ivec2 pixel) {
    return source.image.inverse_depth_per_m[source.index(pixel)] >= 0.0F;
}
int above(const NearestSource& source, ivec2 pixel) {
    return source.columns.above[source.index(pixel)];
}
int below(const NearestSource& source, ivec2 pixel) {
    return source.columns.below[source.index(pixel)];
}
uint nearest_color(const NearestSource& source, ivec2 pixel) {
    return source.image.color[source.index(pixel)];
}
float nearest_inverse_depth(const NearestSource& source, ivec2 pixel) {
    return source.image.inverse_depth_per_m[source.index(pixel)];
}

}  // namespace

}  // namespace macula::kernels

#include "server/kernels/nearest_by_columns.h"

namespace macula {

namespace {

constexpr int kBlock_px = 64;  // bits of a word
constexpr int kRowGrain = 8;
constexpr float kUnfinished = -1.0F;
// Words before and after a row's, and rows before and after the picture's, where a search finds nothing.
constexpr int kMarginWords = 1;
constexpr int kMarginRows = kernels::kNearbyRadius_px;
static_assert(kernels::kNearbyRadius_px <= kMarginWords * kBlock_px);

/// Sets bit i for each of up to 64 values for which `test(i)` holds.
template <class Test>
std::uint64_t mask_of(int count, Test&& test) {
    std::uint64_t mask = 0;
    for (int i = 0; i < count; ++i) mask |= static_cast<std::uint64_t>(test(i) ? 1 : 0) << i;
    return mask;
}

}  // namespace

/// 64 neighbouring pixels of a row.
struct NearestSearch::Block {
    std::uint64_t hidden = 0;   ///< a bit each, also beyond the window
    std::uint64_t sampled = 0;  ///< has a sample of its own
    std::uint64_t open = 0;     ///< has not found enough
    std::array<std::uint8_t, kBlock_px> count{};
    /// Per pixel: indices into offsets_ of the samples found.
    std::array<std::array<std::uint16_t, kernels::kMostNeighbours>, kBlock_px> found{};
};

NearestSearch::NearestSearch(int wanted) : wanted_(wanted), offsets_(nearest_offsets()) {}

void NearestSearch::mark_samples(const SampleImage& image) {
    const int words = (image.width_px + kBlock_px - 1) / kBlock_px + 2 * kMarginWords + 1;
    const std::size_t size =
        static_cast<std::size_t>(words) * static_cast<std::size_t>(image.height_px + 2 * kMarginRows);
    if (row_words_ != words || present_.size() != size) present_.assign(size, 0);
    row_words_ = words;
    parallel_ranges(0, image.height_px, kRowGrain, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const float* const depth = image.inverse_depth_per_m.data() +
                                       static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px);
            std::uint64_t* to = present_.data() + static_cast<std::ptrdiff_t>(y + kMarginRows) * words + kMarginWords;
            for (int x = 0; x < image.width_px; x += kBlock_px)
                *to++ = mask_of(std::min(kBlock_px, image.width_px - x), [&](int i) { return depth[x + i] >= 0.0F; });
        }
    });
    windows_.clear();
    for (const SamplePosition& offset : offsets_) {
        const int bit = kMarginWords * kBlock_px + image.guard_px + offset.x_px;
        windows_.push_back(
            {static_cast<std::ptrdiff_t>(offset.y_px + image.guard_px + kMarginRows) * words + bit / kBlock_px,
             static_cast<unsigned>(bit % kBlock_px)});
    }
}

void NearestSearch::search(const std::uint64_t* block_words, Block& block) const {
    block.count.fill(0);
    for (std::size_t t = 1; t < offsets_.size() && block.open != 0; ++t) {
        const Window& window = windows_[t];
        const std::uint64_t* const words = block_words + window.word;
        const std::uint64_t there = words[0] >> window.shift | words[1] << 1U << (kBlock_px - 1 - window.shift);
        for (std::uint64_t hits = there & block.open; hits != 0; hits &= hits - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(hits));
            block.found[i][block.count[i]++] = static_cast<std::uint16_t>(t);
            if (block.count[i] == wanted_) block.open &= ~(std::uint64_t{1} << i);
        }
    }
}

/// Pixels made of samples nearby, and those samples: arrays of the nearest, the second nearest and so on, so that the
/// loop over the pixels vectorises.
struct NearestSearch::Blends {
    template <class T>
    using Pixels = std::array<T, kBlock_px>;

    int count = 0;
    Pixels<int> x{};
    std::array<Pixels<int>, kernels::kMostNeighbours> distance_sq{};
    std::array<Pixels<Rgba8>, kernels::kMostNeighbours> color{};
    std::array<Pixels<float>, kernels::kMostNeighbours> inverse_depth{};
    Pixels<Rgba8> mean_color{};
    Pixels<float> mean_inverse_depth{};

    void run() {
        static_assert(kernels::kMostNeighbours == 4);
        MACULA_LANE_LOOP
        for (int i = 0; i < count; ++i) {
            const float first = inverse_depth[0][i];
            kernels::NearestSums sums = kernels::first_sums(color[0][i], first);
            const int least = distance_sq[0][i];
            kernels::add_sample(sums, first, kernels::nearby_weight(least, distance_sq[1][i]), color[1][i],
                                inverse_depth[1][i]);
            kernels::add_sample(sums, first, kernels::nearby_weight(least, distance_sq[2][i]), color[2][i],
                                inverse_depth[2][i]);
            kernels::add_sample(sums, first, kernels::nearby_weight(least, distance_sq[3][i]), color[3][i],
                                inverse_depth[3][i]);
            mean_color[i] = kernels::mean_color(sums);
            mean_inverse_depth[i] = kernels::mean_inverse_depth(sums, first);
        }
    }
};

void NearestSearch::write_block(const SampleImage& image, std::size_t own, int width, const Block& block,
                                Blends& blends, Rgba8* color, float* depth) const {
    const Rgba8* const own_color = image.color.data() + own;
    const float* const own_depth = image.inverse_depth_per_m.data() + own;
    for (int i = 0; i < width; ++i) {
        const bool hidden = (block.hidden >> i & 1U) != 0;
        color[i] = hidden ? kernels::kOpaqueBlack : own_color[i];
        depth[i] = hidden ? 0.0F : own_depth[i];  // kUnfinished where there is no sample
    }
    blends.count = 0;
    for (std::uint64_t made = ~(block.hidden | block.sampled | block.open); made != 0; made &= made - 1) {
        const int i = std::countr_zero(made);
        const auto& found = block.found[static_cast<std::size_t>(i)];
        const std::size_t n = static_cast<std::size_t>(blends.count++);
        blends.x[n] = i;
        for (std::size_t s = 0; s < static_cast<std::size_t>(wanted_); ++s) {
            const SamplePosition offset = offsets_[found[s]];
            const std::ptrdiff_t at = i + std::ptrdiff_t{offset.y_px} * image.width_px + offset.x_px;
            blends.distance_sq[s][n] = offset.x_px * offset.x_px + offset.y_px * offset.y_px;
            blends.color[s][n] = own_color[at];
            blends.inverse_depth[s][n] = own_depth[at];
        }
    }
    if (wanted_ > 1) blends.run();
    const auto& colors = wanted_ > 1 ? blends.mean_color : blends.color[0];
    const auto& depths = wanted_ > 1 ? blends.mean_inverse_depth : blends.inverse_depth[0];
    for (int n = 0; n < blends.count; ++n) {
        color[blends.x[n]] = colors[n];
        depth[blends.x[n]] = depths[n];
    }
}

void NearestSearch::finish_rows(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target) {
    if (std::none_of(unfinished_.begin(), unfinished_.end(), [](std::uint8_t row) { return row != 0; })) return;
    columns_.find(image);
    const kernels::NearestSource source{image, columns_, offsets_};
    parallel_ranges(0, plan.height_px, 1, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            if (unfinished_[static_cast<std::size_t>(y)] == 0) continue;
            Rgba8* const color = target.color + static_cast<std::size_t>(y) * target.color_stride_px;
            float* const depth = target.inverse_depth_per_m + static_cast<std::size_t>(y) * target.depth_stride_px;
            for (int x = 0; x < plan.width_px; ++x) {
                if (depth[x] != kUnfinished) continue;
                const glm::ivec2 at = glm::ivec2(x, y) + image.guard_px;
                const auto held = kernels::find_by_columns(source, image.width_px, at, wanted_);
                kernels::blend_nearest(source, held, color[x], depth[x]);
            }
        }
    });
}

void NearestSearch::reconstruct(const SamplePlan& plan, const SampleImage& image, const ReconstructTarget& target) {
    mark_samples(image);
    unfinished_.assign(static_cast<std::size_t>(plan.height_px), 0);
    parallel_ranges(0, plan.height_px, kRowGrain, [&](int first, int last) {
        Block block;
        Blends blends;
        for (int y = first; y < last; ++y) {
            const std::uint64_t* const row = present_.data() + static_cast<std::ptrdiff_t>(y) * row_words_;
            const std::size_t first_pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(plan.width_px);
            for (int x = 0; x < plan.width_px; x += kBlock_px) {
                const int width = std::min(kBlock_px, plan.width_px - x);
                const std::size_t own = image.index({x, y});
                block.hidden = width == kBlock_px ? 0 : ~std::uint64_t{0} << width;
                if (plan.hidden) {
                    const std::uint8_t* const hidden = plan.hidden->data() + first_pixel + static_cast<std::size_t>(x);
                    block.hidden |= mask_of(width, [&](int i) { return hidden[i] != 0; });
                }
                block.sampled = mask_of(width, [&](int i) { return image.inverse_depth_per_m[own + i] >= 0.0F; });
                block.open = ~(block.hidden | block.sampled);
                search(row + x / kBlock_px, block);
                write_block(image, own, width, block, blends,
                            target.color + static_cast<std::size_t>(y) * target.color_stride_px + x,
                            target.inverse_depth_per_m + static_cast<std::size_t>(y) * target.depth_stride_px + x);
                if (block.open != 0) unfinished_[static_cast<std::size_t>(y)] = 1;
            }
        }
    });
    finish_rows(plan, image, target);
}

}  // namespace macula
