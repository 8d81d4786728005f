#pragma once

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace macula {

/// A camera at a node, as a place to look from: lenses are the headset's, so only the pose is read, of perspective and
/// orthographic cameras alike. It looks along the node's -Z with +Y up; scales and mirrorings of the node are taken
/// out. `name` is used where the camera has none. Errors: `input_file` if the camera does not exist.
Expected<SceneCamera> read_gltf_camera(const GltfContext& context, int camera, const glm::mat4& world_from_node,
                                       const std::string& name);

/// Rotation whose -Z and +Y are as near as can be to those of the matrix: -Z is kept, +Y made orthogonal to it; an axis
/// without length is made up from the others.
glm::quat extract_rotation(const glm::mat4& m);

}  // namespace macula
