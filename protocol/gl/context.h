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

/// A GL 4.5 core context (4.3 at least) without a window. Bound to no thread until made current; it may move
/// from thread to thread, and any number of contexts of any kinds may live in one process, but at most one is
/// current on a thread at a time. Calls go through CurrentContext.
class GlContext {
public:
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    /// The context must not be current on another thread.
    virtual ~GlContext() = default;
    /// Makes the context current on the calling thread; whichever thread had it must have released it, and the
    /// calling thread must have released any other context. Errors: `graphics`.
    virtual Expected<void> make_current() = 0;
    /// Leaves the calling thread without a current context.
    virtual void release() noexcept = 0;
    [[nodiscard]] virtual bool current_on_this_thread() const noexcept = 0;
    /// To be called while the context is current.
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

/// Keeps a context current on this thread for a scope. Scopes of the same context nest.
class CurrentContext {
public:
    /// Errors: `graphics`.
    static Expected<CurrentContext> enter(GlContext& context);
    CurrentContext(CurrentContext&& other) noexcept : context_(other.context_) { other.context_ = nullptr; }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;
    CurrentContext& operator=(CurrentContext&&) = delete;
    ~CurrentContext() {
        if (context_ != nullptr) context_->release();
    }

private:
    explicit CurrentContext(GlContext* to_release) : context_(to_release) {}
    GlContext* context_;
};

}  // namespace macula
