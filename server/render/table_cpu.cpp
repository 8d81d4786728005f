#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "server/render/lanes.h"
#include "server/render/mesh_reconstructors.h"
#include "server/render/parallel_ranges.h"
#include "server/render/reconstruction.h"
#include "server/render/sample_image.h"
#include "server/render/table_source.h"

namespace macula {

namespace {

constexpr int kRowGrain = 16;
constexpr int kSampleGrain = 16384;
constexpr int kStrip_px = 64;

/// A sample: colour in the lower half, the bits of its inverse depth in the upper.
using Texel = std::uint64_t;

Texel texel(Rgba8 color, float inverse_depth) {
    return color | Texel{std::bit_cast<std::uint32_t>(inverse_depth)} << 32U;
}
Rgba8 color_of(Texel texel) {
    return static_cast<Rgba8>(texel);
}
float inverse_depth_of(Texel texel) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(texel >> 32U));
}

/// The samples at their pixels, as SampleImage has them, but both values side by side: a pixel looks up three places
/// instead of six, which saved a quarter of the time.
class TexelImage {
public:
    void fill(const SamplePlan& plan, const Samples& samples) {
        guard_px_ = guard_px(plan);
        width_px_ = plan.width_px + 2 * guard_px_;
        texels_.resize(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(plan.height_px + 2 * guard_px_));
        Texel* const at_origin = texels_.data() + index(0, 0);
        parallel_ranges(0, static_cast<int>(plan.address_count()), kSampleGrain, [&](int first, int last) {
            for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
                const float depth = samples.inverse_depth_per_m[i];
                if (depth < 0.0F) continue;
                const SamplePosition at = plan.position[i];
                at_origin[std::ptrdiff_t{at.y_px} * width_px_ + at.x_px] = texel(samples.color[i], depth);
            }
        });
    }
    [[nodiscard]] int width_px() const { return width_px_; }
    /// A pixel of the window.
    [[nodiscard]] const Texel* at(int x, int y) const { return texels_.data() + index(x, y); }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y + guard_px_) * static_cast<std::size_t>(width_px_) +
               static_cast<std::size_t>(x + guard_px_);
    }

    int guard_px_ = 0;
    int width_px_ = 0;
    std::vector<Texel> texels_;
};

template <class T>
struct Strip {
    alignas(64) T value[kStrip_px];

    T& operator[](int i) { return value[i]; }
    const T& operator[](int i) const { return value[i]; }
};

/// Makes rows by loops that a compiler turns into vector instructions.
class TableRows {
public:
    TableRows(const SamplePlan& plan, const TexelImage& image) : plan_(plan), image_(image) {}

    void reconstruct(int y, Rgba8* color, float* inverse_depth) const {
        if (plan_.width_px < kStrip_px) return reconstruct_narrow(y, color, inverse_depth);
        // The last strip may begin inside the one before: pixels made twice come out alike.
        for (int x = 0; x < plan_.width_px; x += kStrip_px) {
            const int first = std::min(x, plan_.width_px - kStrip_px);
            strip(first, y, color + first, inverse_depth + first);
        }
    }

private:
    /// Bytes of a strip's table entries; zeros say that a pixel shows its own sample.
    using Words = Strip<std::array<std::uint32_t, 2>>;

    /// A row that is shorter than a strip.
    void reconstruct_narrow(int y, Rgba8* color, float* inverse_depth) const {
        const int count = plan_.width_px;
        Words words{};
        std::memcpy(words.value, entries(0, y), static_cast<std::size_t>(count) * sizeof(MeshPixel));
        Strip<Rgba8> strip_color;
        Strip<float> strip_depth;
        interpolate(words, image_.at(0, y), strip_color.value, strip_depth.value);
        if (plan_.hidden) hide(hidden(0, y), count, strip_color.value, strip_depth.value);
        std::copy_n(strip_color.value, count, color);
        std::copy_n(strip_depth.value, count, inverse_depth);
    }

    void strip(int x, int y, Rgba8* color, float* inverse_depth) const {
        if (plan_.hidden && all_hidden(hidden(x, y))) {
            std::fill_n(color, kStrip_px, kernels::kOpaqueBlack);
            std::fill_n(inverse_depth, kStrip_px, 0.0F);
            return;
        }
        Words words;
        std::memcpy(words.value, entries(x, y), sizeof(words.value));
        interpolate(words, image_.at(x, y), color, inverse_depth);
        if (plan_.hidden) hide(hidden(x, y), kStrip_px, color, inverse_depth);
    }

    [[nodiscard]] const std::uint8_t* hidden(int x, int y) const {
        return plan_.hidden->data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(plan_.width_px) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] const MeshPixel* entries(int x, int y) const {
        const glm::ivec2 in_mask = plan_.mesh_origin_px + glm::ivec2(x, y);
        return plan_.mesh->pixels().data() +
               static_cast<std::size_t>(in_mask.y) * static_cast<std::size_t>(plan_.mesh->mesh().width_px) +
               static_cast<std::size_t>(in_mask.x);
    }

    static bool all_hidden(const std::uint8_t* hidden) {
        int shown = 0;
        for (int i = 0; i < kStrip_px; ++i) shown += hidden[i] == 0 ? 1 : 0;
        return shown == 0;
    }
    static bool all_sites(const Words& words) {
        std::uint32_t any = 0;
        for (int i = 0; i < kStrip_px; ++i) any |= words[i][0] | words[i][1];
        return any == 0;
    }
    static void hide(const std::uint8_t* hidden, int count, Rgba8* color, float* inverse_depth) {
        MACULA_LANE_LOOP
        for (int i = 0; i < count; ++i) {
            color[i] = hidden[i] != 0 ? kernels::kOpaqueBlack : color[i];
            inverse_depth[i] = hidden[i] != 0 ? 0.0F : inverse_depth[i];
        }
    }

    /// A strip whose first pixel lies at `texels`.
    void interpolate(const Words& words, const Texel* texels, Rgba8* color, float* inverse_depth) const {
        if (all_sites(words)) {
            MACULA_LANE_LOOP
            for (int i = 0; i < kStrip_px; ++i) {
                color[i] = color_of(texels[i]);
                inverse_depth[i] = inverse_depth_of(texels[i]);
            }
            return;
        }
        const int row = image_.width_px();
        Strip<std::int32_t> a;
        Strip<std::int32_t> b;
        Strip<std::int32_t> c;
        Strip<std::uint32_t> weights;
        MACULA_LANE_LOOP
        for (int i = 0; i < kStrip_px; ++i) {
            const std::uint32_t ab = words[i][0];
            const std::uint32_t c_weights = words[i][1];
            a[i] = i + kernels::signed_byte(ab, 8U) * row + kernels::signed_byte(ab, 0U);
            b[i] = i + kernels::signed_byte(ab, 24U) * row + kernels::signed_byte(ab, 16U);
            c[i] = i + kernels::signed_byte(c_weights, 8U) * row + kernels::signed_byte(c_weights, 0U);
            weights[i] = c_weights >> 16U;
        }
        Strip<Texel> texel_a;
        Strip<Texel> texel_b;
        Strip<Texel> texel_c;
        // Volatile, so that these are loads of 64 bits: the compiler would take gather instructions, with which a
        // picture took a seventh longer.
        const volatile Texel* const at_any_place = texels;
        for (int i = 0; i < kStrip_px; ++i) {
            texel_a[i] = at_any_place[a[i]];
            texel_b[i] = at_any_place[b[i]];
            texel_c[i] = at_any_place[c[i]];
        }
        MACULA_LANE_LOOP
        for (int i = 0; i < kStrip_px; ++i) {
            const std::uint32_t weight_b = weights[i] & 255U;
            const std::uint32_t weight_c = weights[i] >> 8U;
            color[i] = kernels::blend_color(color_of(texel_a[i]), color_of(texel_b[i]), color_of(texel_c[i]),
                                            256 - weight_b - weight_c, weight_b, weight_c);
            inverse_depth[i] = kernels::blend_inverse_depth(inverse_depth_of(texel_a[i]), inverse_depth_of(texel_b[i]),
                                                            inverse_depth_of(texel_c[i]), weight_b, weight_c);
        }
    }

    const SamplePlan& plan_;
    const TexelImage& image_;
};

class CpuTableReconstructor final : public Reconstructor {
public:
    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::table, plan); !fits) return fits;
        image_.fill(plan, samples);
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
    TexelImage image_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_cpu_table_reconstructor() {
    return std::make_unique<CpuTableReconstructor>();
}

}  // namespace macula
