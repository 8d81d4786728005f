#pragma once

#include <memory>
#include <string>

#include "server/render/reconstruction.h"
#include "server/render/reconstructor.h"

namespace macula {

/// The server's options for reconstruction, as typed.
struct ReconstructorOptions {
    std::string context = "auto";         ///< auto, egl, surfaceless or osmesa
    std::string reconstruct_on = "auto";  ///< auto, gl or cpu
    int eye_width_px = 1512;              ///< size of eye that software GL and C++ are compared at
    int eye_height_px = 1680;
};

/// Makes a reconstructor for each session. Each has its own GL context, so that sessions on several threads never
/// wait for each other. make() may be called from several threads at once.
class ReconstructorFactory {
public:
    ReconstructorFactory() = default;
    ReconstructorFactory(const ReconstructorFactory&) = delete;
    ReconstructorFactory& operator=(const ReconstructorFactory&) = delete;
    virtual ~ReconstructorFactory() = default;
    /// Errors: `graphics`.
    [[nodiscard]] virtual Expected<std::unique_ptr<Reconstructor>> make(
        Reconstruction kind = Reconstruction::tiles) const = 0;
    /// For the log and Welcome: "C++", or "GL (EGL surfaceless, llvmpipe ...)".
    [[nodiscard]] virtual const std::string& name() const = 0;
    /// For the log: why, with what was measured.
    [[nodiscard]] virtual const std::string& reason() const = 0;
};

/// Chooses where sessions will reconstruct: tries the context, and where GL is software and the choice automatic,
/// takes the time of both ways on tiles, which lasts a fraction of a second; what is found holds for all kinds.
/// Errors: `option`; `graphics` if GL or a certain kind of context was asked for and does not work.
Expected<std::unique_ptr<ReconstructorFactory>> make_reconstructor_factory(const ReconstructorOptions& options,
                                                                           std::shared_ptr<const TileTables> tables);

}  // namespace macula
