#pragma once

#include <memory>

#include "client/present/compositor.h"
#include "client/present/taa_kernel.h"
#include "protocol/gl/context.h"

namespace macula {

/// The kernels compiled as C++, run over rows on the thread pool: the oracle of the other, and the fast one where GL
/// is software.
std::unique_ptr<Compositor> make_cpu_compositor(const Display& display, const kernels::TaaWeights& weights);

/// The same kernels as GL compute programs, on a context of its own that no thread has made current.
/// Errors: `graphics`.
Expected<std::unique_ptr<Compositor>> make_gl_compositor(std::unique_ptr<GlContext> context, const Display& display,
                                                         const kernels::TaaWeights& weights);

}  // namespace macula
