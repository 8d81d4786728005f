#pragma once

#include <cstdint>
#include <span>

#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "protocol/gl/context.h"
#include "protocol/gl/render_target.h"

namespace macula {

/// Consecutive entries of an index buffer.
struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;  ///< three for each triangle
};

/// A vertex and a fragment program that draw triangles. There are no vertex attributes: the vertex program reads what
/// it needs from storage buffers, by gl_VertexID, which is the entry of the index buffer. No depth test, no culling, no
/// blending. Movable; the context must outlive it and, but for destruction, be current on the calling thread.
class RenderProgram {
public:
    /// Compiles both stages as ComputeProgram::build does. Errors: `graphics` with the compiler's log and the lines
    /// that it names.
    static Expected<RenderProgram> build(GlContext& context, std::span<const KernelText> vertex,
                                         std::span<const KernelText> fragment);

    RenderProgram(RenderProgram&& other) noexcept;
    RenderProgram& operator=(RenderProgram&&) = delete;
    RenderProgram(const RenderProgram&) = delete;
    RenderProgram& operator=(const RenderProgram&) = delete;
    ~RenderProgram();

    /// Draws triangles to the target that began last, with the storage buffers bound to the context. Returns before it
    /// is done; reading the target waits for it.
    void draw(const StorageBuffer<std::uint32_t>& indices, std::span<const IndexRange> ranges) const;

private:
    RenderProgram(GlContext& context, unsigned id);
    GlContext* context_;
    unsigned id_;
    unsigned vertex_array_ = 0;  ///< empty, but GL draws nothing while none is bound
};

}  // namespace macula
