#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "scenes/scene.h"

namespace macula {

/// What an image's values mean, and so how they are averaged.
enum class TextureContent : std::uint8_t {
    values,         ///< each channel for itself; colour in linear light
    covered_color,  ///< colour weighted by alpha, so that what is hidden does not bleed
    normals,        ///< a tangent-space normal map
};

/// One size of a texture.
struct TextureLevel {
    const std::uint8_t* texels = nullptr;
    glm::ivec2 size_px = glm::ivec2(0);
};

/// Smaller copies of an image, each of half the size (rounded down) of the one before, to 1 x 1. A texel is the mean of
/// what it covers of the image; sizes that are not powers of two are weighted by area (Guthe and Heckbert 2005,
/// "Non-Power-of-Two Mipmap Creation"). Constant once built.
///
/// The copies are stored like the image, those of a normal map as three u8: x and y of the unit mean normal as glTF
/// codes them, and the root of the variance: what the spread of the normals that were averaged adds to the square of
/// GGX's width alpha. It follows from the mean vector's length (Toksvig 2005, "Mipmapping Normal Maps"), by way of the
/// concentration of a von Mises-Fisher distribution (Han et al. 2007, "Frequency Domain Normal Map Filtering").
class TextureLevels {
public:
    /// Keeps a pointer to the image's texels. With `alpha_cutoff` above 0 every level keeps the share of texels whose
    /// alpha reaches the cutoff (Castano 2010, "Computing Alpha Mipmaps").
    TextureLevels(const TextureImage& image, TextureContent content, float alpha_cutoff = 0.0F);
    TextureLevels(const TextureLevels&) = delete;  // levels point into it
    TextureLevels& operator=(const TextureLevels&) = delete;

    /// The first one is the image.
    [[nodiscard]] const std::vector<TextureLevel>& levels() const { return levels_; }
    /// Bytes beyond those of the image.
    [[nodiscard]] std::size_t memory_bytes() const { return texels_.capacity(); }

private:
    std::vector<std::uint8_t> texels_;
    std::vector<TextureLevel> levels_;
};

/// What averaging unit normals to a vector of this length adds to alpha squared; 0 at 1, at most 1.
float lost_variance(float mean_length);

}  // namespace macula
