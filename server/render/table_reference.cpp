#include <cstddef>

#include "server/render/mesh_reconstructors.h"
#include "server/render/reconstruction.h"
#include "server/render/sample_image.h"
#include "server/render/table_source.h"

namespace macula {

namespace {

class ReferenceTableReconstructor final : public Reconstructor {
public:
    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        if (auto fits = check_fits(Reconstruction::table, plan); !fits) return fits;
        image_.fill(plan, samples, false);
        const kernels::TableSource source{*plan.mesh, image_};
        const kernels::TableView view = table_view(plan);
        std::size_t index = 0;
        for (int y = 0; y < plan.height_px; ++y) {
            Rgba8* const color = target.color + static_cast<std::size_t>(y) * target.color_stride_px;
            float* const depth = target.inverse_depth_per_m + static_cast<std::size_t>(y) * target.depth_stride_px;
            for (int x = 0; x < plan.width_px; ++x, ++index) {
                color[x] = kernels::kOpaqueBlack;
                depth[x] = 0.0F;
                if (!plan.hidden || (*plan.hidden)[index] == 0)
                    kernels::table_pixel(source, view, {x, y}, color[x], depth[x]);
            }
        }
        return {};
    }
    [[nodiscard]] std::string name() const override { return "reference"; }

private:
    SampleImage image_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_reference_table_reconstructor() {
    return std::make_unique<ReferenceTableReconstructor>();
}

}  // namespace macula
