#pragma once

#include <memory>

#include "client/present/compositor.h"
#include "client/present/taa_kernel.h"

namespace macula {

/// The kernels compiled as C++, run over rows on the thread pool: the oracle of the other, and the fast one where GL
/// is software.
std::unique_ptr<Compositor> make_cpu_compositor(const Display& display, const kernels::TaaWeights& weights);

/// The same kernels as GL compute programs. The context must outlive the compositor and is made current on the
/// calling thread during calls. Errors: `graphics`.
Expected<std::unique_ptr<Compositor>> make_gl_compositor(GlContext& context, const Display& display,
                                                         const kernels::TaaWeights& weights);

}  // namespace macula
