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

/// Loads glTF 2.0, text or binary (told apart by content), with KHR_lights_punctual, KHR_texture_transform,
/// KHR_materials_unlit and KHR_mesh_quantization.
///
/// Refused, as `input_file` naming file and element: malformed or contradictory content, an extension that is required
/// and unknown, images that are missing or cannot be decoded (PNG and JPEG), non-finite numbers, nodes with two
/// parents, anything beyond `limits`, and references that leave the file's folder: a uri is a data uri or a relative
/// path without "..", below the folder of the file.
/// Skipped with a warning: unknown optional extensions, points and lines, triangles without area, nodes whose
/// transform is singular, animations, skins, morph targets.
/// Shown differently with a warning: alphaMode BLEND, as MASK at cutoff 0.5.
/// What glTF leaves open is decided in scenes/gltf_light.h (exposure, default light) and scenes/framing.h (start pose).
Expected<LoadedScene> load_gltf(const std::string& path, const GltfLimits& limits = {});

/// The same for a file in memory; relative uris are refused. `name` stands for the file in messages.
Expected<LoadedScene> load_gltf_from_memory(std::span<const std::uint8_t> bytes, const std::string& name,
                                            const GltfLimits& limits = {});

}  // namespace macula
