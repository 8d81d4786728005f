#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel_text/blend.h"
#include "kernel_text/picture_buffers.h"
#include "kernel_text/reconstruct.h"
#include "kernel_text/reconstruct_buffers.h"
#include "kernel_text/reconstruct_main.h"
#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "protocol/gl/context.h"
#include "server/render/gl_picture.h"
#include "server/render/reconstruct_source.h"
#include "server/render/reconstructor.h"

namespace macula {

namespace {

using kernels::ReconstructView;

/// The tables as the program reads them: 256 entries for each level and cell, level 0 and the full level unused.
struct FlatTables {
    std::vector<glm::uvec2> interpolations;
    std::vector<std::uint32_t> palettes;

    explicit FlatTables(const TileTables& tables) {
        constexpr int kCellTotal = RankTile::kCells * RankTile::kCells;
        interpolations.resize(std::size_t{kFullLevel} * kCellTotal * kTileArea_px);
        palettes.resize(interpolations.size());
        for (int table = kCellTotal; table < kFullLevel * kCellTotal; ++table) {
            const CellTable& cell =
                tables.cell(table / kCellTotal, table % RankTile::kCells, table % kCellTotal / RankTile::kCells);
            const auto first = static_cast<std::size_t>(table) * kTileArea_px;
            for (int i = 0; i < kTileArea_px; ++i) interpolations[first + i] = kernels::interpolation(cell, i);
            for (std::size_t i = 0; i < cell.palette.size(); ++i)
                palettes[first + i] = kernels::palette_entry(cell, static_cast<int>(i));
        }
    }
};

class GlReconstructor final : public Reconstructor {
public:
    /// The context is current.
    GlReconstructor(std::unique_ptr<GlContext> context, ComputeProgram program, const TileTables& tables)
        : context_(std::move(context)), program_(std::move(program)) {
        const FlatTables flat(tables);
        interpolations_.write(flat.interpolations);
        palettes_.write(flat.palettes);
    }

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        const auto current = CurrentContext::enter(*context_);
        if (!current) return tl::unexpected(current.error());
        upload(plan, samples);
        bind();
        program_.dispatch(static_cast<unsigned>(plan.tiles_x - 2), static_cast<unsigned>(plan.tiles_y - 2));
        return picture_.copy_to(target);
    }
    [[nodiscard]] std::string name() const override {
        return "GL (" + context_->kind_name() + ", " + context_->renderer() + ")";
    }

private:
    void upload(const SamplePlan& plan, const Samples& samples) {
        tile_scratch_.resize(plan.level.size());
        for (std::size_t i = 0; i < plan.level.size(); ++i)
            tile_scratch_[i] = {plan.offset[i], kLevelCounts[plan.level[i]] * 256U + plan.level[i]};
        tiles_.write(tile_scratch_);
        const std::size_t addresses = plan.address_count();
        colors_.write(std::span(samples.color).first(addresses));
        inverse_depths_.write(std::span(samples.inverse_depth_per_m).first(addresses));
        view_.write(reconstruct_view(plan));
        hidden_.update(plan);
        picture_.resize(plan.width_px, plan.height_px);
    }
    void bind() const {
        interpolations_.bind(0);
        palettes_.bind(1);
        tiles_.bind(2);
        colors_.bind(3);
        inverse_depths_.bind(4);
        hidden_.bind(5);
        picture_.bind(6, 7);
        view_.bind(8);
    }

    // Members below the context belong to it and go first.
    std::unique_ptr<GlContext> context_;
    ComputeProgram program_;
    StorageBuffer<glm::uvec2> interpolations_{*context_};
    StorageBuffer<std::uint32_t> palettes_{*context_};
    StorageBuffer<glm::uvec2> tiles_{*context_};
    StorageBuffer<Rgba8> colors_{*context_};
    StorageBuffer<float> inverse_depths_{*context_};
    StorageBuffer<ReconstructView> view_{*context_};
    GlHiddenPixels hidden_{*context_};
    GlPicture picture_{*context_};
    std::vector<glm::uvec2> tile_scratch_;
};

}  // namespace

Expected<std::unique_ptr<Reconstructor>> make_gl_reconstructor(std::unique_ptr<GlContext> context,
                                                               const TileTables& tables) {
    GlContext& used = *context;
    const auto current = CurrentContext::enter(used);
    if (!current) return tl::unexpected(current.error());
    auto program = ComputeProgram::build(used, std::array{reconstruct_buffers_text, picture_buffers_text, blend_text,
                                                          reconstruct_text, reconstruct_main_text});
    if (!program) return tl::unexpected(program.error());
    return std::make_unique<GlReconstructor>(std::move(context), std::move(*program), tables);
}

}  // namespace macula
