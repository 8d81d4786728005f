#include "protocol/gl/buffer.h"

#include <algorithm>
#include <utility>

#include "protocol/gl/functions.h"

namespace macula {

GlBuffer::GlBuffer(GlBuffer&& other) noexcept
    : context_(other.context_),
      id_(std::exchange(other.id_, 0U)),
      capacity_bytes_(std::exchange(other.capacity_bytes_, 0U)) {}

GlBuffer& GlBuffer::operator=(GlBuffer&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(id_, other.id_);
    std::swap(capacity_bytes_, other.capacity_bytes_);
    return *this;
}

GlBuffer::~GlBuffer() {
    if (id_ == 0) return;
    if (const auto current = CurrentContext::enter(*context_)) context_->gl().DeleteBuffers(1, &id_);
}

void GlBuffer::write_bytes(const void* data, std::size_t size_bytes) {
    const GlFunctions& gl = context_->gl();
    if (id_ == 0) gl.GenBuffers(1, &id_);
    gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, id_);
    if (size_bytes > capacity_bytes_ || capacity_bytes_ == 0) {
        // GL knows no empty storage, and a plan's size changes a little from frame to frame.
        capacity_bytes_ = std::max<std::size_t>(size_bytes + size_bytes / 8, 16);
        gl.BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(capacity_bytes_), nullptr, GL_DYNAMIC_DRAW);
    }
    if (data != nullptr && size_bytes > 0)
        gl.BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(size_bytes), data);
}

void GlBuffer::bind(unsigned index) const {
    context_->gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, index, id_);
}

void GlBuffer::bind_as_indices() const {
    context_->gl().BindBuffer(GL_ELEMENT_ARRAY_BUFFER, id_);
}

Expected<const void*> GlBuffer::map(std::size_t size_bytes) const {
    const GlFunctions& gl = context_->gl();
    gl.MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, id_);
    const void* data =
        gl.MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(size_bytes), GL_MAP_READ_BIT);
    const auto checked = check_gl_errors(gl);
    if (!checked) return tl::unexpected(checked.error());
    if (data == nullptr) return fail(ErrorCode::graphics, "GL does not map a buffer");
    return data;
}

Expected<void> GlBuffer::unmap() const {
    const GlFunctions& gl = context_->gl();
    if (gl.UnmapBuffer(GL_SHADER_STORAGE_BUFFER) == GL_FALSE)
        return fail(ErrorCode::graphics, "the content of a GL buffer was lost");
    return check_gl_errors(gl);
}

}  // namespace macula
