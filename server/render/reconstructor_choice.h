#pragma once

#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "protocol/base/error.h"
#include "protocol/gl/context.h"

namespace macula {

class TileTables;

/// Where pictures are reconstructed; `automatic` is GL on a GPU, and the faster of the two where GL is software.
enum class ReconstructOn { automatic, gl, cpu };

/// Parses `--reconstruct-on auto|gl|cpu`. Errors: `option`.
Expected<ReconstructOn> parse_reconstruct_on(const std::string& text);

/// Where a server reconstructs, and why.
struct ReconstructorChoice {
    bool use_gl = false;
    ContextKind context = ContextKind::automatic;  ///< kind that works, where `use_gl`
    double gl_ms = 0.0;                            ///< fastest reconstruction of one eye; 0: not measured
    double cpu_ms = 0.0;
    std::string reason;  ///< for the log: what was asked for, found and measured
};

/// Decides, and where GL is software and the choice is automatic, measures both on a made-up plan of an eye of
/// `size_px`: about ten reconstructions.
/// Errors: `graphics` if GL or a certain kind of context was asked for and does not work.
Expected<ReconstructorChoice> choose_reconstructor(ContextKind context, ReconstructOn on,
                                                   const std::shared_ptr<const TileTables>& tables, glm::ivec2 size_px);

}  // namespace macula
