#include "protocol/gl/render_program.h"

#include <array>
#include <utility>
#include <vector>

#include "protocol/gl/functions.h"
#include "protocol/gl/shader.h"

namespace macula {

Expected<RenderProgram> RenderProgram::build(GlContext& context, std::span<const KernelText> vertex,
                                             std::span<const KernelText> fragment) {
    const auto id = build_program(
        context, std::array{ShaderStage{GL_VERTEX_SHADER, vertex}, ShaderStage{GL_FRAGMENT_SHADER, fragment}});
    if (!id) return tl::unexpected(id.error());
    return RenderProgram(context, *id);
}

RenderProgram::RenderProgram(GlContext& context, unsigned id) : context_(&context), id_(id) {
    context.gl().GenVertexArrays(1, &vertex_array_);
}

RenderProgram::RenderProgram(RenderProgram&& other) noexcept
    : context_(other.context_),
      id_(std::exchange(other.id_, 0U)),
      vertex_array_(std::exchange(other.vertex_array_, 0U)) {}

RenderProgram::~RenderProgram() {
    if (id_ == 0) return;
    if (const auto current = CurrentContext::enter(*context_)) {
        context_->gl().DeleteProgram(id_);
        context_->gl().DeleteVertexArrays(1, &vertex_array_);
    }
}

void RenderProgram::draw(const StorageBuffer<std::uint32_t>& indices, std::span<const IndexRange> ranges) const {
    const GlFunctions& gl = context_->gl();
    std::vector<GLsizei> counts;
    std::vector<const void*> offsets;
    for (const IndexRange& range : ranges) {
        counts.push_back(static_cast<GLsizei>(range.count));
        // GL takes an offset into the index buffer in the guise of a pointer.
        const std::uintptr_t offset_bytes = std::uintptr_t{range.first} * sizeof(std::uint32_t);
        offsets.push_back(reinterpret_cast<const void*>(offset_bytes));  // NOLINT(performance-no-int-to-ptr)
    }
    gl.UseProgram(id_);
    gl.BindVertexArray(vertex_array_);
    indices.bind_as_indices();
    gl.MultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                         static_cast<GLsizei>(counts.size()));
}

}  // namespace macula
