#include "protocol/gl/egl_context.h"

namespace macula {

Expected<std::unique_ptr<GlContext>> make_egl_surfaceless_context() {
    if (!has_egl_extension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
        return fail(ErrorCode::graphics, "libEGL lacks EGL_MESA_platform_surfaceless");
    return make_egl_context(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                            "EGL surfaceless");
}

}  // namespace macula
