#include <array>
#include <string>
#include <utility>

#include "kernel_text/blend.h"
#include "kernel_text/picture_buffers.h"
#include "kernel_text/table.h"
#include "kernel_text/table_buffers.h"
#include "kernel_text/table_main.h"
#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "protocol/gl/context.h"
#include "protocol/gl/functions.h"
#include "server/render/gl_picture.h"
#include "server/render/gl_sample_image.h"
#include "server/render/mesh_recent.h"
#include "server/render/mesh_reconstructors.h"
#include "server/render/reconstruction.h"
#include "server/render/table_source.h"

namespace macula {

namespace {

using kernels::TableView;

unsigned groups(int pixels) {
    constexpr int kLocalSize = 16;  // table_buffers.glsl
    return static_cast<unsigned>((pixels + kLocalSize - 1) / kLocalSize);
}

class GlTableReconstructor final : public Reconstructor {
public:
    GlTableReconstructor(std::unique_ptr<GlContext> context, ComputeProgram program, GlSampleImage image)
        : context_(std::move(context)), program_(std::move(program)), image_(std::move(image)) {}

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::table, plan); !fits) return fits;
        const auto current = CurrentContext::enter(*context_);
        if (!current) return tl::unexpected(current.error());
        if (auto fits = check_size(plan.mesh->pixels().size_bytes()); !fits) return fits;
        image_.fill(plan, samples, false);
        const StorageBuffer<MeshPixel>& table = tables_.get(plan.mesh, [&] {
            StorageBuffer<MeshPixel> uploaded(*context_);
            uploaded.write(plan.mesh->pixels());
            return uploaded;
        });
        view_.write(table_view(plan));
        hidden_.update(plan);
        picture_.resize(plan.width_px, plan.height_px);
        table.bind(0);
        image_.bind(1, 2);
        view_.bind(3);
        hidden_.bind(5);
        picture_.bind(6, 7);
        program_.dispatch(groups(plan.width_px), groups(plan.height_px));
        return picture_.copy_to(target);
    }
    [[nodiscard]] std::string name() const override {
        return "GL (" + context_->kind_name() + ", " + context_->renderer() + ")";
    }

private:
    [[nodiscard]] Expected<void> check_size(std::size_t table_bytes) const {
        GLint limit_bytes = 0;
        context_->gl().GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit_bytes);
        if (table_bytes <= static_cast<std::size_t>(limit_bytes)) return {};
        return fail(ErrorCode::graphics, "the table of the sampling mesh takes " + std::to_string(table_bytes >> 20U) +
                                             " MiB, but a program of " + context_->renderer() + " reads at most " +
                                             std::to_string(limit_bytes >> 20) +
                                             " MiB; reconstruct in C++, or take a smaller mask");
    }

    // Members below the context belong to it and go first.
    std::unique_ptr<GlContext> context_;
    ComputeProgram program_;
    GlSampleImage image_;
    RecentMeshes<StorageBuffer<MeshPixel>> tables_;
    StorageBuffer<TableView> view_{*context_};
    GlHiddenPixels hidden_{*context_};
    GlPicture picture_{*context_};
};

}  // namespace

Expected<std::unique_ptr<Reconstructor>> make_gl_table_reconstructor(std::unique_ptr<GlContext> context) {
    GlContext& used = *context;
    const auto current = CurrentContext::enter(used);
    if (!current) return tl::unexpected(current.error());
    auto program = ComputeProgram::build(
        used, std::array{table_buffers_text, picture_buffers_text, blend_text, table_text, table_main_text});
    if (!program) return tl::unexpected(program.error());
    auto image = GlSampleImage::make(used);
    if (!image) return tl::unexpected(image.error());
    return std::make_unique<GlTableReconstructor>(std::move(context), std::move(*program), std::move(*image));
}

}  // namespace macula
