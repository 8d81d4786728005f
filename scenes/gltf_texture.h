#pragma once

#include <array>
#include <string>
#include <vector>

#include "scenes/gltf_document.h"
#include "scenes/scene.h"

namespace macula {

/// What RGB of a texture is; a material's slot decides it.
enum class TextureCoding : std::uint8_t { linear, srgb };

/// Reads textures and the images behind them. An image is decoded when it is first used and stored once as sRGB and
/// once as linear, as far as it is used so. Of EXT_texture_webp the WebP image is taken, or, with a warning, the
/// texture's other image where the first cannot be decoded.
class GltfTextureReader {
public:
    /// Images are added to `scene`; both references outlive the reader.
    GltfTextureReader(GltfContext& context, Scene& scene);

    /// `info` is a textureInfo of the file, `element` what has it. Errors: `input_file`.
    Expected<TextureUse> read(const tinygltf::TextureInfo& info, TextureCoding coding, const std::string& element);

private:
    Expected<int> image_of(const tinygltf::Texture& texture, const std::string& element, TextureCoding coding);
    Expected<int> image(int gltf_image, TextureCoding coding);
    Expected<TextureImage> decode(std::size_t gltf_image, const std::string& element);

    GltfContext& context_;
    Scene& scene_;
    std::vector<std::array<int, 2>> images_;  ///< by glTF image and coding; -1: not decoded yet
    std::vector<bool> unreadable_;            ///< by glTF image: decoding it has failed
};

}  // namespace macula
