#pragma once

#include <memory>

#include "protocol/base/error.h"
#include "server/render/reconstructor.h"

namespace macula {

class GlContext;

// Reconstruction of mesh plans, whose window lies in the mask. A plan without a mesh is refused (`option`). Hidden
// pixels are black at depth 0. Where every pixel is a site, all show the samples to the bit, but for the inverse depths
// of GL's raster (below).

/// Each pixel gathers the three samples that MeshTable names, with its weights: the kernel (server/kernels/table.h),
/// pixel by pixel. The oracle of the two below.
std::unique_ptr<Reconstructor> make_reference_table_reconstructor();
/// The same in vector loops on the shared thread pool: equal to the bit.
std::unique_ptr<Reconstructor> make_cpu_table_reconstructor();
/// The same as a GL compute program: equal to the bit. Errors: `graphics`, also where the table is larger than what GL
/// lets a program read.
Expected<std::unique_ptr<Reconstructor>> make_gl_table_reconstructor(std::unique_ptr<GlContext> context);

/// The mesh's triangles drawn by the GL pipeline with the colours and inverse depths of their corners interpolated, as
/// the published system does. Inverse depth is interpolated between surfaces too: the published system knows no rule
/// against it. A mesh is sorted and uploaded when it comes for the first time, which takes part of a second.
///
/// GL rounds a triangle's slopes and continues them from the picture's corner. On llvmpipe, at 1512x1680, inverse
/// depths come out wrong by up to .0006 of the largest around, where colours still are right to the bit at sites.
/// Errors: `graphics`.
Expected<std::unique_ptr<Reconstructor>> make_gl_raster_reconstructor(std::unique_ptr<GlContext> context);
/// The same triangles by edge functions in C++: the oracle of the one above, which it equals to one code value.
std::unique_ptr<Reconstructor> make_cpu_raster_reconstructor();

}  // namespace macula
