#pragma once

// The prelude that lets one kernel text be C++ and GLSL 4.5. A kernel file is a header whose body, between
// KERNEL_BEGIN and KERNEL_END, uses only what both languages share: structs without initialisers or members,
// free functions, vectors and matrices with explicit constructors, .x .y .z .w (no swizzles), float literals
// with an F suffix, explicit conversions. Buffers are read through accessor functions that each side supplies
// before it includes the kernel. For GLSL, protocol/gl/kernel_text.cmake strips preprocessor lines and embeds
// the text; kernel_prelude.glsl defines the same macros.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define KERNEL_BEGIN namespace macula::kernels {
#define KERNEL_END }
/// Marks every kernel function.
#define KERNEL inline
/// Parameters that the function writes, or reads and writes.
#define KERNEL_OUT(type) type&
#define KERNEL_INOUT(type) type&

namespace macula::kernels {

using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat3;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

using glm::clamp;
using glm::cross;
using glm::dot;
using glm::floor;
using glm::length;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using std::abs;
using std::cos;
using std::exp;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;

inline uint floatBitsToUint(float value) {
    return std::bit_cast<uint>(value);
}
inline float uintBitsToFloat(uint bits) {
    return std::bit_cast<float>(bits);
}

}  // namespace macula::kernels
