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

}  // namespace macula
