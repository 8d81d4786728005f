#pragma once

#include "masks/sample_plan.h"
#include "server/render/lanes.h"
#include "server/render/shading_scene.h"

namespace macula {

/// What a packet of eye rays met. Lanes that are not in `hit` are undefined.
struct HitPacket {
    LaneMask hit = 0;
    glm::vec3 origin{};       ///< of all rays
    Lanes3 direction;         ///< of length 1 along the eye's -Z
    Lanes<float> distance;    ///< in lengths of `direction`
    Lanes3 geometric_normal;  ///< any length, on the front side
    Lanes<float> u;           ///< barycentric weight of the second corner
    Lanes<float> v;           ///< and of the third
    Lanes<std::uint32_t> instance;
    Lanes<std::uint32_t> triangle;
};

/// The surfaces that a packet met, as its lights see them.
struct SurfacePacket {
    LaneMask lit = 0;         ///< lanes that lights shine on: neither missed nor unlit
    Lanes3 position;          ///< lifted off the surface, so that rays may start there
    Lanes3 view;              ///< unit, towards the eye
    Lanes3 geometric_normal;  ///< unit, on the viewer's side
    Lanes3 normal;            ///< unit, shading
    Lanes3 base_color;
    Lanes<float> metallic;
    Lanes<float> roughness;
    Lanes3 radiance;  ///< towards the eye, of all that was added so far
};

/// What one light adds to a packet where nothing is in its way.
struct LightPacket {
    LaneMask lanes = 0;  ///< those that receive something
    Lanes3 to_light;     ///< from the surface's position: to the light, or a unit vector to a directional one
    Lanes3 radiance;
};

/// Base colour of a hit, all factors and textures applied. For holes cut by alpha.
glm::vec4 base_color_at(const ShadingInstance& instance, std::uint32_t triangle, float u, float v) noexcept;

/// Evaluates the materials of all lanes. Afterwards `radiance` holds what needs no light: emission, ambient light,
/// unlit colours, and the background where nothing was hit.
void find_surfaces(const ShadingScene& scene, const HitPacket& hits, SurfacePacket& surfaces) noexcept;

/// Evaluates one light for the lit lanes.
void shine(const kernels::Light& light, const SurfacePacket& surfaces, LightPacket& shine) noexcept;

/// Adds a light to the lanes that it reaches.
void add_light(const LightPacket& light, LaneMask reached, SurfacePacket& surfaces) noexcept;

/// sRGB-coded colours of the packet's radiance times `exposure`.
void encode(const SurfacePacket& surfaces, float exposure, Lanes<std::uint32_t>& color) noexcept;

}  // namespace macula
