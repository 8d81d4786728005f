#pragma once

// Compiling and linking, for programs of every kind. Internal to protocol/gl.

#include <span>

#include "protocol/gl/compute.h"
#include "protocol/gl/functions.h"

namespace macula {

/// One stage of a program: GL_COMPUTE_SHADER, GL_VERTEX_SHADER or GL_FRAGMENT_SHADER, and its text without the prelude.
struct ShaderStage {
    GLenum kind;
    std::span<const KernelText> parts;
};

/// Compiles each stage, as `#version 430 core`, the kernel prelude and the parts, and links them; the context is
/// current. The name of the program, which the caller deletes.
/// Errors: `graphics` with the compiler's log and the lines that it names.
Expected<unsigned> build_program(GlContext& context, std::span<const ShaderStage> stages);

}  // namespace macula
