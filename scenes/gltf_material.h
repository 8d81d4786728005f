#pragma once

#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/gltf_texture.h"
#include "scenes/scene.h"

namespace macula {

/// Reads materials and the images that they use.
class GltfMaterialReader {
public:
    /// Images and materials are added to `scene`; both references outlive the reader.
    GltfMaterialReader(GltfContext& context, Scene& scene);

    /// Index in `scene.materials` of a glTF material, -1 being glTF's default material. Errors: `input_file`.
    Expected<int> material(int gltf_material);

private:
    Expected<void> read(Material& to, const tinygltf::Material& from, const std::string& element);

    GltfContext& context_;
    Scene& scene_;
    GltfTextureReader textures_;
    std::vector<int> materials_;  ///< by glTF material + 1; -1: not read yet
};

}  // namespace macula
