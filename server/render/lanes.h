#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

/// Before a loop over the lanes whose iterations do not depend on each other, so that it vectorises. (`omp simd` is
/// no substitute: g++ 12 then keeps the loop's vectors in memory.)
#if defined(__clang__)
#define MACULA_LANE_LOOP _Pragma("clang loop vectorize(assume_safety)")
#else
#define MACULA_LANE_LOOP _Pragma("GCC ivdep")
#endif

namespace macula {

/// Rays that are traced and shaded together. All values of a packet are kept lane by lane, so that loops over the
/// lanes vectorise.
inline constexpr int kLaneCount = 16;

/// Set of lanes, one bit each.
using LaneMask = std::uint32_t;

template <class T>
struct alignas(64) Lanes {
    T value[kLaneCount];

    T& operator[](int lane) { return value[lane]; }
    const T& operator[](int lane) const { return value[lane]; }
};

/// Sixteen vectors.
struct Lanes3 {
    Lanes<float> x;
    Lanes<float> y;
    Lanes<float> z;

    [[nodiscard]] glm::vec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
    void set(int lane, const glm::vec3& v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
};

/// Calls `use(lane)` for each lane of a set, in order.
template <class Use>
inline void for_each_lane(LaneMask lanes, Use&& use) {
    for (; lanes != 0; lanes &= lanes - 1) use(std::countr_zero(lanes));
}

}  // namespace macula
