#include "protocol/gl/context.h"

#include <array>
#include <string_view>
#include <utility>

#include "protocol/gl/context_kinds.h"

namespace macula {

namespace {

bool is_software(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> kRasterisers = {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"};
    for (const std::string_view name : kRasterisers)
        if (renderer.find(name) != std::string_view::npos) return true;
    return false;
}

}  // namespace

Expected<ContextKind> parse_context_kind(const std::string& text) {
    if (text == "auto") return ContextKind::automatic;
    if (text == "egl") return ContextKind::egl;
    if (text == "surfaceless") return ContextKind::surfaceless;
    if (text == "osmesa") return ContextKind::osmesa;
    return fail(ErrorCode::option, "unknown GL context \"" + text + "\"; use auto, egl, surfaceless or osmesa");
}

Expected<std::unique_ptr<GlContext>> make_gl_context(ContextKind kind) {
    struct Attempt {
        ContextKind kind;
        const char* name;
        Expected<std::unique_ptr<GlContext>> (*make)();
    };
    const std::array<Attempt, 3> attempts = {{
        {ContextKind::egl, "EGL device", [] { return make_egl_device_context(); }},
        {ContextKind::surfaceless, "EGL surfaceless", [] { return make_egl_surfaceless_context(); }},
        {ContextKind::osmesa, "OSMesa", [] { return make_osmesa_context(); }},
    }};
    std::string reasons;
    for (const Attempt& attempt : attempts) {
        if (kind != ContextKind::automatic && kind != attempt.kind) continue;
        auto context = attempt.make();
        if (context) return context;
        reasons += std::string(reasons.empty() ? "" : "; ") + attempt.name + ": " + context.error().message;
    }
    return fail(ErrorCode::graphics,
                "no usable GL context (" + reasons + ")" +
                    (kind == ContextKind::automatic ? "; install a GL 4.3 driver, for example libgl1-mesa-dri"
                                                    : "; choose another kind with --context, or auto"));
}

Expected<CurrentContext> CurrentContext::enter(GlContext& context) {
    if (context.current_on_this_thread()) return CurrentContext(nullptr);
    if (auto made = context.make_current(); !made) return tl::unexpected(made.error());
    return CurrentContext(&context);
}

Expected<GlIdentity> identify_current_context(GlProcedure (*find)(const char* name)) {
    const auto gl = load_gl_functions(find);
    if (!gl) return tl::unexpected(gl.error());
    GlIdentity identity{.gl = *gl, .renderer = "unknown renderer", .software = false};
    if (const GLubyte* text = gl->GetString(GL_RENDERER)) identity.renderer = reinterpret_cast<const char*>(text);
    identity.software = is_software(identity.renderer);
    GLint major = 0;
    GLint minor = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 43)
        return fail(ErrorCode::graphics, identity.renderer + " has only GL " + std::to_string(major) + "." +
                                             std::to_string(minor) + ", 4.3 is needed for compute programs");
    return identity;
}

}  // namespace macula
