#include "protocol/gl/compute.h"

#include <array>
#include <utility>

#include "protocol/gl/functions.h"
#include "protocol/gl/shader.h"

namespace macula {

Expected<ComputeProgram> ComputeProgram::build(GlContext& context, std::span<const KernelText> parts) {
    const auto id = build_program(context, std::array{ShaderStage{GL_COMPUTE_SHADER, parts}});
    if (!id) return tl::unexpected(id.error());
    return ComputeProgram(context, *id);
}

ComputeProgram::ComputeProgram(ComputeProgram&& other) noexcept
    : context_(other.context_), id_(std::exchange(other.id_, 0U)) {}

ComputeProgram::~ComputeProgram() {
    if (id_ == 0) return;
    if (const auto current = CurrentContext::enter(*context_)) context_->gl().DeleteProgram(id_);
}

void ComputeProgram::dispatch(unsigned x, unsigned y, unsigned z) const {
    const GlFunctions& gl = context_->gl();
    gl.UseProgram(id_);
    gl.DispatchCompute(x, y, z);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace macula
