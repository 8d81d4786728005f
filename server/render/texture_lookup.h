#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scenes/scene.h"
#include "server/kernels/texture_footprint.h"
#include "server/render/texture_levels.h"

namespace macula {

/// An image as a material reads it, at all its sizes. Points to the image's texels and to its levels.
struct TextureView {
    kernels::Texture lookup{};
    const TextureLevel* levels = nullptr;
    int level_count = 0;
    int channels = 4;
    TexelType type = TexelType::u8;
    /// Linear values of u8 codes, or, for u16 codes of sRGB, of every 16th code. Of colour; alpha is linear.
    const float* decode = nullptr;
};

/// A normal in tangent space.
struct NormalLookup {
    glm::vec3 normal;  ///< unit
    /// What the normals that it stands for add to the square of GGX's width alpha (of a normal scale s: s^2 times it).
    float variance;
};

/// The sizes of a scene's images, each made when first asked for. Keeps references to the images, which must not move.
class TextureLibrary {
public:
    /// A view stays valid as long as library and image.
    TextureView view(const TextureUse& use, const TextureImage& image, TextureContent content,
                     float alpha_cutoff = 0.0F);
    /// Bytes beyond those of the images.
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    using Key = std::tuple<const TextureImage*, TextureContent, float>;
    std::map<Key, std::unique_ptr<TextureLevels>> levels_;
};

/// RGBA at untransformed coordinates, sRGB decoded: grey fills RGB, missing alpha is 1. From the image itself.
glm::vec4 look_up(const TextureView& texture, glm::vec2 uv) noexcept;

/// The mean over a footprint. A texture with the filter `nearest` shows its texels where they are magnified, and is
/// filtered like any other elsewhere.
glm::vec4 look_up(const TextureView& texture, glm::vec2 uv, const kernels::UvFootprint& footprint) noexcept;

/// The mean normal over a footprint of a texture viewed as TextureContent::normals.
NormalLookup look_up_normal(const TextureView& texture, glm::vec2 uv, const kernels::UvFootprint& footprint) noexcept;

}  // namespace macula
