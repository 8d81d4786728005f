#pragma once

// Prototypes of the GL functions that Macula calls, and the table that holds them.
//
// Why an own table: one process may hold EGL and OSMesa contexts, and a GL function of one is not that of the
// other. libepoxy resolves each function once per process and asks EGL or GLX which context is current, so it
// finds none under OSMesa; glad's default loader fills one global table. (glad 2 can generate a table per
// context, with a Python generator in the build, for the fifty functions below.)

#include <GL/glcorearb.h>

#include "protocol/base/error.h"

/// X(prototype, name without "gl")
#define MACULA_GL_FUNCTIONS(X)                                   \
    X(PFNGLGETSTRINGPROC, GetString)                             \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                         \
    X(PFNGLGETERRORPROC, GetError)                               \
    X(PFNGLCREATESHADERPROC, CreateShader)                       \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                       \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                     \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                         \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)               \
    X(PFNGLDELETESHADERPROC, DeleteShader)                       \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                     \
    X(PFNGLATTACHSHADERPROC, AttachShader)                       \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                         \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                       \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)             \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                           \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                     \
    X(PFNGLGENBUFFERSPROC, GenBuffers)                           \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                           \
    X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                   \
    X(PFNGLBUFFERDATAPROC, BufferData)                           \
    X(PFNGLBUFFERSUBDATAPROC, BufferSubData)                     \
    X(PFNGLMAPBUFFERRANGEPROC, MapBufferRange)                   \
    X(PFNGLUNMAPBUFFERPROC, UnmapBuffer)                         \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                     \
    X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                 \
    X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                     \
    X(PFNGLFINISHPROC, Finish)                                   \
    X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                 \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                 \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)           \
    X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                 \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                 \
    X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer) \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)   \
    X(PFNGLDRAWBUFFERSPROC, DrawBuffers)                         \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)           \
    X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)               \
    X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)               \
    X(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)         \
    X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)         \
    X(PFNGLDISABLEPROC, Disable)                                 \
    X(PFNGLVIEWPORTPROC, Viewport)                               \
    X(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                     \
    X(PFNGLMULTIDRAWELEMENTSPROC, MultiDrawElements)             \
    X(PFNGLREADBUFFERPROC, ReadBuffer)                           \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                         \
    X(PFNGLREADPIXELSPROC, ReadPixels)

namespace macula {

/// GL functions of one context: `gl.GetString(GL_RENDERER)`. They act on the context that is current on the
/// calling thread.
struct GlFunctions {
#define MACULA_GL_MEMBER(prototype, name) prototype name = nullptr;
    MACULA_GL_FUNCTIONS(MACULA_GL_MEMBER)
#undef MACULA_GL_MEMBER
};

using GlProcedure = void (*)();

/// Fills the table through `find`, which is eglGetProcAddress or OSMesaGetProcAddress.
/// Errors: `graphics`, naming the function that is missing.
Expected<GlFunctions> load_gl_functions(GlProcedure (*find)(const char* name));

/// What the context has kept since it was asked last. Errors: `graphics`.
Expected<void> check_gl_errors(const GlFunctions& gl);

}  // namespace macula
