#include "server/render/nearest_search.h"

#include <algorithm>
#include <array>

#include "protocol/gl/kernel_language.h"
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

#include "server/kernels/nearest_samples.h"

namespace macula {

namespace {

constexpr int kRadius_px = kernels::kNearbyRadius_px;
constexpr int kBlock_px = 32;
constexpr int kRowGrain = 8;
constexpr float kUnfinished = -1.0F;

}  // namespace

/// What neighbouring pixels of a row have found.
struct NearestSearch::Block {
    std::array<std::uint16_t, kBlock_px> count;  ///< samples found, `wanted` or more where the search is over
    std::array<std::uint8_t, kBlock_px> hidden;
    /// Index into offsets_ of the samples found.
    std::array<std::array<std::uint16_t, kBlock_px>, kernels::kMostNeighbours> found;
};

NearestSearch::NearestSearch(int wanted) : wanted_(wanted), offsets_(nearest_offsets()) {}

void NearestSearch::mark_samples(const SampleImage& image) {
    const auto stride = static_cast<std::size_t>(image.width_px + 2 * kRadius_px + kBlock_px);
    const std::size_t size = stride * static_cast<std::size_t>(image.height_px + 2 * kRadius_px);
    if (present_stride_ != stride || present_.size() != size) present_.assign(size, 0);
    present_stride_ = stride;
    parallel_ranges(0, image.height_px, kRowGrain, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const float* const depth = image.inverse_depth_per_m.data() +
                                       static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px);
            std::uint8_t* const to =
                present_.data() + static_cast<std::size_t>(y + kRadius_px) * present_stride_ + kRadius_px;
            for (int x = 0; x < image.width_px; ++x) to[x] = depth[x] < 0.0F ? 0 : 1;
        }
    });
    steps_.clear();
    for (const SamplePosition& offset : offsets_)
        steps_.push_back(offset.y_px * static_cast<std::ptrdiff_t>(present_stride_) + offset.x_px);
}

template <int wanted>
void NearestSearch::search(const std::uint8_t* present, Block& block) const {
    constexpr std::uint16_t kWanted = wanted;
    for (int i = 0; i < kBlock_px; ++i) {
        // A sample at the pixel itself is all it needs.
        block.count[i] = (block.hidden[i] | present[i]) != 0 ? kWanted : std::uint16_t{0};
        block.found[0][i] = 0;
    }
    constexpr std::size_t kTriesBetweenChecks = 4;
    for (std::size_t o = 1; o < offsets_.size(); o += kTriesBetweenChecks) {
        std::uint16_t least = kWanted;
        for (int i = 0; i < kBlock_px; ++i) least = std::min(least, block.count[i]);
        if (least == kWanted) return;
        const std::size_t last = std::min(o + kTriesBetweenChecks, offsets_.size());
        for (std::size_t t = o; t < last; ++t) {
            const std::uint8_t* const there = present + steps_[t];
            for (int i = 0; i < kBlock_px; ++i) {
                const auto slot = static_cast<std::uint16_t>(there[i] != 0 ? block.count[i] : kWanted);
                for (std::uint16_t s = 0; s < kWanted; ++s)
                    block.found[s][i] = slot == s ? static_cast<std::uint16_t>(t) : block.found[s][i];
                block.count[i] = static_cast<std::uint16_t>(block.count[i] + (slot < kWanted ? 1 : 0));
            }
        }
    }
}

void NearestSearch::write_block(const SampleImage& image, glm::ivec2 place, int width, const Block& block,
                                const ReconstructTarget& target, std::uint8_t& unfinished) const {
    const glm::ivec2 in_image = place + image.guard_px;
    const std::size_t own = image.index(place);
    Rgba8* const color =
        target.color + static_cast<std::size_t>(place.y) * target.color_stride_px + static_cast<std::size_t>(place.x);
    float* const depth = target.inverse_depth_per_m + static_cast<std::size_t>(place.y) * target.depth_stride_px +
                         static_cast<std::size_t>(place.x);
    const kernels::NearestSource source{image, columns_, offsets_};
    for (int i = 0; i < width; ++i) {
        if (block.hidden[i] != 0) {
            color[i] = kernels::kOpaqueBlack;
            depth[i] = 0.0F;
        } else if (image.inverse_depth_per_m[own + static_cast<std::size_t>(i)] >= 0.0F) {
            color[i] = image.color[own + static_cast<std::size_t>(i)];
            depth[i] = image.inverse_depth_per_m[own + static_cast<std::size_t>(i)];
        } else if (block.count[i] < wanted_) {
            depth[i] = kUnfinished;
            unfinished = 1;
        } else {
            kernels::NearestSamples held;
            held.count = wanted_;
            for (int s = 0; s < wanted_; ++s) {
                const glm::ivec2 offset = kernels::nearby(source, block.found[static_cast<std::size_t>(s)][i]);
                held.distance_sq[s] = offset.x * offset.x + offset.y * offset.y;
                held.place[s] = in_image + glm::ivec2(i, 0) + offset;
            }
            kernels::blend_nearest(source, held, color[i], depth[i]);
        }
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
        Block block{};
        for (int y = first; y < last; ++y) {
            const std::uint8_t* const present =
                present_.data() + static_cast<std::size_t>(y + image.guard_px + kRadius_px) * present_stride_ +
                static_cast<std::size_t>(image.guard_px + kRadius_px);
            const std::uint8_t* const hidden =
                plan.hidden
                    ? plan.hidden->data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(plan.width_px)
                    : nullptr;
            for (int x = 0; x < plan.width_px; x += kBlock_px) {
                const int width = std::min(kBlock_px, plan.width_px - x);
                for (int i = 0; i < kBlock_px; ++i)
                    block.hidden[i] = i >= width || (hidden != nullptr && hidden[x + i] != 0) ? 1 : 0;
                if (wanted_ == 1)
                    search<1>(present + x, block);
                else
                    search<kernels::kMostNeighbours>(present + x, block);
                write_block(image, {x, y}, width, block, target, unfinished_[static_cast<std::size_t>(y)]);
            }
        }
    });
    finish_rows(plan, image, target);
}

}  // namespace macula
