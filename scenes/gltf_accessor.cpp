#include "scenes/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace macula {
namespace {

constexpr std::size_t kMostZeros = std::size_t{1} << 22U;

/// Equally spaced elements inside the bytes of a buffer view; all of them are known to lie inside.
struct ElementArray {
    const std::uint8_t* first = nullptr;
    std::size_t stride_bytes = 0;
};

std::size_t component_bytes(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;  // tinygltf also lets INT and DOUBLE pass, which glTF does not know
    }
}

template <class T>
T load(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

/// glTF 2.0, 3.6.2.2: f = c / 255 and the like; signed ones are f = max(c / 127, -1).
template <class T>
float load_number(const std::uint8_t* at, bool normalized) {
    const auto value = static_cast<float>(load<T>(at));
    if (!normalized || std::is_same_v<T, float>) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

float load_float(const std::uint8_t* at, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return load_number<std::int8_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load_number<std::uint8_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return load_number<std::int16_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load_number<std::uint16_t>(at, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return load_number<std::uint32_t>(at, normalized);
        default:
            return load<float>(at);
    }
}

bool is_unsigned_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::uint32_t load_unsigned(const std::uint8_t* at, int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *at;
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<std::uint16_t>(at);
    return load<std::uint32_t>(at);
}

int components_of_type(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

/// `count` elements of `element_bytes` that start at `offset` of a view; `stride` 0 means tightly packed.
Expected<ElementArray> locate(const GltfContext& context, int view, std::size_t offset, std::size_t stride,
                              std::size_t element_bytes, std::size_t count, const std::string& element) {
    const Expected<std::span<const std::uint8_t>> bytes = view_bytes(context, view, element);
    if (!bytes) return tl::unexpected(bytes.error());
    if (stride == 0) stride = element_bytes;
    if (stride < element_bytes) return context.error(element, "the stride is smaller than an element");
    const std::size_t size = bytes->size();
    if (offset > size || size - offset < element_bytes || (count - 1) > (size - offset - element_bytes) / stride)
        return context.error(element, "its elements reach beyond the end of buffer view " + std::to_string(view));
    return ElementArray{bytes->data() + offset, stride};
}

/// Calls `assign(index, bytes)` for every element that the file has, then for the sparse replacements.
template <class Assign>
Expected<void> for_each_element(GltfContext& context, const tinygltf::Accessor& accessor, const std::string& element,
                                std::size_t element_bytes, Assign assign) {
    const std::size_t count = accessor.count;
    if (accessor.bufferView >= 0) {
        const auto& views = context.document.model.bufferViews;
        const auto view = static_cast<std::size_t>(accessor.bufferView);
        const std::size_t stride = view < views.size() ? views[view].byteStride : 0;
        const Expected<ElementArray> dense =
            locate(context, accessor.bufferView, accessor.byteOffset, stride, element_bytes, count, element);
        if (!dense) return tl::unexpected(dense.error());
        for (std::size_t i = 0; i < count; ++i) assign(i, dense->first + i * dense->stride_bytes);
    }
    if (!accessor.sparse.isSparse) return {};

    const auto& sparse = accessor.sparse;
    const std::string sparse_element = element + ", sparse";
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > count)
        return context.error(sparse_element, "the count is not between 1 and the accessor's");
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        return context.error(sparse_element, "an offset is negative");
    if (!is_unsigned_type(sparse.indices.componentType))
        return context.error(sparse_element, "indices have to be unsigned integers");
    const auto sparse_count = static_cast<std::size_t>(sparse.count);
    const Expected<ElementArray> indices =
        locate(context, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), 0,
               component_bytes(sparse.indices.componentType), sparse_count, sparse_element);
    if (!indices) return tl::unexpected(indices.error());
    const Expected<ElementArray> values =
        locate(context, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), 0, element_bytes,
               sparse_count, sparse_element);
    if (!values) return tl::unexpected(values.error());
    for (std::size_t i = 0; i < sparse_count; ++i) {
        const std::uint32_t target =
            load_unsigned(indices->first + i * indices->stride_bytes, sparse.indices.componentType);
        if (target >= count) return context.error(sparse_element, "index " + std::to_string(target) + " is too large");
        assign(target, values->first + i * values->stride_bytes);
    }
    return {};
}

/// The accessor, once its index, component type and count are known to be sane.
Expected<const tinygltf::Accessor*> checked_accessor(GltfContext& context, int index, int components) {
    const auto& accessors = context.document.model.accessors;
    if (index < 0 || static_cast<std::size_t>(index) >= accessors.size())
        return context.error("accessor " + std::to_string(index), "does not exist");
    const tinygltf::Accessor& accessor = accessors[static_cast<std::size_t>(index)];
    const std::string element = element_name("accessor", static_cast<std::size_t>(index), accessor.name);
    if (components_of_type(accessor.type) != components)
        return context.error(element, "has to have " + std::to_string(components) + " number(s) per element");
    if (component_bytes(accessor.componentType) == 0)
        return context.error(element, "component type " + std::to_string(accessor.componentType) + " is not glTF");
    if (accessor.normalized && accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        return context.error(element, "32-bit integers cannot be normalised");
    if (accessor.count == 0) return context.error(element, "is empty");
    if (accessor.count > context.elements_left)
        return context.error(element, "the scene has more than " + std::to_string(context.limits.elements) +
                                          " vertices and indices, which is the limit");
    // A few bytes of JSON must not ask for gigabytes of zeros.
    if (accessor.bufferView < 0 && accessor.count > kMostZeros)
        return context.error(element, "has more than " + std::to_string(kMostZeros) + " elements and no data");
    context.elements_left -= accessor.count;
    return &accessor;
}

}  // namespace

Expected<std::span<const std::uint8_t>> view_bytes(const GltfContext& context, int view, const std::string& element) {
    const tinygltf::Model& model = context.document.model;
    if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size())
        return context.error(element, "buffer view " + std::to_string(view) + " does not exist");
    const tinygltf::BufferView& v = model.bufferViews[static_cast<std::size_t>(view)];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model.buffers.size())
        return context.error(element_name("buffer view", static_cast<std::size_t>(view), v.name),
                             "buffer " + std::to_string(v.buffer) + " does not exist");
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(v.buffer)].data;
    if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset)
        return context.error(element_name("buffer view", static_cast<std::size_t>(view), v.name),
                             "reaches beyond the end of buffer " + std::to_string(v.buffer));
    return std::span<const std::uint8_t>(data.data() + v.byteOffset, v.byteLength);
}

int accessor_components(const GltfContext& context, int accessor) {
    const auto& accessors = context.document.model.accessors;
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= accessors.size()) return 0;
    return components_of_type(accessors[static_cast<std::size_t>(accessor)].type);
}

template <class Element>
Expected<std::vector<Element>> read_accessor(GltfContext& context, int accessor) {
    const int components = Element::length();
    const Expected<const tinygltf::Accessor*> found = checked_accessor(context, accessor, components);
    if (!found) return tl::unexpected(found.error());
    const tinygltf::Accessor& source = **found;
    const std::string element = element_name("accessor", static_cast<std::size_t>(accessor), source.name);
    const std::size_t step = component_bytes(source.componentType);
    std::vector<Element> elements(source.count, Element(0.0F));
    bool finite = true;
    const auto assign = [&](std::size_t i, const std::uint8_t* bytes) {
        for (int c = 0; c < components; ++c) {
            const float value =
                load_float(bytes + static_cast<std::size_t>(c) * step, source.componentType, source.normalized);
            finite = finite && std::isfinite(value);
            elements[i][c] = value;
        }
    };
    const Expected<void> read =
        for_each_element(context, source, element, step * static_cast<std::size_t>(components), assign);
    if (!read) return tl::unexpected(read.error());
    if (!finite) return context.error(element, "contains NaN or infinity");
    return elements;
}

template Expected<std::vector<glm::vec1>> read_accessor(GltfContext&, int);
template Expected<std::vector<glm::vec2>> read_accessor(GltfContext&, int);
template Expected<std::vector<glm::vec3>> read_accessor(GltfContext&, int);
template Expected<std::vector<glm::vec4>> read_accessor(GltfContext&, int);

Expected<std::vector<std::uint32_t>> read_indices(GltfContext& context, int accessor) {
    const Expected<const tinygltf::Accessor*> found = checked_accessor(context, accessor, 1);
    if (!found) return tl::unexpected(found.error());
    const tinygltf::Accessor& source = **found;
    const std::string element = element_name("accessor", static_cast<std::size_t>(accessor), source.name);
    if (!is_unsigned_type(source.componentType)) return context.error(element, "indices have to be unsigned integers");
    std::vector<std::uint32_t> indices(source.count, 0);
    const auto assign = [&](std::size_t i, const std::uint8_t* bytes) {
        indices[i] = load_unsigned(bytes, source.componentType);
    };
    const Expected<void> read =
        for_each_element(context, source, element, component_bytes(source.componentType), assign);
    if (!read) return tl::unexpected(read.error());
    return indices;
}

}  // namespace macula
