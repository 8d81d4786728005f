#include "server/render/sample_image.h"

#include <algorithm>

#include "masks/mesh/mesh_table.h"
#include "server/render/parallel_ranges.h"

namespace macula {

namespace {

// A few thousand samples or some rows: a part worth handing to another thread.
constexpr int kSampleGrain = 16384;
constexpr int kRowGrain = 64;

}  // namespace

int guard_px(const SamplePlan& plan) {
    if (plan.has_mesh()) return kMeshReach_px;
    return plan.has_tiles() ? 2 * kTileEdge_px : 0;
}

void SampleImage::fill(const SamplePlan& plan, const Samples& samples, bool clear) {
    guard_px = macula::guard_px(plan);
    width_px = plan.width_px + 2 * guard_px;
    height_px = plan.height_px + 2 * guard_px;
    const auto width = static_cast<std::size_t>(width_px);
    const std::size_t pixels = width * static_cast<std::size_t>(height_px);
    color.resize(pixels);
    inverse_depth_per_m.resize(pixels);
    if (clear)
        parallel_ranges(0, height_px, kRowGrain, [&](int first, int last) {
            std::fill_n(inverse_depth_per_m.data() + static_cast<std::size_t>(first) * width,
                        static_cast<std::size_t>(last - first) * width, -1.0F);
        });

    // By address instead of in trace order: plan and samples are read as streams, and neighbouring addresses lie near
    // each other in the picture.
    Rgba8* const color_at_origin = color.data() + index({0, 0});
    float* const depth_at_origin = inverse_depth_per_m.data() + index({0, 0});
    parallel_ranges(0, static_cast<int>(plan.address_count()), kSampleGrain, [&](int first, int last) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
            const float depth = samples.inverse_depth_per_m[i];
            if (depth < 0.0F) continue;
            const SamplePosition at = plan.position[i];
            const std::ptrdiff_t pixel = std::ptrdiff_t{at.y_px} * width_px + at.x_px;
            color_at_origin[pixel] = samples.color[i];
            depth_at_origin[pixel] = depth;
        }
    });
}

}  // namespace macula
