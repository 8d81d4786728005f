#pragma once

#include <vector>

#include "scenes/animation.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_node.h"

namespace macula {

/// Reads all animations of the file as one: each repeats after its longest channel; where two move the same property
/// of a node the first counts. Of what does not move anything that is shown, nor ever changes, the value at time 0
/// goes into the nodes' places. What is left becomes the scene's animation, with a node for each that moves by itself
/// or shows something below one that does; PlacedNode::moved_by is set to it. `nodes` is as list_gltf_nodes() made it.
/// Left out with a warning: morph weights, nodes with a matrix, times that do not rise, rotations of length zero.
/// Errors: `input_file` for what is otherwise malformed, or moves beyond 1e9 m.
Expected<Animation> read_gltf_animation(GltfContext& context, std::vector<PlacedNode>& nodes);

/// Puts the nodes that the animation moves where they are at time 0; `nodes` as place_gltf_nodes() left them.
void pose_gltf_nodes(const Animation& animation, std::vector<PlacedNode>& nodes);

}  // namespace macula
