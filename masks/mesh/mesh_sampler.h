#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "masks/display.h"
#include "masks/mesh/edge_distance.h"
#include "masks/mesh/mesh_table.h"
#include "masks/sample_plan.h"
#include "protocol/base/error.h"

namespace macula {

/// Whether a mask is at least as wide and as high as the display's window. Errors: `input_file`, naming both sizes.
Expected<void> check_mask_covers(const SampleMesh& mesh, const Display& display);

/// A triangulated mask that follows the gaze, as in the published system: its sites and triangles are moved over the
/// window so that the mask's gaze pixel lies at the pixel that is looked at.
///
/// The mask moves by whole steps of `step_px` pixels, counted from the window's edge, so that it lies still while the
/// gaze stays within a cell of so many pixels, whose middle counts as the gaze. The gaze may be off it by half a step;
/// who wants a fovea that covers this too makes a mask with a larger one. A step of 1 follows every pixel.
/// The window never leaves the mask: a gaze that would take it beyond the edge, as those outside of the frustum and
/// behind the eye, leaves it there. A mask of the window's size never moves.
///
/// What is traced, each once: the visible sites in the window, and those hidden or beyond its edge that a visible pixel
/// interpolates (MeshPixel). A raster reconstruction of the triangles needs no others: a corner that the table leaves
/// out has a weight of exactly 0 at the pixel.
/// Addresses are in the order of tracing and all are traced. The phase of a request counts for nothing: a mask has no
/// rank tile to shift.
class MeshSampler final : public Sampler {
public:
    /// Throws std::invalid_argument for a mask that check_mask_covers() refuses, or a step less than 1.
    MeshSampler(const Display& display, Eye eye, std::shared_ptr<const MeshTable> table, int step_px = 1);

    void plan(const PlanRequest& request, SamplePlan& plan) override;

private:
    /// A block of the mask that touches the window.
    struct Place {
        glm::ivec2 block;
        bool seen_whole;  ///< all of its pixels are visible
    };

    [[nodiscard]] glm::ivec2 origin_for(const glm::vec3& gaze_eye) const;
    void find_blocks(glm::ivec2 origin_px);
    void find_needed(glm::ivec2 block, int reach_px, glm::ivec2 origin_px);
    void need(glm::ivec2 site_px);
    [[nodiscard]] std::size_t write_block(const Place& place, glm::ivec2 origin_px, std::size_t first,
                                          SamplePlan& plan) const;
    void write_needed(glm::ivec2 origin_px, std::size_t first, SamplePlan& plan) const;

    Tangents tangents_;
    glm::ivec2 size_px_;  ///< of the window
    std::shared_ptr<const MeshTable> table_;
    int step_px_;
    std::shared_ptr<const std::vector<std::uint8_t>> hidden_;
    EdgeDistance edge_distance_;
    std::vector<glm::ivec2> morton_blocks_;  ///< of any window, from its first block on
    // From frame to frame only memory is kept.
    std::vector<Place> packet_blocks_;  ///< whole packets of sites, all visible
    std::vector<Place> other_blocks_;
    std::vector<glm::ivec2> needed_px_;  ///< sites that are not visible but needed, in pixels of the window
    std::vector<std::uint8_t> marked_;   ///< 1 for each of them, by EdgeDistance's index
};

}  // namespace macula
