#pragma once

// The C++ side of the language that kernels are written in, so that one text is C++ and GLSL (KERNELS.md has
// the rules). kernel_prelude.glsl is the GLSL side.

#include <bit>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/packing.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define KERNEL_BEGIN namespace macula::kernels {
#define KERNEL_END }
/// Marks every kernel function. Static, because each source file may supply other accessor functions.
#define KERNEL static inline
/// Parameters that are costly to copy, that the function writes, or that it reads and writes.
#define KERNEL_IN(type) const type&
#define KERNEL_OUT(type) type&
#define KERNEL_INOUT(type) type&
/// Before a float's declaration: its value is computed as written, without fusing products and sums. In C++ that is an
/// option of the source file (-ffp-contract=off).
#define KERNEL_PRECISE

namespace macula::kernels {

using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

using glm::abs;
using glm::acos;
using glm::atan;
using glm::ceil;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::distance;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::length;
using glm::log;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::mod;
using glm::normalize;
using glm::packUnorm4x8;
using glm::pow;
using glm::reflect;
using glm::round;
using glm::sign;
using glm::sin;
using glm::smoothstep;
using glm::sqrt;
using glm::step;
using glm::tan;
using glm::unpackUnorm4x8;

inline uint floatBitsToUint(float value) {
    return std::bit_cast<uint>(value);
}
inline float uintBitsToFloat(uint bits) {
    return std::bit_cast<float>(bits);
}

}  // namespace macula::kernels
