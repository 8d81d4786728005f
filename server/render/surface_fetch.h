#pragma once

#include "server/render/packet_shading.h"

namespace macula {

/// Where a triangle of an instance was hit.
struct TriangleHit {
    std::uint32_t triangle = 0;
    float u = 0.0F;  ///< barycentric weight of the second corner
    float v = 0.0F;  ///< and of the third
};

/// Reads what is scattered in memory for a packet: attributes, factors and textures. `radiance` holds emission
/// afterwards, `normal` is not unit and on the front's side, in world space.
void fetch_surfaces(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces) noexcept;

/// Base colour of a hit, all factors and textures applied. For holes cut by alpha.
glm::vec4 base_color_at(const ShadingInstance& instance, const TriangleHit& hit) noexcept;

/// Share of light that passes straight through a hit surface, by its coverage and transmission, whatever lies behind;
/// `cosine` is that of incidence.
glm::vec3 light_past(const ShadingInstance& instance, const TriangleHit& hit, float cosine) noexcept;

}  // namespace macula
