#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scenes/scene.h"
#include "server/kernels/environment.h"

namespace macula {

/// A lat-long map at one size, as it is averaged over directions.
struct LatLongLevel {
    glm::ivec2 size_px = glm::ivec2(0);
    std::vector<glm::vec3> texel;       ///< empty: those of the image
    glm::vec3 north = glm::vec3(0.0F);  ///< what all of the first row tends to at the pole +Y
    glm::vec3 south = glm::vec3(0.0F);
};

/// Light of an environment, prefiltered so that one lookup stands for all directions that a ray, a glossy lobe or a
/// matt surface gathers. Constant once built; building takes some .7 s of one core, most of it for lobes,
/// whose maps do not grow with the image.
class EnvironmentMap {
public:
    /// Keeps a pointer to the image, which has one to four channels of any type, and reads its colour as radiance.
    EnvironmentMap(const TextureImage& image, float intensity, float rotation_rad);
    EnvironmentMap(TextureImage&&, float, float) = delete;

    /// Mean radiance from a cone of directions around `direction` (any length) that is `width_rad` wide in all; 0 reads
    /// the image itself.
    [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction, float width_rad) const noexcept;

    /// Mean radiance that a glossy surface reflects when its mirror direction is `direction`: weighted by GGX of alpha
    /// = roughness^2 as if it were seen at a right angle (Karis 2013, "Real Shading in Unreal Engine 4"). Times the
    /// lobe's directional albedo it is the reflected light. 0 is a mirror.
    [[nodiscard]] glm::vec3 glossy_radiance(const glm::vec3& direction, float roughness) const noexcept;

    /// Irradiance of a surface with this unit normal; pi times the radiance where that is the same all around.
    [[nodiscard]] glm::vec3 irradiance(const glm::vec3& normal) const noexcept {
        return kernels::irradiance_of(harmonics_, normal);
    }
    /// The same for the use in loops over lanes.
    [[nodiscard]] const kernels::IrradianceHarmonics& harmonics() const { return harmonics_; }

    /// Bytes beyond those of the image.
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    [[nodiscard]] glm::vec3 texel(const LatLongLevel& level, std::size_t index) const noexcept;
    /// Mixed from the texels of a row around x, which may lie a texel outside.
    [[nodiscard]] glm::vec3 row_at(const LatLongLevel& level, int y, float x) const noexcept;
    [[nodiscard]] glm::vec3 read(const LatLongLevel& level, glm::vec2 uv) const noexcept;
    [[nodiscard]] glm::vec3 read_cone(glm::vec2 uv, float width_rad) const noexcept;
    [[nodiscard]] glm::vec3 read_lobe(glm::vec2 uv, float roughness) const noexcept;

    void set_poles(LatLongLevel& level) const;
    /// Mean over the directions that texel `at` of a map of this size covers.
    [[nodiscard]] glm::vec3 mean(const LatLongLevel& level, const glm::ivec2& at, const glm::ivec2& size_px) const;
    template <class Radiance>
    [[nodiscard]] LatLongLevel painted(const glm::ivec2& size_px, Radiance&& radiance) const;
    [[nodiscard]] LatLongLevel halve(const LatLongLevel& level) const;
    void find_lobes();
    void find_harmonics();

    const TextureImage* image_;
    float intensity_;
    float rotation_rad_;
    std::vector<LatLongLevel> size_;  ///< the image and its halves
    std::vector<LatLongLevel> lobe_;  ///< one per entry of kLobes
    kernels::IrradianceHarmonics harmonics_{};
};

}  // namespace macula
