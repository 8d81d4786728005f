#pragma once

#include <string>

#include "scenes/animation.h"
#include "scenes/gltf_document.h"

namespace macula {

/// Reads a sampler of an animation for a path. The channel's node and period are left at their defaults. Keys whose
/// time does not come after the one before, and rotations of length zero, which become none, are repaired with a
/// warning. Errors: `input_file` for accessors, numbers of values or an interpolation that are wrong.
Expected<AnimationChannel> read_gltf_channel(GltfContext& context, const tinygltf::AnimationSampler& sampler,
                                             AnimationPath path, const std::string& element);

/// Bound of all values that the channel takes, between its keys, too: of their lengths, of scales by component.
double largest_value(const AnimationChannel& channel);

/// Whether all values are the same, but for the rounding of rotations and scales.
bool is_constant(const AnimationChannel& channel);

}  // namespace macula
