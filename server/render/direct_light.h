#pragma once

#include "server/render/packet_shading.h"
#include "server/render/tracer.h"

namespace macula {

/// Adds what all lights send to a packet's surfaces, as far as nothing is in their way. Lights that have no extent cost
/// a shadow ray for each lane that they could reach, others `light_samples`, for the lanes that each sample could
/// reach: not where range or cone end, where the surface turns away, or behind a rectangle.
///
/// A sample's place on the light is that of its stratum, moved by an offset of the pixel alone (kernels::light_offset):
/// neighbours differ as evenly as can be, so that reconstruction and the client's accumulation average them, and a
/// still picture stands still.
void add_lights(const ShadingContext& context, const HitPacket& hits, SurfacePacket& surfaces, RayTap* tap,
                TraceCounts& counts) noexcept;

}  // namespace macula
