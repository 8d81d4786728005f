#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include "scenes/gltf_document.h"

namespace macula {

/// A node's own transform as the file gives it: translation, rotation and scale, or a matrix.
struct GltfPlace {
    glm::dvec3 translation_m = glm::dvec3(0.0);
    glm::dquat rotation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    glm::dvec3 scale = glm::dvec3(1.0);
    std::optional<glm::dmat4> matrix;  ///< instead of the three

    [[nodiscard]] glm::dmat4 parent_from_node() const;
};

/// A node of the scene that is shown.
struct PlacedNode {
    std::size_t node = 0;  ///< of the file
    int parent = -1;       ///< into the list of placed nodes
    GltfPlace place;
    glm::mat4 world_from_node = glm::mat4(1.0F);  ///< at time 0
    bool singular = false;                        ///< flattened or shrunk to nothing: there is no side to shade
    int moved_by = -1;                            ///< node of the scene's animation that carries it; -1: it never moves
};

/// Nodes of the file's default scene (else its first, else all root nodes), parents before children, not placed yet.
/// Errors: `input_file` for an index out of range, a node that is reached twice (two parents or a cycle), a transform
/// that is malformed.
Expected<std::vector<PlacedNode>> list_gltf_nodes(const GltfContext& context);

/// Multiplies the transforms down the hierarchy: fills world_from_node. Errors: `input_file`, not finite.
Expected<void> place_gltf_nodes(const GltfContext& context, std::vector<PlacedNode>& nodes);

/// Whether the matrix flattens its space; the scale does not matter.
bool is_singular(const glm::mat4& m);

/// "node 3 (\"wheel\")".
std::string node_name(const GltfContext& context, const PlacedNode& node);

}  // namespace macula
