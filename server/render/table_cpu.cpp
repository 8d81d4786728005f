#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "server/render/lanes.h"
#include "server/render/mesh_reconstructors.h"
#include "server/render/parallel_ranges.h"
#include "server/render/reconstruction.h"
#include "server/render/sample_image.h"
#include "server/render/table_source.h"

namespace macula {

namespace {

constexpr int kRowGrain = 16;
constexpr int kStrip_px = 64;

/// Pixels of a row that are made together: what each gathers, before and after.
struct Strip {
    template <class T>
    using Values = std::array<T, kStrip_px>;

    alignas(64) Values<std::int32_t> a;
    alignas(64) Values<std::int32_t> b;
    alignas(64) Values<std::int32_t> c;
    alignas(64) Values<std::uint32_t> weight_b;
    alignas(64) Values<std::uint32_t> weight_c;
    alignas(64) Values<Rgba8> color_a;
    alignas(64) Values<Rgba8> color_b;
    alignas(64) Values<Rgba8> color_c;
    alignas(64) Values<float> depth_a;
    alignas(64) Values<float> depth_b;
    alignas(64) Values<float> depth_c;
};

/// Makes rows by loops that a compiler turns into vector instructions.
class TableRows {
public:
    TableRows(const SamplePlan& plan, const SampleImage& image) : plan_(plan), image_(image) {}

    void reconstruct(int y, Rgba8* color, float* inverse_depth) const {
        int x = 0;
        for (; x + kStrip_px <= plan_.width_px; x += kStrip_px) strip(x, y, kStrip_px, color + x, inverse_depth + x);
        if (x < plan_.width_px) strip(x, y, plan_.width_px - x, color + x, inverse_depth + x);
    }

private:
    void strip(int x, int y, int count, Rgba8* color, float* inverse_depth) const {
        const std::uint8_t* const hidden =
            plan_.hidden
                ? plan_.hidden->data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(plan_.width_px) +
                      static_cast<std::size_t>(x)
                : nullptr;
        if (hidden != nullptr && std::all_of(hidden, hidden + count, [](std::uint8_t h) { return h != 0; })) {
            std::fill_n(color, count, kernels::kOpaqueBlack);
            std::fill_n(inverse_depth, count, 0.0F);
            return;
        }
        Strip strip;
        const glm::ivec2 in_mask = plan_.mesh_origin_px + glm::ivec2(x, y);
        const MeshTable& table = *plan_.mesh;
        const MeshPixel* const entries =
            table.pixels().data() +
            static_cast<std::size_t>(in_mask.y) * static_cast<std::size_t>(table.mesh().width_px) +
            static_cast<std::size_t>(in_mask.x);
        const int row = image_.width_px;
        MACULA_LANE_LOOP
        for (int i = 0; i < count; ++i) {
            strip.a[i] = i + entries[i].ay * row + entries[i].ax;
            strip.b[i] = i + entries[i].by * row + entries[i].bx;
            strip.c[i] = i + entries[i].cy * row + entries[i].cx;
            strip.weight_b[i] = entries[i].weight_b;
            strip.weight_c[i] = entries[i].weight_c;
        }
        const Rgba8* const colors = image_.color.data() + image_.index({x, y});
        const float* const depths = image_.inverse_depth_per_m.data() + image_.index({x, y});
        for (int i = 0; i < count; ++i) {
            strip.color_a[i] = colors[strip.a[i]];
            strip.color_b[i] = colors[strip.b[i]];
            strip.color_c[i] = colors[strip.c[i]];
            strip.depth_a[i] = depths[strip.a[i]];
            strip.depth_b[i] = depths[strip.b[i]];
            strip.depth_c[i] = depths[strip.c[i]];
        }
        MACULA_LANE_LOOP
        for (int i = 0; i < count; ++i) {
            const std::uint32_t weight_b = strip.weight_b[i];
            const std::uint32_t weight_c = strip.weight_c[i];
            color[i] = kernels::blend_color(strip.color_a[i], strip.color_b[i], strip.color_c[i],
                                            256 - weight_b - weight_c, weight_b, weight_c);
            inverse_depth[i] =
                kernels::blend_inverse_depth(strip.depth_a[i], strip.depth_b[i], strip.depth_c[i], weight_b, weight_c);
        }
        if (hidden == nullptr) return;
        for (int i = 0; i < count; ++i) {
            color[i] = hidden[i] != 0 ? kernels::kOpaqueBlack : color[i];
            inverse_depth[i] = hidden[i] != 0 ? 0.0F : inverse_depth[i];
        }
    }

    const SamplePlan& plan_;
    const SampleImage& image_;
};

class CpuTableReconstructor final : public Reconstructor {
public:
    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::table, plan); !fits) return fits;
        image_.fill(plan, samples, false);
        const TableRows rows(plan, image_);
        parallel_ranges(0, plan.height_px, kRowGrain, [&](int first, int last) {
            for (int y = first; y < last; ++y)
                rows.reconstruct(y, target.color + static_cast<std::size_t>(y) * target.color_stride_px,
                                 target.inverse_depth_per_m + static_cast<std::size_t>(y) * target.depth_stride_px);
        });
        return {};
    }
    [[nodiscard]] std::string name() const override { return "C++"; }

private:
    SampleImage image_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_cpu_table_reconstructor() {
    return std::make_unique<CpuTableReconstructor>();
}

}  // namespace macula
