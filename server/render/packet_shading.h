#pragma once

#include <cstdint>

#include "server/kernels/brdf.h"
#include "server/kernels/glossy.h"
#include "server/kernels/layers.h"
#include "server/render/embree_scene.h"
#include "server/render/lanes.h"
#include "server/render/shading_scene.h"

namespace macula {

/// What shading reads, constant while a frame is traced.
struct ShadingContext {
    const ShadingScene& scene;
    const ScenePose& pose;
    std::uint32_t needs = 0;       ///< of `Need`: code for others is not run
    float bounce_bound = 0.0F;     ///< TracerOptions'
    int light_samples_side = 1;    ///< square root of TracerOptions::light_samples
    bool normal_roughness = true;  ///< TracerOptions'
};

/// What a packet of rays met. Lanes that are not in `hit` are undefined where a miss has no such thing.
struct HitPacket {
    LaneMask hit = 0;
    LaneMask traced = 0;       ///< lanes whose ray is one
    LaneMask may_reflect = 0;  ///< lanes whose reflections may be traced
    Lanes3 origin;
    Lanes3 direction;
    Lanes<float> distance;    ///< in lengths of `direction`
    Lanes3 geometric_normal;  ///< any length, on the front side
    Lanes<float> u;           ///< barycentric weight of the second corner
    Lanes<float> v;           ///< and of the third
    Lanes<std::uint32_t> instance;
    Lanes<std::uint32_t> triangle;
    Lanes<float> spread;         ///< metres by which the footprint widens per metre; defined where needs ask for it
    Lanes<float> width_m;        ///< of the footprint at the hit, across the ray; likewise
    Lanes<float> share;          ///< largest component of the share of the radiance that reaches the eye; likewise
    Lanes<std::uint32_t> pixel;  ///< what tells this sample from its neighbours in random patterns; likewise
};

/// kernels::Surface, lane by lane.
struct SurfaceLanes {
    Lanes3 f0;
    Lanes<float> f90;
    Lanes<float> curves[11];
    Lanes3 scatter;
    Lanes3 base;
    Lanes3 entry;
    Lanes3 specular_albedo;
    Lanes3 base_albedo;

    void set(int lane, const kernels::Surface& surface);
    [[nodiscard]] kernels::Surface operator[](int lane) const;
};

/// What a lane has whose material is more than a plain one.
struct RichSurface {
    glm::vec3 dielectric_f0;
    float dielectric_f90;
    float coat;  ///< this and the rest of lanes with layers
    float coat_roughness;
    glm::vec3 coat_normal;  ///< unit
    glm::vec3 sheen_color;
    float sheen_roughness;
    kernels::Layers layers;
    float coat_reflected;  ///< like SurfacePacket::reflected, of the coat
};

/// The surfaces that a packet met, as its lights see them.
struct SurfacePacket {
    LaneMask lit = 0;         ///< lanes that lights shine on: neither missed nor unlit
    LaneMask branching = 0;   ///< lanes from which rays may go on
    LaneMask rich = 0;        ///< lanes whose material is more than a plain one
    LaneMask layered = 0;     ///< lanes that have layers on top
    Lanes3 position;          ///< lifted off the surface, so that rays may start there
    Lanes3 view;              ///< unit, towards the eye
    Lanes3 geometric_normal;  ///< unit, on the viewer's side
    Lanes3 normal;            ///< unit, shading
    Lanes3 base_color;
    Lanes<float> metallic;
    Lanes<float> roughness;
    Lanes<float> plane_extent_m;  ///< ShadingInstance's
    SurfaceLanes surface;
    Lanes3 radiance;  ///< towards the eye, of all that was added so far

    // Of `branching` lanes alone.
    Lanes<float> coverage;      ///< share of the light from behind that the surface hides, 0..1
    Lanes<float> transmission;  ///< share of the base that lets light through
    Lanes<float> reflected;     ///< share of the specular light that reflected rays bring; the rest is in `radiance`

    RichSurface more[kLaneCount];  ///< of `rich` lanes alone
};

/// What one light, or one sample of it, adds to a packet where nothing is in its way.
struct LightPacket {
    LaneMask lanes = 0;  ///< those that receive something
    Lanes3 to_light;     ///< from the surface's position: to the light, or a unit vector to a directional one
    Lanes3 radiance;
};

/// Evaluates the materials of all lanes. Afterwards `radiance` holds what needs no light: emission, light from all
/// around, unlit colours, and what rays see that hit nothing.
void find_surfaces(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces) noexcept;

/// Evaluates a light without an extent for the lit lanes. `lobes` are those of the surfaces, or what is left of them.
void shine(const ShadingLight& light, const SurfacePacket& surfaces, const SurfaceLanes& lobes,
           LightPacket& shine) noexcept;

/// Points of the unit square, by lane.
struct LightPlaces {
    Lanes<float> x;
    Lanes<float> y;
};

/// Evaluates one point of a light with an extent for the lit lanes.
void shine(const ShadingLight& light, const SurfacePacket& surfaces, const SurfaceLanes& lobes,
           const LightPlaces& places, LightPacket& shine) noexcept;

/// The surfaces' lobes for a light that reflected rays see: without the share that those bring.
SurfaceLanes without_reflected(const SurfacePacket& surfaces) noexcept;

/// Adds `scale` times a light to the lanes that it reaches.
void add_light(const LightPacket& light, LaneMask reached, float scale, SurfacePacket& surfaces) noexcept;

/// sRGB-coded colours of radiance times `exposure`.
void encode(const Lanes3& radiance, float exposure, Lanes<std::uint32_t>& color) noexcept;

/// What a ray sees along a direction (unit) where nothing is hit, in a cone that widens by `spread`.
glm::vec3 background_light(const ShadingContext& context, const glm::vec3& direction, float spread) noexcept;

/// Light from all around that comes from a direction (unit): the environment's, seen through a cone that widens by
/// `spread`, and the ambient light. Stands for rays that are not traced.
glm::vec3 surrounding_light(const ShadingContext& context, const glm::vec3& direction, float spread) noexcept;

/// Share of a reflection or refraction that is traced where `share` of its light would reach the eye: 0 up to the
/// bound, all from its double on, smooth between them.
inline float traced_share(float share, float bound) {
    const float t = bound > 0.0F ? glm::clamp(share / bound - 1.0F, 0.0F, 1.0F) : 1.0F;
    return t * t * (3.0F - 2.0F * t);
}

/// Share of a reflection of this roughness that is traced: all up to .25, nothing from kGlossLimit on, smooth between.
inline float glossy_share(float roughness) {
    const float t = glm::clamp((kGlossLimit - roughness) / (kGlossLimit - 0.25F), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// Full width, per metre, of the cone that holds half of a reflected GGX lobe.
inline float lobe_spread(float roughness) {
    return 2.0F * kernels::lobe_half_width_tan(roughness * roughness);
}

}  // namespace macula
