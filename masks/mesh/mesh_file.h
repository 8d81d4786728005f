#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "masks/mesh/sample_mesh.h"
#include "protocol/base/error.h"

namespace macula {

/// Writes a mesh as binary glTF 2.0 (.glb), which any 3D viewer shows: a node with one triangle mesh in the plane z =
/// 0, one unit a pixel, y up. `asset.extras.macula` holds the mask's size, its gaze pixel and the recipe. The file
/// appears whole or not at all (written beside and renamed). Errors: `output`.
Expected<void> write_mesh(const SampleMesh& mesh, const std::string& path);

/// Reads what write_mesh wrote. Checks everything that the rest relies on (mesh_defect(): sites are distinct pixels of
/// the mask, triangles cover it once, in the right orientation). Errors: `input_file`, naming the file and what is
/// wrong with it.
Expected<SampleMesh> read_mesh(const std::string& path);

/// The same of a file in memory; `name` is for messages.
Expected<SampleMesh> read_mesh_from_memory(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace macula
