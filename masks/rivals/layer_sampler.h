#pragma once

#include <glm/vec2.hpp>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/rivals/layer_choice.h"
#include "masks/rivals/rectangular_plan.h"
#include "masks/sample_plan.h"

namespace macula {

/// Three eccentricity layers (Guenter, Finch, Drucker, Tan and Snyder, Foveated 3D Graphics, 2012): a sample a pixel
/// around the gaze, fewer in a square around that, fewest in the rest of the window; the layers come in over one
/// another smoothly.
///
/// What is as published: three layers, squares in angle, at densities and radii that follow from a linear law of acuity
/// by the least number of samples (layer_choice.h). The slope m of the law is solved for the share.
///
/// What had to be chosen: the samples of a layer lie on a lattice that is fixed to the window, and the layer's square
/// moves over it with the gaze. If the lattice moved too, every edge in the periphery would crawl with the eye, which
/// is no part of the method. The method's known weakness remains, twinkling: few samples, and edges of layers that pass
/// over the picture. Against it the paper jitters the samples from frame to frame and reprojects. So the lattices move
/// with the request's phase within their cells, but for that of the inner layer, whose samples are the centres of
/// pixels; reprojection is the client's.
///
/// What is not done: samples under a finer layer, which the paper renders, are not traced.
class LayerSampler final : public Sampler {
public:
    /// `share` of the buffer's pixels, hidden ones included, while the gaze is on the axis; 1: a sample at every
    /// pixel's centre. Of `law` all but the slope counts. Shares out of reach of slopes up to 10 give the least.
    LayerSampler(const Display& display, Eye eye, double share, const LinearMar& law = {});

    void plan(const PlanRequest& request, SamplePlan& plan) override;

    /// The law, with its slope as solved; what it comes to. At a share of 1 both are without meaning.
    [[nodiscard]] const LinearMar& law() const { return law_; }
    [[nodiscard]] const LayerChoice& layers() const { return layers_; }

private:
    void place_layers(const PlanRequest& request, std::vector<RectangularGrid>& grids) const;
    [[nodiscard]] double share_at_axis(std::vector<RectangularGrid>& grids);

    Display display_;
    Eye eye_;
    glm::ivec2 window_px_;
    RectangularPlanner planner_;
    bool full_;
    LinearMar law_;
    LayerChoice layers_;
};

}  // namespace macula
