#include <array>
#include <span>
#include <utility>
#include <vector>

#include "kernel_text/blend.h"
#include "kernel_text/grid.h"
#include "kernel_text/grid_buffers.h"
#include "kernel_text/grid_main.h"
#include "kernel_text/picture_buffers.h"
#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "protocol/gl/context.h"
#include "server/render/gl_picture.h"
#include "server/render/grid_reconstructors.h"
#include "server/render/grid_source.h"
#include "server/render/reconstruction.h"

namespace macula {

namespace {

constexpr int kGroupEdge = 16;

class GlGridReconstructor final : public Reconstructor {
public:
    GlGridReconstructor(std::unique_ptr<GlContext> context, ComputeProgram program)
        : context_(std::move(context)), program_(std::move(program)) {}

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::bilinear, plan); !fits) return fits;
        const auto current = CurrentContext::enter(*context_);
        if (!current) return tl::unexpected(current.error());
        upload(plan, samples);
        columns_.bind(0);
        rows_.bind(1);
        colors_.bind(2);
        inverse_depths_.bind(3);
        view_.bind(4);
        hidden_.bind(5);
        picture_.bind(6, 7);
        program_.dispatch(static_cast<unsigned>((plan.width_px + kGroupEdge - 1) / kGroupEdge),
                          static_cast<unsigned>((plan.height_px + kGroupEdge - 1) / kGroupEdge));
        return picture_.copy_to(target);
    }
    [[nodiscard]] std::string name() const override {
        return "GL (" + context_->kind_name() + ", " + context_->renderer() + ")";
    }

private:
    void upload(const SamplePlan& plan, const Samples& samples) {
        // A log-polar plan has none; the program does not read them, but a buffer must be there.
        column_places_.assign(plan.grids.rectangular.empty() ? 1 : 0, 0);
        row_places_ = column_places_;
        for (const RectangularGrid& grid : plan.grids.rectangular) {
            column_places_.insert(column_places_.end(), grid.columns.begin(), grid.columns.end());
            row_places_.insert(row_places_.end(), grid.rows.begin(), grid.rows.end());
        }
        columns_.write(column_places_);
        rows_.write(row_places_);
        const std::size_t addresses = plan.address_count();
        colors_.write(std::span(samples.color).first(addresses));
        inverse_depths_.write(std::span(samples.inverse_depth_per_m).first(addresses));
        view_.write(grid_view(plan));
        hidden_.update(plan);
        picture_.resize(plan.width_px, plan.height_px);
    }

    // Members below the context belong to it and go first.
    std::unique_ptr<GlContext> context_;
    ComputeProgram program_;
    StorageBuffer<std::uint32_t> columns_{*context_};
    StorageBuffer<std::uint32_t> rows_{*context_};
    StorageBuffer<Rgba8> colors_{*context_};
    StorageBuffer<float> inverse_depths_{*context_};
    StorageBuffer<kernels::GridView> view_{*context_};
    GlHiddenPixels hidden_{*context_};
    GlPicture picture_{*context_};
    std::vector<std::uint32_t> column_places_;
    std::vector<std::uint32_t> row_places_;
};

}  // namespace

Expected<std::unique_ptr<Reconstructor>> make_gl_grid_reconstructor(std::unique_ptr<GlContext> context) {
    GlContext& used = *context;
    const auto current = CurrentContext::enter(used);
    if (!current) return tl::unexpected(current.error());
    auto program = ComputeProgram::build(
        used, std::array{grid_buffers_text, picture_buffers_text, blend_text, grid_text, grid_main_text});
    if (!program) return tl::unexpected(program.error());
    return std::make_unique<GlGridReconstructor>(std::move(context), std::move(*program));
}

}  // namespace macula
