#pragma once

#include <glm/vec3.hpp>

#include "server/render/embree_calls.h"
#include "server/render/lanes.h"
#include "server/render/shading_scene.h"

namespace macula {

/// A query for light that surfaces may colour on its way: begins with what Embree knows. Rays carry their lane in `id`.
///
/// Coverage and thin walls take their share at each crossing, volumes also by the way inside: a ray that enters at t0
/// and leaves at t1 loses absorption * (t1 - t0), which is summed as t1 - t0 in whatever order the surfaces come.
/// A ray through the edge that two triangles share meets both, and counts one. Light is not bent. A query without such
/// surfaces leaves `colored` 0.
struct LightQuery {
    /// A crossing that was counted.
    struct Crossing {
        const ShadingInstance* instance = nullptr;
        float t = 0.0F;  ///< negated where the ray left
    };
    /// Crossings that are remembered for each lane, the newest in the place of the oldest.
    static constexpr unsigned kRemembered = 4;

    QueryContext context;
    Lanes<float> length_m;   ///< of the rays' directions; set by the caller
    LaneMask colored = 0;    ///< lanes that crossed something; the rest is defined for these alone
    Lanes3 transmittance;    ///< product of all crossings
    Lanes3 optical_depth;    ///< absorption * (sum of exits - sum of entries)
    Lanes3 open_absorption;  ///< absorption of entries minus that of exits, 1/m
    Lanes<unsigned> crossings;
    Crossing last[kLaneCount][kRemembered];
};

/// What an intersection query for rays that look needs at this instance; null: nothing.
/// Single-sided surfaces are not seen from behind, unless they enclose a volume; holes are cut.
RTCFilterFunctionN sight_filter(const ShadingInstance& instance);

/// What an occlusion query with a LightQuery needs at this instance; null: it stops light. To light both sides of any
/// surface are alike.
RTCFilterFunctionN light_filter(const ShadingInstance& instance);

/// Share of light that came through, for a lane that nothing stopped and whose ray ended at `far` lengths, which
/// may be infinite.
glm::vec3 light_through(const LightQuery& query, int lane, float far);

}  // namespace macula
