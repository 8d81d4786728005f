#include "protocol/gl/egl_context.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace macula {

namespace {

std::string egl_error(const char* call) {
    std::array<char, 16> code{};
    std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
    return std::string(call) + " failed with " + code.data();
}

class EglContext final : public GlContext {
public:
    EglContext(EGLDisplay display, EGLContext context, std::string kind_name)
        : display_(display), context_(context), kind_name_(std::move(kind_name)) {}
    ~EglContext() override {
        if (current_on_this_thread()) release();
        eglDestroyContext(display_, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    Expected<void> make_current() override {
        // The bound API is a property of the thread, and decides which context eglMakeCurrent replaces.
        eglBindAPI(EGL_OPENGL_API);
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            return fail(ErrorCode::graphics, egl_error("eglMakeCurrent"));
        return {};
    }
    void release() noexcept override {
        eglBindAPI(EGL_OPENGL_API);
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    [[nodiscard]] bool current_on_this_thread() const noexcept override {
        eglBindAPI(EGL_OPENGL_API);
        return eglGetCurrentContext() == context_;
    }
    [[nodiscard]] const GlFunctions& gl() const override { return identity_.gl; }
    [[nodiscard]] std::string kind_name() const override { return kind_name_; }
    [[nodiscard]] std::string renderer() const override { return identity_.renderer; }
    [[nodiscard]] bool software() const override { return identity_.software; }

    Expected<void> identify() {
        const auto current = CurrentContext::enter(*this);
        if (!current) return tl::unexpected(current.error());
        auto identity = identify_current_context(eglGetProcAddress);
        if (!identity) return tl::unexpected(identity.error());
        identity_ = std::move(*identity);
        return {};
    }

private:
    EGLDisplay display_;
    EGLContext context_;
    std::string kind_name_;
    GlIdentity identity_;
};

EGLContext create_core_context(EGLDisplay display) {
    for (const EGLint minor : {5, 3}) {
        const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                  4,
                                                  EGL_CONTEXT_MINOR_VERSION,
                                                  minor,
                                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                  EGL_NONE};
        const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context != EGL_NO_CONTEXT) return context;
    }
    return EGL_NO_CONTEXT;
}

}  // namespace

bool has_egl_extension(const char* extensions, std::string_view name) {
    std::string_view rest = extensions == nullptr ? "" : extensions;
    while (!rest.empty()) {
        const std::string_view word = rest.substr(0, rest.find(' '));
        if (word == name) return true;
        rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    }
    return false;
}

Expected<std::unique_ptr<GlContext>> make_egl_context(EGLDisplay display, const std::string& kind_name) {
    if (display == EGL_NO_DISPLAY) return fail(ErrorCode::graphics, egl_error("eglGetPlatformDisplay"));
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
        return fail(ErrorCode::graphics, egl_error("eglInitialize"));
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_create_context", "EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"})
        if (!has_egl_extension(extensions, needed))
            return fail(ErrorCode::graphics, std::string("the display lacks ") + needed);
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return fail(ErrorCode::graphics, "the display has no desktop GL");
    const EGLContext handle = create_core_context(display);
    if (handle == EGL_NO_CONTEXT) return fail(ErrorCode::graphics, "no GL 4.3 core: " + egl_error("eglCreateContext"));
    auto context = std::make_unique<EglContext>(display, handle, kind_name);
    if (auto identified = context->identify(); !identified) return tl::unexpected(identified.error());
    return context;
}

}  // namespace macula
