#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Procedural textures, sRGB, square, deterministic. Colours are sRGB-coded in [0, 1]. They carry detail up to the
/// texel on purpose: what a foveated renderer does wrong shows on them.

struct TwoColors {
    glm::vec3 first = glm::vec3(0.05F);
    glm::vec3 second = glm::vec3(0.95F);
};

/// `cells` x `cells` squares.
TextureImage make_checkerboard(int size_px, int cells, const TwoColors& colors);

/// Upright stripes, `periods` of them over the width.
TextureImage make_stripes(int size_px, int periods, const TwoColors& colors);

/// Rings cos(k r^2) whose frequency rises from the centre to `edge_cycles_per_px` at the middle of an edge.
TextureImage make_zone_plate(int size_px, float edge_cycles_per_px);

/// Spokes that meet in the centre.
TextureImage make_siemens_star(int size_px, int spokes);

/// Upright bars in rows; each row has sqrt(2) times the frequency of the row above it.
TextureImage make_bar_chart(int size_px);

/// Eye chart of the ten Sloan letters, five a row; each row is 10^-0.1 of the one above it.
TextureImage make_sloan_chart(int size_px);

/// Page of words in justified lines, set in the Sloan letters.
TextureImage make_text_page(int size_px);

/// Bricks in running bond with mortar, each in a slightly different colour.
TextureImage make_bricks(int size_px, const TwoColors& colors);

/// Grain along u, rings distorted by noise.
TextureImage make_wood(int size_px, const TwoColors& colors);

/// Fractal value noise; repeats without a seam.
TextureImage make_noise(int size_px, int cells, const TwoColors& colors);

}  // namespace macula
