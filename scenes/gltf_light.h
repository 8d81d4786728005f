#pragma once

#include <glm/mat4x4.hpp>

#include "scenes/framing.h"
#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace macula {

/// A light of KHR_lights_punctual at a node: it shines along the node's -Z. The intensity stays in the file's unit,
/// candela or lux, until expose_gltf_lights(). Errors: `input_file` for an unknown type or a malformed number.
Expected<Light> read_gltf_light(const GltfContext& context, int light, const glm::mat4& world_from_node);

/// Turns photometric into radiometric intensities. glTF gives no exposure, and files range from sunlight in lux to
/// unitless values near one, so the punctual lights are metered: one factor scales them all such that a white diffuse
/// surface in the middle of the scene, turned to every light at once, has radiance 0.8. (683 lm/W is part of the
/// factor.) Scene exposure stays 1, so emissive and unlit colours are shown as they are written, and emissive quads
/// light the scene as they are seen. Ambient light is 0.04. Where there are no punctual lights and the rectangles bring
/// less than an irradiance of 0.5 to the middle of the scene, it gets a sun from the viewer's upper left (irradiance
/// 2.2, white, slightly warm), ambient light of 0.25 and a blue background.
void expose_gltf_lights(Scene& scene, const Bounds& bounds);

}  // namespace macula
