#pragma once

#include <string>

#include "scenes/gltf_document.h"
#include "scenes/gltf_texture.h"
#include "scenes/scene.h"

namespace macula {

/// Reads KHR_materials_emissive_strength (multiplied into the emissive factor), _ior, _specular, _clearcoat, _sheen,
/// _transmission and _volume into a material whose core is read. Factors out of range are clamped with a warning;
/// textures of a layer whose factor is zero are not read. ior 0, which stands for a mirror at every angle, becomes
/// kMirrorIor. Errors: `input_file` for what is malformed, naming `element`.
Expected<void> read_material_extensions(GltfContext& context, GltfTextureReader& textures,
                                        const tinygltf::ExtensionMap& extensions, const std::string& element,
                                        Material& material);

/// Reflects 99.6 % at normal incidence.
inline constexpr float kMirrorIor = 1000.0F;

/// Largest emissive factor, and the largest strength that multiplies it.
inline constexpr float kMostEmission = 1e9F;

/// Smallest component of an attenuation colour, so that its logarithm is finite.
inline constexpr float kDarkestAttenuation = 1e-6F;

}  // namespace macula
