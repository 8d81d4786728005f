#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "scenes/scene.h"
#include "server/kernels/texture.h"

namespace macula {

/// An image as a material reads it. Points to the image's texels.
struct TextureView {
    kernels::Texture lookup{};
    const std::uint8_t* texels = nullptr;
    int channels = 4;
    TexelType type = TexelType::u8;
    /// Linear values of u8 codes, or, for u16 codes of sRGB, of every 16th code. Of colour; alpha is linear.
    const float* decode = nullptr;
};

/// How `use` reads `image`, which outlives the view.
TextureView view_texture(const TextureUse& use, const TextureImage& image);

/// RGBA at untransformed coordinates, sRGB decoded: grey fills RGB, missing alpha is 1.
glm::vec4 look_up(const TextureView& texture, glm::vec2 uv) noexcept;

}  // namespace macula
