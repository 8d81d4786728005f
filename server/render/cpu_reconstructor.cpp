#include <algorithm>
#include <array>

#include "server/render/palette_lookup.h"
#include "server/render/parallel_ranges.h"
#include "server/render/reconstruct_source.h"
#include "server/render/reconstructor.h"

namespace macula {

namespace {

/// Makes pictures of tiles by loops that a compiler turns into vector instructions. Where a tile misses samples, the
/// few pixels that need them are left to the kernel.
class TileReconstructor {
public:
    TileReconstructor(const kernels::ReconstructSource& source, const kernels::ReconstructView& view)
        : source_(source), view_(view) {}

    void reconstruct(int tile_x, int tile_y, Patch& pixels) const {
        const int tile = tile_y * view_.tiles.x + tile_x;
        switch (kernels::tile_count(source_, tile)) {
            case 0:
                pixels.color.fill(kernels::kOpaqueBlack);
                pixels.inverse_depth.fill(0.0F);
                break;
            case kTileArea_px:
                copy_full(tile, pixels);
                black_out_hidden({tile_x, tile_y}, pixels);
                break;
            default:
                interpolate(tile, {tile_x, tile_y}, pixels);
        }
    }

private:
    void copy_full(int tile, Patch& pixels) const {
        const int offset = kernels::tile_offset(source_, tile);
        const Rgba8* const color = source_.samples.color.data() + offset;
        const float* const inverse_depth = source_.samples.inverse_depth_per_m.data() + offset;
        for (std::size_t i = 0; i < kTileArea_px; ++i) {
            pixels.color[i] = inverse_depth[i] < 0.0F ? kernels::kOpaqueBlack : color[i];
            pixels.inverse_depth[i] = inverse_depth[i] < 0.0F ? 0.0F : inverse_depth[i];
        }
    }

    void interpolate(int tile, glm::ivec2 place, Patch& pixels) const {
        const glm::ivec2 in_rank_tile = (view_.first_cell + place) % RankTile::kCells;
        const CellTable& cell = source_.tables.cell(kernels::tile_level(source_, tile), in_rank_tile.x, in_rank_tile.y);
        Patch palette;
        const bool complete = fetch(tile, cell, palette);
        blend(cell, palette, pixels);
        black_out_hidden(place, pixels);
        if (complete) return;
        for (int i = 0; i < kTileArea_px; ++i)
            if (pixels.inverse_depth[i] < 0.0F)
                kernels::reconstruct_pixel(source_, view_, place, {i % kTileEdge_px, i / kTileEdge_px}, pixels.color[i],
                                           pixels.inverse_depth[i]);
    }

    /// Hidden pixels have no samples around them, and would search for some in vain.
    void black_out_hidden(glm::ivec2 place, Patch& pixels) const {
        if (source_.plan.hidden == nullptr) return;
        const glm::ivec2 top_left = view_.origin_px + kTileEdge_px * place;
        const glm::ivec2 first = glm::max(glm::ivec2(0), -top_left);
        const glm::ivec2 last = glm::min(glm::ivec2(kTileEdge_px), view_.size_px - top_left);
        for (int y = first.y; y < last.y; ++y) {
            const std::uint8_t* const hidden = source_.plan.hidden->data() +
                                               static_cast<std::ptrdiff_t>(top_left.y + y) * view_.size_px.x +
                                               top_left.x;
            for (int x = first.x; x < last.x; ++x) {
                if (hidden[x] == 0) continue;
                const std::size_t i = y * kTileEdge_px + x;
                pixels.color[i] = kernels::kOpaqueBlack;
                pixels.inverse_depth[i] = 0.0F;
            }
        }
    }

    /// Gathers the samples of a tile's palette; a missing one gets inverse depth -1. False: some are missing.
    bool fetch(int tile, const CellTable& cell, Patch& palette) const {
        const auto count = static_cast<std::size_t>(kernels::tile_count(source_, tile));
        const auto offset = static_cast<std::size_t>(kernels::tile_offset(source_, tile));
        const Rgba8* const color = source_.samples.color.data();
        const float* const inverse_depth = source_.samples.inverse_depth_per_m.data();
        std::copy_n(color + offset, count, palette.color.begin());
        std::copy_n(inverse_depth + offset, count, palette.inverse_depth.begin());
        for (std::size_t i = count; i < cell.palette.size(); ++i) {
            const int address =
                kernels::find_sample(source_, view_.tiles.x, tile, kernels::palette_entry(cell, static_cast<int>(i)));
            palette.color[i] = address < 0 ? 0U : color[address];
            palette.inverse_depth[i] = address < 0 ? -1.0F : inverse_depth[address];
        }
        float least = 0.0F;
        for (std::size_t i = 0; i < cell.palette.size(); ++i) least = std::min(least, palette.inverse_depth[i]);
        return least >= 0.0F;
    }

    /// Interpolates; a pixel of which a sample is missing gets inverse depth -1.
    static void blend(const CellTable& cell, const Patch& palette, Patch& pixels) {
        Patch a;
        Patch b;
        Patch c;
        look_up(palette, cell.palette.size(), cell.a, a);
        look_up(palette, cell.palette.size(), cell.b, b);
        look_up(palette, cell.palette.size(), cell.c, c);
        for (std::size_t i = 0; i < kTileArea_px; ++i) {
            const std::uint32_t weight_b = cell.weight_b[i];
            const std::uint32_t weight_c = cell.weight_c[i];
            pixels.color[i] =
                kernels::blend_color(a.color[i], b.color[i], c.color[i], 256 - weight_b - weight_c, weight_b, weight_c);
            const float depth = kernels::blend_inverse_depth(a.inverse_depth[i], b.inverse_depth[i], c.inverse_depth[i],
                                                             weight_b, weight_c);
            const float least = std::min(std::min(a.inverse_depth[i], b.inverse_depth[i]), c.inverse_depth[i]);
            pixels.inverse_depth[i] = least < 0.0F ? -1.0F : depth;
        }
    }

    const kernels::ReconstructSource& source_;
    const kernels::ReconstructView& view_;
};

/// Copies the part of a tile's picture that lies in the window.
template <class T>
void place(const std::array<T, kTileArea_px>& pixels, glm::ivec2 top_left, glm::ivec2 size, T* to, std::size_t stride) {
    const glm::ivec2 first = glm::max(glm::ivec2(0), -top_left);
    const glm::ivec2 last = glm::min(glm::ivec2(kTileEdge_px), size - top_left);
    const T* from = pixels.data() + kTileEdge_px * first.y + first.x;
    to += static_cast<std::size_t>(top_left.y + first.y) * stride + static_cast<std::size_t>(top_left.x + first.x);
    const bool whole_rows = last.x - first.x == kTileEdge_px;
    for (int y = first.y; y < last.y; ++y, from += kTileEdge_px, to += stride) {
        if (whole_rows)
            std::copy_n(from, kTileEdge_px, to);  // of known length: one instruction instead of a call
        else
            std::copy_n(from, last.x - first.x, to);
    }
}

class CpuReconstructor final : public Reconstructor {
public:
    explicit CpuReconstructor(std::shared_ptr<const TileTables> tables) : tables_(std::move(tables)) {}

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        const kernels::ReconstructSource source{plan, samples, *tables_};
        const kernels::ReconstructView view = reconstruct_view(plan);
        const TileReconstructor tiles(source, view);
        parallel_ranges(1, plan.tiles_y - 1, 1, [&](int first_row, int last_row) {
            Patch pixels;
            for (int tile_y = first_row; tile_y != last_row; ++tile_y)
                for (int tile_x = 1; tile_x < plan.tiles_x - 1; ++tile_x) {
                    tiles.reconstruct(tile_x, tile_y, pixels);
                    const glm::ivec2 top_left = plan.origin_px + kTileEdge_px * glm::ivec2(tile_x, tile_y);
                    place(pixels.color, top_left, view.size_px, target.color, target.color_stride_px);
                    place(pixels.inverse_depth, top_left, view.size_px, target.inverse_depth_per_m,
                          target.depth_stride_px);
                }
        });
        return {};
    }
    [[nodiscard]] std::string name() const override { return "C++"; }

private:
    std::shared_ptr<const TileTables> tables_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_cpu_reconstructor(std::shared_ptr<const TileTables> tables) {
    return std::make_unique<CpuReconstructor>(std::move(tables));
}

}  // namespace macula
