#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "masks/sample_plan.h"
#include "protocol/base/error.h"
#include "protocol/base/image.h"
#include "server/render/tracer.h"

namespace macula {

class TileTables;
class GlContext;

/// Where one eye's picture goes; rows may be longer than the eye is wide (both eyes side by side).
struct ReconstructTarget {
    Rgba8* color = nullptr;
    std::size_t color_stride_px = 0;
    float* inverse_depth_per_m = nullptr;
    std::size_t depth_stride_px = 0;
};

/// Turns the samples of one eye into a full picture: colour (in the display's coding) and inverse depth, each
/// interpolated between samples. Hidden pixels, and those that no sample can reach, become black at depth 0.
class Reconstructor {
public:
    Reconstructor() = default;
    Reconstructor(const Reconstructor&) = delete;
    Reconstructor& operator=(const Reconstructor&) = delete;
    virtual ~Reconstructor() = default;
    /// Errors: `graphics` if the GL context is lost. One thread at a time.
    virtual Expected<void> reconstruct(const SamplePlan& plan, const Samples& samples,
                                       const ReconstructTarget& target) = 0;
    /// For logs: "C++" or "GL (llvmpipe ...)".
    [[nodiscard]] virtual std::string name() const = 0;
};

/// The kernel compiled as C++, pixel by pixel on the calling thread: the oracle of the others.
std::unique_ptr<Reconstructor> make_reference_reconstructor(std::shared_ptr<const TileTables> tables);

/// The same rule in vector loops over tiles, on the shared thread pool: equal to the reference to the bit, and the
/// fast path where GL is software.
std::unique_ptr<Reconstructor> make_cpu_reconstructor(std::shared_ptr<const TileTables> tables);

/// The same kernel as a GL compute program. The context is current on the calling thread during calls only.
/// Errors: `graphics`.
Expected<std::unique_ptr<Reconstructor>> make_gl_reconstructor(std::unique_ptr<GlContext> context,
                                                               const TileTables& tables);

}  // namespace macula
