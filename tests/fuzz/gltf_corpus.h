#pragma once

#include "tests/support/gltf_builder.h"

namespace macula {

/// A file that uses everything the loader knows: all extensions, textures in all slots and three formats, sparse and
/// quantised accessors, lights, cameras, a hierarchy that is animated in all ways, an emissive quad.
GltfBuilder gltf_with_everything();

}  // namespace macula
