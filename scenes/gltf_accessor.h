#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_float1.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scenes/gltf_document.h"

namespace macula {

/// Values of an accessor of any component type that glTF allows, normalised integers as [0, 1] or [-1, 1], sparse
/// replacements applied, zeros where there is no buffer view. `Element` has to match the accessor's type.
/// Errors: `input_file` for an index, type, size or bound that is wrong, also for non-finite numbers.
template <class Element>
Expected<std::vector<Element>> read_accessor(GltfContext& context, int accessor);

extern template Expected<std::vector<glm::vec1>> read_accessor(GltfContext&, int);
extern template Expected<std::vector<glm::vec2>> read_accessor(GltfContext&, int);
extern template Expected<std::vector<glm::vec3>> read_accessor(GltfContext&, int);
extern template Expected<std::vector<glm::vec4>> read_accessor(GltfContext&, int);

/// Unsigned integers of any width, for vertex indices.
Expected<std::vector<std::uint32_t>> read_indices(GltfContext& context, int accessor);

/// Numbers per element: 2 for VEC2 and so on; 0 if there is no such accessor or it is a matrix.
int accessor_components(const GltfContext& context, int accessor);

/// Bytes of a buffer view, checked against its buffer. Errors: `input_file`, naming `element`.
Expected<std::span<const std::uint8_t>> view_bytes(const GltfContext& context, int view, const std::string& element);

}  // namespace macula
