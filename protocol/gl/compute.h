#pragma once

#include <span>
#include <string_view>

#include "protocol/gl/context.h"

namespace macula {

/// A piece of GLSL. Kernel headers become such texts at build (protocol/gl/kernel_text.cmake).
struct KernelText {
    std::string_view name;  ///< for messages: the path of the file in the source tree
    std::string_view text;  ///< its lines keep the numbers that they have in the file
};

/// A GL compute program. Movable; the context must outlive it and, but for destruction, be current on the
/// calling thread.
class ComputeProgram {
public:
    /// Compiles, one after the other: `#version 430 core`, the kernel prelude, and the parts: usually the
    /// declarations of buffers with their accessor functions, the kernel, and a main().
    /// Errors: `graphics` with the compiler's log and the lines that it names.
    static Expected<ComputeProgram> build(GlContext& context, std::span<const KernelText> parts);

    ComputeProgram(ComputeProgram&& other) noexcept;
    ComputeProgram& operator=(ComputeProgram&&) = delete;
    ComputeProgram(const ComputeProgram&) = delete;
    ComputeProgram& operator=(const ComputeProgram&) = delete;
    ~ComputeProgram();

    /// Runs the program on x * y * z workgroups with the storage buffers bound to the context. Programs that
    /// are dispatched later see what it wrote. Returns before the program ends; reading a buffer waits for it.
    void dispatch(unsigned x, unsigned y = 1, unsigned z = 1) const;

private:
    ComputeProgram(GlContext& context, unsigned id) : context_(&context), id_(id) {}
    GlContext* context_;
    unsigned id_;
};

}  // namespace macula
