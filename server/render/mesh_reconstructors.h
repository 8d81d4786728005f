#pragma once

#include <memory>

#include "protocol/base/error.h"
#include "server/render/reconstructor.h"

namespace macula {

class GlContext;

// Reconstruction of mesh plans. A plan without a mesh is refused (`option`). Hidden pixels are black at depth 0.

/// Each pixel gathers the three samples that MeshTable names, with its weights: the kernel (server/kernels/table.h),
/// pixel by pixel. The oracle of the two below.
std::unique_ptr<Reconstructor> make_reference_table_reconstructor();
/// The same in vector loops on the shared thread pool: equal to the bit.
std::unique_ptr<Reconstructor> make_cpu_table_reconstructor();
/// The same as a GL compute program: equal to the bit. Errors: `graphics`.
Expected<std::unique_ptr<Reconstructor>> make_gl_table_reconstructor(std::unique_ptr<GlContext> context);

/// The mesh's triangles drawn by the GL pipeline with the colours and inverse depths of their corners interpolated, as
/// the published system does. Errors: `graphics`.
Expected<std::unique_ptr<Reconstructor>> make_gl_raster_reconstructor(std::unique_ptr<GlContext> context);
/// The same triangles by edge functions in C++: the oracle of the one above, which it equals to one code value.
std::unique_ptr<Reconstructor> make_cpu_raster_reconstructor();

}  // namespace macula
