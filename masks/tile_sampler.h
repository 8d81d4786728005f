#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/level_map.h"
#include "masks/sample_order.h"
#include "masks/sample_plan.h"
#include "masks/sample_reach.h"
#include "masks/tile_tables.h"
#include "masks/visible_area.h"

namespace macula {

struct TileSamplerOptions {
    /// A tile drops to a sparser level only when the need falls below this part of the level boundary; 1: at once.
    float hysteresis = 0.8F;
    /// Most rays inside the window, 0 for any number; the few guard samples come on top. A plan that would exceed
    /// it follows a law that is stretched less, down to the sparsest level everywhere. No bound on a sampler without
    /// law.
    std::uint32_t max_samples = 0;
};

/// Tile sampling: a prefix of a screen-anchored blue-noise rank tile in every 16x16 tile, as long as the acuity law
/// needs at the angle between the tile and the gaze. Exact for every gaze, at a cost that hardly depends on it.
///
/// What is traced: the visible samples of all tiles, and beyond the window's edge those that a pixel inside may
/// interpolate. Hidden pixels are never traced; tiles without a visible pixel are at level 0.
class TileSampler final : public Sampler {
public:
    /// Without a law, every visible pixel gets a ray.
    TileSampler(const Display& display, Eye eye, std::optional<AcuityLaw> law, std::shared_ptr<const TileTables> tables,
                const TileSamplerOptions& options = {});

    void plan(const PlanRequest& request, SamplePlan& plan) override;

private:
    /// A tile of which not all samples are traced.
    struct PartialTile {
        int tile = 0;  ///< index in the plan
        TilePixels traced{};
    };

    void choose_levels(const TileGrid& grid, const glm::vec3& gaze_eye);
    [[nodiscard]] std::uint32_t visible_samples(const TileGrid& grid, const std::vector<std::uint8_t>& levels) const;
    void lay_out_tiles(const TileGrid& grid, SamplePlan& plan);
    void find_partial_tiles(const TileGrid& grid, SamplePlan& plan);
    void add_needed_beyond_window(const SamplePlan& plan, PartialTile& partial) const;
    void write_positions(SamplePlan& plan) const;
    void write_trace_order(SamplePlan& plan) const;
    std::uint32_t* write_partial_tile(SamplePlan& plan, const glm::ivec2& at, std::uint32_t* next) const;

    Display display_;
    std::optional<AcuityLaw> law_;
    std::shared_ptr<const TileTables> tables_;
    TileSamplerOptions options_;
    SampleOrder order_;
    SampleReach reach_;
    std::shared_ptr<const std::vector<std::uint8_t>> hidden_;  ///< of every plan
    VisibleArea visible_;
    std::optional<LevelMap> level_map_;
    glm::ivec2 most_tiles_;                 ///< of any phase, without the guard ring
    std::vector<glm::ivec2> morton_tiles_;  ///< of any phase, with the guard ring
    std::vector<std::uint8_t> levels_;      ///< by the law, rows most_tiles_.x apart; state from frame to frame
    std::vector<std::uint8_t> candidate_;   ///< scratch
    std::vector<Cover> cover_;              ///< per tile of the grid
    std::vector<PartialTile> partial_tiles_;
    std::vector<std::int32_t> partial_of_;  ///< per tile of the plan: index into partial_tiles_, or -1
};

/// Whether window pixel (x, y) was traced, if it is not hidden. This is the rule by which a client tells traced
/// pixels from the level map and the phase of a Frame.
bool is_traced(const SamplePlan& plan, const RankTile& rank_tile, int x_px, int y_px);

}  // namespace macula
