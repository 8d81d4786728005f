#pragma once

#include <cstddef>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scenes/gltf_document.h"

namespace macula {

/// A node of the scene that is shown, with the product of the transforms above it.
struct PlacedNode {
    std::size_t node = 0;
    glm::mat4 world_from_node = glm::mat4(1.0F);
    bool singular = false;  ///< flattened or shrunk to nothing: there is no side to shade
};

/// All nodes of the file's default scene (else its first, else all root nodes), parents before children.
/// Errors: `input_file` for an index out of range, a node that is reached twice (two parents or a cycle), a transform
/// that is malformed or not finite.
Expected<std::vector<PlacedNode>> place_gltf_nodes(const GltfContext& context);

}  // namespace macula
