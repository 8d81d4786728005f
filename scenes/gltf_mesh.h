#pragma once

#include <optional>

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace macula {

/// Reads one primitive as a mesh with exactly the attributes that `material` needs (`material_index` in the scene):
/// normals always; tangents, texture coordinates and colours where they are used. Nothing, with a warning, for points
/// and lines, for a primitive without positions, and where no triangle has an area. Errors: `input_file`.
Expected<std::optional<Mesh>> read_gltf_primitive(GltfContext& context, const tinygltf::Primitive& primitive,
                                                  const std::string& element, const Material& material,
                                                  int material_index);

}  // namespace macula
