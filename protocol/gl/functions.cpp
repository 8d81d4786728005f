#include "protocol/gl/functions.h"

#include <string>

namespace macula {

Expected<GlFunctions> load_gl_functions(GlProcedure (*find)(const char* name)) {
    GlFunctions gl;
#define MACULA_GL_LOAD(prototype, name)                      \
    gl.name = reinterpret_cast<prototype>(find("gl" #name)); \
    if (gl.name == nullptr) return fail(ErrorCode::graphics, "the driver has no function gl" #name);
    MACULA_GL_FUNCTIONS(MACULA_GL_LOAD)
#undef MACULA_GL_LOAD
    return gl;
}

Expected<void> check_gl_errors(const GlFunctions& gl) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return {};
    if (error == GL_OUT_OF_MEMORY) return fail(ErrorCode::graphics, "GL is out of memory");
    return fail(ErrorCode::graphics, "GL failed with error " + std::to_string(error));
}

}  // namespace macula
