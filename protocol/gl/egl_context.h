#pragma once

// A context on an EGL display, without a surface. Internal to protocol/gl: the files of the EGL kinds include it.

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <memory>
#include <string>
#include <string_view>

#include "protocol/gl/context_kinds.h"

namespace macula {

/// Whether a space-separated extension string, which may be null, holds `name` as a whole word.
bool has_egl_extension(const char* extensions, std::string_view name);

/// Initialises the display and makes a context on it. The display is never terminated: EGL hands the same one to
/// everybody who asks for the device, so ending it would end other contexts of the process.
/// Errors: `graphics`.
Expected<std::unique_ptr<GlContext>> make_egl_context(EGLDisplay display, const std::string& kind_name);

}  // namespace macula
