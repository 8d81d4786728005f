#pragma once

#include <memory>

#include "protocol/base/error.h"
#include "server/render/reconstruction.h"
#include "server/render/reconstructor.h"

namespace macula {

class GlContext;

// Reconstructions that take samples as they lie, on any pixels: push_pull, cells and nearest, of tile plans and mesh
// plans. A plan whose samples lie between pixel centres is refused (`option`). A pixel with a sample shows it as it is;
// hidden pixels are black at depth 0.

/// The kernels (server/kernels/push_pull.h, nearest_samples.h) as C++, on the shared thread pool. `kind` is one of the
/// three.
std::unique_ptr<Reconstructor> make_cpu_scattered_reconstructor(Reconstruction kind);
/// The same kernels as GL compute programs. Errors: `graphics`.
Expected<std::unique_ptr<Reconstructor>> make_gl_scattered_reconstructor(Reconstruction kind,
                                                                         std::unique_ptr<GlContext> context);

}  // namespace macula
