#pragma once

#include <array>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace macula {

/// Reads materials and the images that they use. An image is decoded when it is first used and stored once as sRGB
/// (base colour, emissive) and once as linear (the others), as far as it is used so.
class GltfMaterialReader {
public:
    /// Images and materials are added to `scene`; both references outlive the reader.
    GltfMaterialReader(GltfContext& context, Scene& scene);

    /// Index in `scene.materials` of a glTF material, -1 being glTF's default material. Errors: `input_file`.
    Expected<int> material(int gltf_material);

private:
    Expected<void> read(Material& to, const tinygltf::Material& from, const std::string& element);
    Expected<TextureUse> texture(int texture, int uv_set, const tinygltf::ExtensionMap& extensions, bool srgb,
                                 const std::string& element);
    Expected<int> image(int gltf_image, bool srgb);

    GltfContext& context_;
    Scene& scene_;
    std::vector<int> materials_;              ///< by glTF material + 1; -1: not read yet
    std::vector<std::array<int, 2>> images_;  ///< by glTF image and sRGB flag; -1: not decoded yet
};

}  // namespace macula
