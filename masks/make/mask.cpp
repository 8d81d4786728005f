#include "masks/make/mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "masks/make/density.h"
#include "masks/make/placement.h"

namespace macula {
namespace {

constexpr int kBorderStep_px = 8;  // the distance of sites of kLeastDensity
/// How far the share may miss the preset's for another drawing not to be worth its time, and for the mask to be right.
constexpr double kGoodShareError = 0.0005;
constexpr double kShareError = 0.002;
constexpr int kMaxDrawings = 8;

/// Samples pixels along a line of `count` so that no kBorderStep_px follow each other without a sample.
template <class Pixel>
void close_line(int count, Pixel&& pixel) {
    int last = -kBorderStep_px;
    for (int i = 0; i < count; ++i) {
        std::uint8_t& sampled = pixel(i);
        if (i - last >= kBorderStep_px || i == count - 1) sampled = 1;
        if (sampled != 0) last = i;
    }
}

Mask full_mask(const Recipe& recipe, glm::ivec2 window_px) {
    const std::size_t pixels = static_cast<std::size_t>(window_px.x) * window_px.y;
    return {window_px.x, window_px.y, axis_px(recipe.display, kLeftEye), std::vector<std::uint8_t>(pixels, 1),
            to_json(recipe)};
}

tl::unexpected<Error> out_of_reach(const Recipe& recipe, double nearest) {
    std::array<char, 160> text{};
    std::snprintf(
        text.data(), text.size(),
        "no mask samples %.2f %% of the pixels: the nearest that the preset's law gives on this display, with at "
        "least %.1f %% everywhere, is %.2f %%",
        100.0 * recipe.preset.share, 100.0 * kLeastDensity, 100.0 * nearest);
    return fail(ErrorCode::option, "sampling '" + recipe.preset.name + "': " + text.data());
}

}  // namespace

Expected<Mask> make_mask(const Recipe& recipe, const MaskProgress& progress) {
    const auto tell = [&progress](const char* stage, double share) {
        if (progress) progress(stage, share);
    };
    const glm::ivec2 window_px(recipe.display.eye_width_px, recipe.display.eye_height_px);
    if (recipe.preset.full) return full_mask(recipe, window_px);

    const MaskField field(recipe.display, recipe.geometry);
    Mask mask{2 * window_px.x, 2 * window_px.y, window_px, {}, to_json(recipe)};
    // The law is solved on the densities that the placement has on average. What the sites drawn by it miss, by chance
    // or because the density changes from pixel to pixel, is made up for by another drawing.
    Recipe aimed = recipe;
    Sites best;
    double best_share = 0.0;
    double share_before = -1.0;
    for (int drawing = 0; drawing < kMaxDrawings; ++drawing) {
        tell("solving the law", 1.0 * drawing / kMaxDrawings);
        const AcuityLaw law = mask_law(aimed);
        tell("placing the samples", 1.0 * drawing / kMaxDrawings);
        mask.sampled = place(recipe.placement,
                             make_density_map(field, law, {mask.width_px, mask.height_px}, mask.gaze_px), recipe.seed);
        close_border(mask);
        if (recipe.preset.free == SamplingPreset::Free::nothing) return mask;
        const double share = sampled_share(mask, window_px, axis_px(recipe.display, kLeftEye));
        const double missed = recipe.preset.share - share;
        if (best.empty() || std::abs(missed) < std::abs(recipe.preset.share - best_share)) {
            best.swap(mask.sampled);
            best_share = share;
        }
        if (std::abs(missed) <= kGoodShareError || share == share_before) break;
        share_before = share;
        aimed.preset.share = std::clamp(aimed.preset.share + missed, 0.0, 1.0);
    }
    if (std::abs(recipe.preset.share - best_share) > kShareError) return out_of_reach(recipe, best_share);
    mask.sampled = std::move(best);
    return mask;
}

void close_border(Mask& mask) {
    const auto at = [&mask](int x, int y) -> std::uint8_t& {
        return mask.sampled[static_cast<std::size_t>(y) * mask.width_px + x];
    };
    const int right = mask.width_px - 1;
    const int bottom = mask.height_px - 1;
    close_line(mask.width_px, [&at](int x) -> std::uint8_t& { return at(x, 0); });
    close_line(mask.width_px, [&](int x) -> std::uint8_t& { return at(x, bottom); });
    close_line(mask.height_px, [&at](int y) -> std::uint8_t& { return at(0, y); });
    close_line(mask.height_px, [&](int y) -> std::uint8_t& { return at(right, y); });
}

double sampled_share(const Mask& mask, glm::ivec2 window_px, glm::ivec2 gaze_px) {
    const glm::ivec2 origin_px = mask.gaze_px - gaze_px;
    const glm::ivec2 begin = glm::clamp(origin_px, glm::ivec2(0), {mask.width_px, mask.height_px});
    const glm::ivec2 end = glm::clamp(origin_px + window_px, begin, {mask.width_px, mask.height_px});
    std::int64_t count = 0;
    for (int y = begin.y; y < end.y; ++y) {
        const auto row = mask.sampled.begin() + static_cast<std::ptrdiff_t>(y) * mask.width_px;
        count += std::count_if(row + begin.x, row + end.x, [](std::uint8_t sampled) { return sampled != 0; });
    }
    return static_cast<double>(count) / (1.0 * window_px.x * window_px.y);
}

glm::ivec2 axis_px(const Display& display, Eye eye) {
    const Tangents& edge = display.eyes[eye].tangents;
    const double x = -double{edge.left} / (double{edge.right} - edge.left) * display.eye_width_px;
    const double y = double{edge.top} / (double{edge.top} - edge.bottom) * display.eye_height_px;
    return {static_cast<int>(std::clamp(std::floor(x), 0.0, display.eye_width_px - 1.0)),
            static_cast<int>(std::clamp(std::floor(y), 0.0, display.eye_height_px - 1.0))};
}

}  // namespace macula
