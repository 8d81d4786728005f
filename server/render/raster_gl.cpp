#include <array>
#include <string>
#include <utility>
#include <vector>

#include "kernel_text/raster_fragment.h"
#include "kernel_text/raster_vertex.h"
#include "protocol/gl/buffer.h"
#include "protocol/gl/context.h"
#include "protocol/gl/render_program.h"
#include "protocol/gl/render_target.h"
#include "server/render/gl_sample_image.h"
#include "server/render/mesh_recent.h"
#include "server/render/mesh_reconstructors.h"
#include "server/render/raster_hidden.h"
#include "server/render/raster_mesh.h"
#include "server/render/reconstruction.h"

namespace macula {

namespace {

/// A mesh, and its copy in GL memory.
struct UploadedMesh {
    RasterMesh mesh;
    StorageBuffer<RasterVertex> vertices;
    StorageBuffer<std::uint32_t> indices;

    UploadedMesh(GlContext& context, const SampleMesh& of) : mesh(of), vertices(context), indices(context) {
        vertices.write(mesh.vertices());
        indices.write(mesh.indices());
    }
};

class GlRasterReconstructor final : public Reconstructor {
public:
    GlRasterReconstructor(std::unique_ptr<GlContext> context, RenderProgram program, GlSampleImage image)
        : context_(std::move(context)), program_(std::move(program)), image_(std::move(image)) {}

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::raster, plan); !fits) return fits;
        const auto current = CurrentContext::enter(*context_);
        if (!current) return tl::unexpected(current.error());
        const glm::ivec2 size_px(plan.width_px, plan.height_px);
        if (auto resized = picture_.resize(size_px); !resized) return resized;
        // Cleared: a corner whose weight is 0 in all pixels may be untraced, and 0 times what memory holds may be NaN.
        image_.fill(plan, samples, true);
        const UploadedMesh& uploaded =
            meshes_.get(plan.mesh, [&] { return UploadedMesh(*context_, plan.mesh->mesh()); });
        uploaded.mesh.find_ranges(plan.mesh_origin_px, size_px, ranges_);
        // The viewport has the guard band too, so that no triangle of the window is clipped.
        const View view{{image_.width_px(), image_.height_px()}, plan.mesh_origin_px - image_.guard_px()};
        view_.write(view);
        uploaded.vertices.bind(0);
        image_.bind(1, 2);
        view_.bind(3);
        picture_.begin(glm::ivec2(-image_.guard_px()), view.image_px);
        program_.draw(uploaded.indices, ranges_);
        auto copied =
            picture_.copy_to(target.color, target.color_stride_px, target.inverse_depth_per_m, target.depth_stride_px);
        if (!copied) return copied;
        blacken_hidden(plan, target);
        return {};
    }
    [[nodiscard]] std::string name() const override {
        return "GL (" + context_->kind_name() + ", " + context_->renderer() + ")";
    }

private:
    /// RasterView of raster_vertex.glsl.
    struct View {
        glm::ivec2 image_px;
        glm::ivec2 mask_corner;
    };

    // Members below the context belong to it and go first.
    std::unique_ptr<GlContext> context_;
    RenderProgram program_;
    GlSampleImage image_;
    RecentMeshes<UploadedMesh> meshes_;
    StorageBuffer<View> view_{*context_};
    RenderTarget picture_{*context_};
    std::vector<IndexRange> ranges_;
};

}  // namespace

Expected<std::unique_ptr<Reconstructor>> make_gl_raster_reconstructor(std::unique_ptr<GlContext> context) {
    GlContext& used = *context;
    const auto current = CurrentContext::enter(used);
    if (!current) return tl::unexpected(current.error());
    auto program = RenderProgram::build(used, std::array{raster_vertex_text}, std::array{raster_fragment_text});
    if (!program) return tl::unexpected(program.error());
    auto image = GlSampleImage::make(used);
    if (!image) return tl::unexpected(image.error());
    return std::make_unique<GlRasterReconstructor>(std::move(context), std::move(*program), std::move(*image));
}

}  // namespace macula
