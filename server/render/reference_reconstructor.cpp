#include <algorithm>

#include "server/render/reconstruct_source.h"
#include "server/render/reconstructor.h"

namespace macula {

namespace {

class ReferenceReconstructor final : public Reconstructor {
public:
    explicit ReferenceReconstructor(std::shared_ptr<const TileTables> tables) : tables_(std::move(tables)) {}

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        const kernels::ReconstructSource source{plan, samples, *tables_};
        const kernels::ReconstructView view = reconstruct_view(plan);
        for (int y = 0; y < plan.height_px; ++y) {
            Rgba8* const color = target.color + static_cast<std::size_t>(y) * target.color_stride_px;
            float* const depth = target.inverse_depth_per_m + static_cast<std::size_t>(y) * target.depth_stride_px;
            const std::uint8_t* const hidden =
                plan.hidden == nullptr
                    ? nullptr
                    : plan.hidden->data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(plan.width_px);
            for (int x = 0; x < plan.width_px; ++x) {
                if (hidden != nullptr && hidden[x] != 0) {
                    color[x] = kernels::kOpaqueBlack;
                    depth[x] = 0.0F;
                    continue;
                }
                const glm::ivec2 from_origin = glm::ivec2(x, y) - view.origin_px;
                kernels::reconstruct_pixel(source, view, from_origin / kTileEdge_px, from_origin % kTileEdge_px,
                                           color[x], depth[x]);
            }
        }
        return {};
    }
    [[nodiscard]] std::string name() const override { return "reference"; }

private:
    std::shared_ptr<const TileTables> tables_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_reference_reconstructor(std::shared_ptr<const TileTables> tables) {
    return std::make_unique<ReferenceReconstructor>(std::move(tables));
}

}  // namespace macula
