#pragma once

#include <memory>
#include <string>

#include "protocol/base/error.h"

namespace macula {

/// Which kind of windowless context to make. `automatic` tries EGL on a GPU device, then EGL surfaceless, then
/// OSMesa.
enum class ContextKind { automatic, egl, surfaceless, osmesa };

/// Parses `--context auto|egl|surfaceless|osmesa`. Errors: `option`.
Expected<ContextKind> parse_context_kind(const std::string& text);

/// Table of the GL functions that Macula calls (protocol/gl/functions.h).
struct GlFunctions;

/// A GL 4.5 core context (4.3 at least) without a window. Bound to no thread until made current.
class GlContext {
public:
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    virtual ~GlContext() = default;
    /// Makes the context current on the calling thread; another thread must have released it.
    virtual Expected<void> make_current() = 0;
    virtual void release() noexcept = 0;
    [[nodiscard]] virtual const GlFunctions& gl() const = 0;
    /// "EGL surfaceless", ...
    [[nodiscard]] virtual std::string kind_name() const = 0;
    /// GL_RENDERER, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
    [[nodiscard]] virtual std::string renderer() const = 0;
    /// Whether GL runs on the CPU (llvmpipe, softpipe, swrast).
    [[nodiscard]] virtual bool software() const = 0;
};

/// Errors: `graphics`, naming every kind tried and why it failed.
Expected<std::unique_ptr<GlContext>> make_gl_context(ContextKind kind);

}  // namespace macula
