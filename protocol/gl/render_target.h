#pragma once

#include <cstddef>

#include <glm/vec2.hpp>

#include "protocol/base/image.h"
#include "protocol/gl/context.h"

namespace macula {

/// A picture in GL memory that a RenderProgram draws into: RGBA8 is fragment output 0, a float output 1. Row 0 is the
/// one at the lower edge of GL's window coordinates. The context outlives it and, but for construction and destruction,
/// is current during calls.
class RenderTarget {
public:
    explicit RenderTarget(GlContext& context) : context_(&context) {}
    RenderTarget(const RenderTarget&) = delete;
    RenderTarget& operator=(const RenderTarget&) = delete;
    ~RenderTarget();

    /// Undefined content. Errors: `graphics` for a size that GL does not draw.
    Expected<void> resize(glm::ivec2 size_px);
    /// Makes this what is drawn to, opaque black and 0. Normalised device coordinates -1..1 become `viewport_px` pixels
    /// from `viewport_corner_px`; what of that lies outside the picture is not drawn.
    void begin(glm::ivec2 viewport_corner_px, glm::ivec2 viewport_px) const;
    /// Copies the picture once all that was drawn is in it, to rows of `stride_px`. Errors: `graphics`.
    [[nodiscard]] Expected<void> copy_to(Rgba8* color, std::size_t color_stride_px, float* value,
                                         std::size_t value_stride_px) const;

private:
    GlContext* context_;
    glm::ivec2 size_px_ = glm::ivec2(0);
    unsigned framebuffer_ = 0;
    unsigned renderbuffers_[2] = {};
};

}  // namespace macula
