#pragma once

#include <memory>

#include "protocol/base/error.h"
#include "server/render/reconstructor.h"

namespace macula {

class GlContext;

// Bilinear reconstruction of grid plans (GridLayout): uniform, layers, log-polar. Others are refused (`option`).
// Hidden pixels are black at depth 0.

/// The kernel (server/kernels/grid.h) as C++, on the shared thread pool.
std::unique_ptr<Reconstructor> make_cpu_grid_reconstructor();
/// The same kernel as a GL compute program. Errors: `graphics`.
Expected<std::unique_ptr<Reconstructor>> make_gl_grid_reconstructor(std::unique_ptr<GlContext> context);

}  // namespace macula
