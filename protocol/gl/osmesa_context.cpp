#include <array>
#include <cstdint>
#include <utility>

#include "protocol/gl/context_kinds.h"

// osmesa.h includes the GL 1 header, whose types glcorearb.h (through functions.h) has already named alike.
#include <GL/osmesa.h>

namespace macula {

namespace {

class OsMesaContext final : public GlContext {
public:
    explicit OsMesaContext(OSMesaContext context) : context_(context) {}
    ~OsMesaContext() override {
        if (current_on_this_thread()) release();
        OSMesaDestroyContext(context_);
    }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

    Expected<void> make_current() override {
        if (OSMesaMakeCurrent(context_, &pixel_, GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE)
            return fail(ErrorCode::graphics, "OSMesaMakeCurrent failed");
        return {};
    }
    void release() noexcept override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
    [[nodiscard]] bool current_on_this_thread() const noexcept override {
        return OSMesaGetCurrentContext() == context_;
    }
    [[nodiscard]] const GlFunctions& gl() const override { return identity_.gl; }
    [[nodiscard]] std::string kind_name() const override { return "OSMesa"; }
    [[nodiscard]] std::string renderer() const override { return identity_.renderer; }
    [[nodiscard]] bool software() const override { return identity_.software; }

    Expected<void> identify() {
        const auto current = CurrentContext::enter(*this);
        if (!current) return tl::unexpected(current.error());
        auto identity = identify_current_context(OSMesaGetProcAddress);
        if (!identity) return tl::unexpected(identity.error());
        identity_ = std::move(*identity);
        return {};
    }

private:
    OSMesaContext context_;
    std::uint32_t pixel_ = 0;  ///< OSMesa wants a colour buffer; compute programs never touch it
    GlIdentity identity_;
};

}  // namespace

Expected<std::unique_ptr<GlContext>> make_osmesa_context() {
    for (const int minor : {5, 3}) {
        const std::array<int, 9> attributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_PROFILE,
                                               OSMESA_CORE_PROFILE,
                                               OSMESA_CONTEXT_MAJOR_VERSION,
                                               4,
                                               OSMESA_CONTEXT_MINOR_VERSION,
                                               minor,
                                               0};
        const OSMesaContext handle = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (handle == nullptr) continue;
        auto context = std::make_unique<OsMesaContext>(handle);
        if (auto identified = context->identify(); !identified) return tl::unexpected(identified.error());
        return context;
    }
    return fail(ErrorCode::graphics, "OSMesaCreateContextAttribs gives no GL 4.3 core context");
}

}  // namespace macula
