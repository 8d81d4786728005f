#include "protocol/gl/render_target.h"

#include <array>
#include <string>

#include "protocol/gl/functions.h"

namespace macula {

namespace {

constexpr std::array<GLenum, 2> kAttachments = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
constexpr std::array<GLenum, 2> kFormats = {GL_RGBA8, GL_R32F};

}  // namespace

RenderTarget::~RenderTarget() {
    if (framebuffer_ == 0) return;
    if (const auto current = CurrentContext::enter(*context_)) {
        context_->gl().DeleteFramebuffers(1, &framebuffer_);
        context_->gl().DeleteRenderbuffers(2, renderbuffers_);
    }
}

Expected<void> RenderTarget::resize(glm::ivec2 size_px) {
    if (size_px == size_px_) return {};
    const GlFunctions& gl = context_->gl();
    if (framebuffer_ == 0) {
        gl.GenFramebuffers(1, &framebuffer_);
        gl.GenRenderbuffers(2, renderbuffers_);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    for (std::size_t i = 0; i < kAttachments.size(); ++i) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffers_[i]);
        gl.RenderbufferStorage(GL_RENDERBUFFER, kFormats[i], size_px.x, size_px.y);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, kAttachments[i], GL_RENDERBUFFER, renderbuffers_[i]);
    }
    gl.DrawBuffers(kAttachments.size(), kAttachments.data());
    size_px_ = glm::ivec2(0);
    if (auto checked = check_gl_errors(gl); !checked) return checked;
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return fail(ErrorCode::graphics, "GL does not draw pictures of " + std::to_string(size_px.x) + "x" +
                                             std::to_string(size_px.y) + " in RGBA8 and R32F");
    size_px_ = size_px;
    return {};
}

void RenderTarget::begin(glm::ivec2 viewport_corner_px, glm::ivec2 viewport_px) const {
    const GlFunctions& gl = context_->gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.Disable(GL_DITHER);  // on by default
    gl.Viewport(viewport_corner_px.x, viewport_corner_px.y, viewport_px.x, viewport_px.y);
    constexpr std::array kBlack = {0.0F, 0.0F, 0.0F, 1.0F};
    constexpr std::array kZero = {0.0F, 0.0F, 0.0F, 0.0F};
    gl.ClearBufferfv(GL_COLOR, 0, kBlack.data());
    gl.ClearBufferfv(GL_COLOR, 1, kZero.data());
}

Expected<void> RenderTarget::copy_to(Rgba8* color, std::size_t color_stride_px, float* value,
                                     std::size_t value_stride_px) const {
    const GlFunctions& gl = context_->gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(color_stride_px));
    gl.ReadPixels(0, 0, size_px_.x, size_px_.y, GL_RGBA, GL_UNSIGNED_BYTE, color);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT1);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(value_stride_px));
    gl.ReadPixels(0, 0, size_px_.x, size_px_.y, GL_RED, GL_FLOAT, value);
    return check_gl_errors(gl);
}

}  // namespace macula
