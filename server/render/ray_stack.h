#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace macula {

/// Interfaces and layers that a path may cross: glass surfaces, inner reflections without a rest, and surfaces that
/// cover a part. What lies beyond is taken from the environment. Five panes of glass are ten.
inline constexpr int kLayerBound = 10;

/// How a ray came to be and what it may still do.
struct RayPath {
    glm::vec3 throughput = glm::vec3(1.0F);  ///< share of its radiance that reaches the eye
    float path_m = 0.0F;                     ///< metres from the eye to its origin
    float width_m = 0.0F;                    ///< of the footprint at its origin
    float spread = 0.0F;                     ///< metres by which the footprint widens per metre
    std::uint32_t slot = 0;                  ///< sample of the batch that it belongs to
    std::uint32_t volume = 0;                ///< instance index + 1 of the volume that it is in; 0: none
    std::uint8_t bounces = 0;                ///< reflections that may follow
    std::uint8_t layers = kLayerBound;       ///< crossings that may follow
    bool reflection = false;                 ///< it begins with one; otherwise it went through or past something
};

/// A ray that continues a path.
struct SecondaryRay {
    glm::vec3 origin;
    glm::vec3 direction;  ///< unit
    RayPath path;
};

/// Rays that wait, of one thread. Waves are taken from the top and their children put on top, so that it holds no more
/// than the children of a few waves however deep paths go. Never grows.
class RayStack {
public:
    explicit RayStack(std::size_t capacity) { rays_.reserve(capacity); }

    [[nodiscard]] bool empty() const { return rays_.empty(); }
    /// False where it is full.
    bool push(const SecondaryRay& ray) noexcept {
        if (rays_.size() == rays_.capacity()) return false;
        rays_.push_back(ray);
        return true;
    }
    /// Moves up to wave.size() rays from the top; returns how many.
    std::size_t pop(std::span<SecondaryRay> wave) noexcept {
        const std::size_t count = std::min(wave.size(), rays_.size());
        const auto first = rays_.end() - static_cast<std::ptrdiff_t>(count);
        std::copy(first, rays_.end(), wave.begin());
        rays_.erase(first, rays_.end());
        return count;
    }

private:
    std::vector<SecondaryRay> rays_;
};

}  // namespace macula
