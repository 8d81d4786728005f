#include "server/render/scattered_reconstructors.h"

#include <optional>
#include <utility>

#include "protocol/gl/context.h"
#include "server/render/gl_picture.h"
#include "server/render/gl_sample_image.h"
#include "server/render/nearest_gl.h"
#include "server/render/nearest_search.h"
#include "server/render/push_pull_gl.h"
#include "server/render/push_pull_pyramid.h"
#include "server/render/sample_image.h"

namespace macula {

namespace {

constexpr int kNeighbours = 4;  // kernels::kMostNeighbours, where its value is explained

int neighbours(Reconstruction kind) {
    return kind == Reconstruction::cells ? 1 : kNeighbours;
}

class CpuScatteredReconstructor final : public Reconstructor {
public:
    explicit CpuScatteredReconstructor(Reconstruction kind) : kind_(kind), nearest_(neighbours(kind)) {}

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        auto fits = check_fits(kind_, plan);
        if (!fits) return fits;
        image_.fill(plan, samples, true);
        if (kind_ == Reconstruction::push_pull)
            pyramid_.reconstruct(plan, image_, target);
        else
            nearest_.reconstruct(plan, image_, target);
        return {};
    }
    [[nodiscard]] std::string name() const override { return "C++"; }

private:
    Reconstruction kind_;
    SampleImage image_;
    PushPullPyramid pyramid_;
    NearestSearch nearest_;
};

/// `Programs` is GlPushPull or GlNearestSearch.
template <class Programs>
class GlScatteredReconstructor final : public Reconstructor {
public:
    /// The context is current.
    GlScatteredReconstructor(Reconstruction kind, std::unique_ptr<GlContext> context, GlSampleImage image,
                             Programs programs)
        : kind_(kind), context_(std::move(context)), image_(std::move(image)), programs_(std::move(programs)) {}

    Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                               const ReconstructTarget& target) override {
        auto fits = check_fits(kind_, plan);
        if (!fits) return fits;
        const auto current = CurrentContext::enter(*context_);
        if (!current) return tl::unexpected(current.error());
        image_.fill(plan, samples, true);
        image_.bind(0, 1);
        hidden_.update(plan);
        hidden_.bind(5);
        picture_.resize(plan.width_px, plan.height_px);
        picture_.bind(6, 7);
        auto dispatched = programs_.dispatch(plan, image_);
        if (!dispatched) return dispatched;
        return picture_.copy_to(target);
    }
    [[nodiscard]] std::string name() const override {
        return "GL (" + context_->kind_name() + ", " + context_->renderer() + ")";
    }

private:
    Reconstruction kind_;
    // Members below the context belong to it and go first.
    std::unique_ptr<GlContext> context_;
    GlSampleImage image_;
    Programs programs_;
    GlHiddenPixels hidden_{*context_};
    GlPicture picture_{*context_};
};

}  // namespace

std::unique_ptr<Reconstructor> make_cpu_scattered_reconstructor(Reconstruction kind) {
    return std::make_unique<CpuScatteredReconstructor>(kind);
}

Expected<std::unique_ptr<Reconstructor>> make_gl_scattered_reconstructor(Reconstruction kind,
                                                                         std::unique_ptr<GlContext> context) {
    GlContext& used = *context;
    const auto current = CurrentContext::enter(used);
    if (!current) return tl::unexpected(current.error());
    auto image = GlSampleImage::make(used);
    if (!image) return tl::unexpected(image.error());
    const auto finish = [&]<class Programs>(Expected<Programs> programs) -> Expected<std::unique_ptr<Reconstructor>> {
        if (!programs) return tl::unexpected(programs.error());
        return std::make_unique<GlScatteredReconstructor<Programs>>(kind, std::move(context), std::move(*image),
                                                                    std::move(*programs));
    };
    if (kind == Reconstruction::push_pull) return finish(GlPushPull::make(used));
    return finish(GlNearestSearch::make(used, neighbours(kind)));
}

}  // namespace macula
