#pragma once

// The kinds of contexts behind make_gl_context(), each in its own file. Internal to protocol/gl and its test.

#include <memory>
#include <string>

#include "protocol/gl/context.h"
#include "protocol/gl/functions.h"

namespace macula {

/// Which devices the EGL device platform may use.
enum class DeviceChoice { hardware, software };

/// EGL_EXT_platform_device: the first device of the choice that gives a usable context.
Expected<std::unique_ptr<GlContext>> make_egl_device_context(DeviceChoice choice = DeviceChoice::hardware);
/// EGL_MESA_platform_surfaceless: Mesa's own choice, a GPU or llvmpipe.
Expected<std::unique_ptr<GlContext>> make_egl_surfaceless_context();
/// Mesa's off-screen library: llvmpipe without EGL.
Expected<std::unique_ptr<GlContext>> make_osmesa_context();

/// What every kind knows about its context once it has been current.
struct GlIdentity {
    GlFunctions gl;
    std::string renderer;
    bool software = false;
};

/// Loads the functions of the context that is current on this thread and asks it who it is.
/// Errors: `graphics`: a function is missing, or GL is older than 4.3.
Expected<GlIdentity> identify_current_context(GlProcedure (*find)(const char* name));

}  // namespace macula
