#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "scenes/load.h"

namespace macula {

/// What a file may ask for before it is refused: a short file can describe an absurdly large scene.
struct GltfLimits {
    std::size_t file_bytes = std::size_t{1} << 30U;     ///< of each file that is read
    std::size_t elements = std::size_t{1} << 27U;       ///< accessor elements read, all together
    std::size_t texels = std::size_t{1} << 28U;         ///< of all images, once per use
    std::size_t image_side_px = std::size_t{1} << 14U;  ///< width or height of one image
    std::size_t instances = std::size_t{1} << 20U;
};

/// Loads glTF 2.0, text or binary (told apart by content), with EXT_texture_webp, KHR_lights_punctual,
/// KHR_materials_clearcoat, _emissive_strength, _ior, _sheen, _specular, _transmission, _unlit and _volume,
/// KHR_mesh_quantization and KHR_texture_transform. Animations of nodes become the scene's (scenes/gltf_animation.h),
/// cameras its places to start from (scenes/gltf_camera.h), emissive quads lights (scenes/emissive_quads.h).
///
/// Refused, as `input_file` naming file and element: malformed or contradictory content, an extension that is required
/// and unknown, images that are missing or cannot be decoded (PNG, JPEG, WebP), non-finite numbers, nodes with two
/// parents, animations that lead beyond 1e9 m, anything beyond `limits`, and references that leave the file's folder:
/// a uri is a data uri or a relative path without "..", below the folder of the file.
/// Skipped with a warning: unknown optional extensions, points and lines, triangles without area, nodes whose
/// transform is singular, skins (the mesh keeps its shape, placed by its node), morph targets and their weights.
/// Repaired with a warning: factors out of range, normals without length, keys that do not come after the one before,
/// rotations without length in animations, WebP images that cannot be decoded where the texture has another one.
/// What glTF leaves open is decided in scenes/gltf_light.h (exposure, default light) and scenes/framing.h (start pose).
Expected<LoadedScene> load_gltf(const std::string& path, const GltfLimits& limits = {});

/// The same for a file in memory; relative uris are refused. `name` stands for the file in messages.
Expected<LoadedScene> load_gltf_from_memory(std::span<const std::uint8_t> bytes, const std::string& name,
                                            const GltfLimits& limits = {});

}  // namespace macula
