#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "masks/law.h"
#include "masks/make/mask.h"
#include "masks/make/recipe.h"
#include "masks/mesh/mesh_quality.h"
#include "masks/mesh/sample_mesh.h"

namespace macula {

/// A ring around the gaze, by eccentricity as the mask's geometry has it (MaskField).
struct InspectedRing {
    double from_deg = 0.0;  ///< included
    double to_deg = 0.0;    ///< not included, but of the last ring
    std::uint64_t pixels = 0;
    std::uint64_t samples = 0;
    double drawn = 0.0;  ///< share of the ring's pixels that are sampled; 0 without pixels
    /// Mean share that the law asks for, with the least that every mask has; none without a law.
    std::optional<double> wanted;
    SpacingRing spacing;  ///< of the circles through the edges
};

/// What macula-mask inspect tells.
struct Inspection {
    int width_px = 0;
    int height_px = 0;
    glm::ivec2 gaze_px = glm::ivec2(0);
    std::uint64_t samples = 0;
    double share = 0.0;                     ///< of the mask's pixels
    std::optional<double> share_in_window;  ///< while the gaze is on the axis; hidden pixels count
    std::optional<AcuityLaw> law;           ///< solved
    std::vector<InspectedRing> rings;
    TriangleQuality triangles;
};

/// What a mask is compared with; all but the display may be missing.
struct InspectionBasis {
    Display display;
    MaskGeometry geometry = MaskGeometry::flat;
    std::optional<AcuityLaw> law;  ///< solved; none: densities are compared with nothing
    bool full = false;             ///< every pixel is wanted; `law` does not count
};

/// Measures a mask and its mesh. Rings are those between the ascending `edges_deg`; empty: finer near the gaze, up to
/// the mask's farthest corner.
Inspection inspect(const Mask& mask, const SampleMesh& mesh, const InspectionBasis& basis,
                   std::vector<double> edges_deg = {});

/// As tables for a person; `name` is the file's. The recipe is the mask's, as JSON; empty: unknown.
std::string to_table(const Inspection& inspection, const std::string& name, const std::string& recipe);
/// As JSON, angles in degrees.
std::string to_json(const Inspection& inspection, const std::string& name, const std::string& recipe);

}  // namespace macula
