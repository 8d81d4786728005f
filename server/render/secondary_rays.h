#pragma once

#include <span>

#include "server/render/packet_shading.h"
#include "server/render/ray_stack.h"
#include "server/render/tracer.h"

namespace macula {

/// Sends rays on from the lanes of a packet from which paths branch:
/// - past a surface that covers a part of what lies behind, straight on;
/// - off mirrors and glossy surfaces, along the mirror direction, one ray whose footprint holds half of the lobe, so
/// that
///   textures and the environment are read as blurred as the lobe sees them (surfaces that it meets keep their edges);
/// - off glass and through it, split by Fresnel's equations: straight through thin walls, bent at volumes; under total
///   internal reflection inside. A rough interface widens the footprint and bends nothing more.
/// Adds to `radiance`, which is that of the whole lanes before, what the rest of those rays would bring, from the
/// environment; afterwards it is that of the lanes without what the new rays bring. `path` are the paths of the
/// packet's rays at their hits.
void send_rays(const ShadingContext& context, const HitPacket& hits, const SurfacePacket& surfaces,
               std::span<const RayPath, kLaneCount> path, Lanes3& radiance, RayStack& stack,
               TraceCounts& counts) noexcept;

}  // namespace macula
