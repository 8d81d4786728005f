#pragma once

#include <string>

#include "scenes/noise.h"
#include "scenes/scene.h"

namespace macula {

/// Procedural surfaces as a material needs them. All repeat without a seam over [0, 1)^2 and are deterministic.

/// One texel of a surface.
struct SurfaceTexel {
    glm::vec3 color = glm::vec3(0.5F);  ///< sRGB-coded
    float alpha = 1.0F;
    float roughness = 0.7F;
    float metallic = 0.0F;
    float height = 0.0F;  ///< in widths of the image
};

/// Images of a surface; those that the maker did not ask for have no texels.
struct SurfaceMaps {
    TextureImage color;               ///< sRGB, alpha
    TextureImage roughness_metallic;  ///< linear, G roughness, B metallic
    TextureImage normal;              ///< linear, from the slopes of the height
};

/// What a texture's wear is made of, shared by all makers: reading it is much cheaper than making it.
struct WearNoise {
    NoiseField clouds{512, 4, 4, 6, 101};  ///< large soft shapes
    NoiseField blotches{512, 12, 12, 5, 203};
    NoiseField grain{512, 96, 96, 3, 307};
    NoiseField speckle{512, 256, 256, 1, 401};
    NoiseField streaks{512, 72, 3, 4, 503};  ///< long along v
};

/// Trowelled floor slab: stains, fine cracks, aggregate, dust. Meant for 2.5 m.
SurfaceMaps make_concrete_surface(int size_px, const WearNoise& noise);

/// Paint on sheet metal that has rusted from nail holes and lower edges, streaks along v. Meant for 3 m; four
/// rows of nails. `paint` is sRGB-coded.
SurfaceMaps make_rusty_sheet_surface(int size_px, const WearNoise& noise, const glm::vec3& paint);

/// Zinc-coated sheet with rust that spreads from the overlaps, streaks along v. Meant for 3 m.
SurfaceMaps make_zinc_surface(int size_px, const WearNoise& noise);

/// Painted steel with chips down to primer and rusty metal. Grey paint, to be multiplied with the material's colour.
/// Meant for 1 m. `wear` from 0 to 1 is about the share of chipped area.
SurfaceMaps make_chipped_paint_surface(int size_px, const WearNoise& noise, float wear);

/// Bare steel, ground, oiled and browned. Meant for 0.7 m.
SurfaceMaps make_worn_steel_surface(int size_px, const WearNoise& noise);

/// Aircraft skin: lapped panels with rows of rivets, oil stains, polish and scratches. Meant for 2 m.
SurfaceMaps make_aircraft_skin_surface(int size_px, const WearNoise& noise);

/// Sawn planks along u, eight over v, with grain, knots, nails and dirt. Meant for 1.2 m.
SurfaceMaps make_plank_surface(int size_px, const WearNoise& noise);

/// Old brickwork in running bond, 16 courses. Meant for 1.2 m.
SurfaceMaps make_brick_surface(int size_px, const WearNoise& noise);

/// Corrugated board with creases and tape. Meant for 0.6 m.
SurfaceMaps make_cardboard_surface(int size_px, const WearNoise& noise);

/// White road paint, worn through: alpha is how much is left. Meant for 2 m.
SurfaceMaps make_worn_marking_surface(int size_px, const WearNoise& noise);

/// Dirt on a pane, grey with alpha; clear in the middle, dirty along the edges. Not repeating: one pane.
SurfaceMaps make_pane_surface(int size_px, const WearNoise& noise);

}  // namespace macula
