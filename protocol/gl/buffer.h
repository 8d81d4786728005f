#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "protocol/gl/context.h"

namespace macula {

/// Bytes in GL memory that programs read and write. Movable; the context must outlive it and, but
/// for construction and destruction, be current on the calling thread. GL keeps errors (out of memory) until
/// they are asked for: read_bytes() reports them.
class GlBuffer {
public:
    explicit GlBuffer(GlContext& context) : context_(&context) {}
    GlBuffer(GlBuffer&& other) noexcept;
    GlBuffer& operator=(GlBuffer&& other) noexcept;
    GlBuffer(const GlBuffer&) = delete;
    GlBuffer& operator=(const GlBuffer&) = delete;
    ~GlBuffer();

    /// Replaces the content; the memory is reused where the new content fits. `data` may be null: undefined content.
    void write_bytes(const void* data, std::size_t size_bytes);
    /// Content while the callback runs, after all programs dispatched before. Errors: `graphics`.
    template <class Use>
    Expected<void> read_bytes(std::size_t size_bytes, Use&& use) const {
        const auto mapped = map(size_bytes);
        if (!mapped) return tl::unexpected(mapped.error());
        use(*mapped);
        return unmap();
    }
    /// Makes this the storage buffer of `layout(std430, binding = index)`.
    void bind(unsigned index) const;
    /// Makes this the index buffer of the vertex array that is bound.
    void bind_as_indices() const;

private:
    [[nodiscard]] Expected<const void*> map(std::size_t size_bytes) const;
    [[nodiscard]] Expected<void> unmap() const;

    GlContext* context_;
    unsigned id_ = 0;
    std::size_t capacity_bytes_ = 0;
};

/// A shader storage buffer of values whose C++ layout is that of std430: scalars, vec2 and vec4, and structs
/// that are padded accordingly (a vec3 takes 16 bytes there).
template <class T>
class StorageBuffer {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    explicit StorageBuffer(GlContext& context) : bytes_(context) {}

    void write(std::span<const T> values) { resize_and_write(values.data(), values.size()); }
    void write(const T& value) { resize_and_write(&value, 1); }
    /// Undefined content.
    void resize(std::size_t count) { resize_and_write(nullptr, count); }
    [[nodiscard]] std::size_t size() const { return count_; }
    void bind(unsigned index) const { bytes_.bind(index); }
    /// RenderProgram::draw does.
    void bind_as_indices() const { bytes_.bind_as_indices(); }

    /// Calls `use(std::span<const T>)` on the content, after all programs dispatched before. Errors: `graphics`.
    template <class Use>
    Expected<void> read(Use&& use) const {
        return bytes_.read_bytes(count_ * sizeof(T), [&](const void* data) {
            use(std::span<const T>(static_cast<const T*>(data), count_));
        });
    }

private:
    void resize_and_write(const T* data, std::size_t count) {
        count_ = count;
        bytes_.write_bytes(data, count * sizeof(T));
    }

    GlBuffer bytes_;
    std::size_t count_ = 0;
};

}  // namespace macula
