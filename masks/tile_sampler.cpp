#include "masks/tile_sampler.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace macula {
namespace {

/// Cell of the rank tile that a tile of the plan lies on, 4 y + x.
int cell_of(const SamplePlan& plan, int tile_x, int tile_y) {
    // A tile column begins at 16 (t - 1) - phase mod 16, which the shift by the phase takes to whole cells.
    const int cell_x = (plan.phase_px.x / kTileEdge_px + tile_x - 1) & (RankTile::kCells - 1);
    const int cell_y = (plan.phase_px.y / kTileEdge_px + tile_y - 1) & (RankTile::kCells - 1);
    return cell_y * RankTile::kCells + cell_x;
}

bool has(const TilePixels& pixels, SamplePosition in_tile) {
    return (pixels[in_tile.y_px] >> in_tile.x_px & 1U) != 0;
}

void insert(TilePixels& pixels, SamplePosition in_tile) {
    pixels[in_tile.y_px] = static_cast<std::uint16_t>(pixels[in_tile.y_px] | 1U << in_tile.x_px);
}

bool in_window(const SamplePlan& plan, int x_px, int y_px) {
    return x_px >= 0 && y_px >= 0 && x_px < plan.width_px && y_px < plan.height_px;
}

glm::ivec2 tile_origin_px(const SamplePlan& plan, int tile) {
    return plan.origin_px + kTileEdge_px * glm::ivec2(tile % plan.tiles_x, tile / plan.tiles_x);
}

}  // namespace

TileSampler::TileSampler(const Display& display, Eye eye, std::optional<AcuityLaw> law,
                         std::shared_ptr<const TileTables> tables, const TileSamplerOptions& options)
    : display_(display),
      eye_(eye),
      law_(law),
      tables_(std::move(tables)),
      options_(options),
      order_(tables_->rank_tile()),
      reach_(*tables_),
      visible_(display, eye),
      most_tiles_(TileGrid({display.eye_width_px, display.eye_height_px}, glm::ivec2(kTileEdge_px - 1)).tiles),
      levels_(static_cast<std::size_t>(most_tiles_.x) * most_tiles_.y) {
    if (law_) level_map_.emplace(display, eye, *law_, options.hysteresis);
    for (int y = 0; y < most_tiles_.y + 2; ++y) {
        for (int x = 0; x < most_tiles_.x + 2; ++x) morton_tiles_.emplace_back(x, y);
    }
    std::sort(morton_tiles_.begin(), morton_tiles_.end(), [](const glm::ivec2& a, const glm::ivec2& b) {
        return morton(static_cast<std::uint32_t>(a.x), static_cast<std::uint32_t>(a.y)) <
               morton(static_cast<std::uint32_t>(b.x), static_cast<std::uint32_t>(b.y));
    });
}

void TileSampler::plan(const PlanRequest& request, SamplePlan& plan) {
    const TileGrid grid({display_.eye_width_px, display_.eye_height_px}, request.phase_px);
    plan.width_px = display_.eye_width_px;
    plan.height_px = display_.eye_height_px;
    plan.phase_px = request.phase_px;
    plan.origin_px = grid.origin_px - kTileEdge_px;
    plan.tiles_x = grid.tiles.x + 2;
    plan.tiles_y = grid.tiles.y + 2;
    const auto tiles = static_cast<std::size_t>(plan.tiles_x) * plan.tiles_y;
    plan.level.resize(tiles);
    plan.offset.resize(tiles + 1);
    plan.incomplete.resize(tiles);

    choose_levels(grid, request.gaze_eye);
    lay_out_tiles(grid, plan);
    find_partial_tiles(grid, plan);
    std::uint32_t total = 0;
    for (std::size_t i = 0; i < tiles; ++i) {
        plan.offset[i] = total;
        total += kLevelCounts[plan.level[i]];
    }
    plan.offset[tiles] = total;
    write_positions(plan);
    write_trace_order(plan);
}

void TileSampler::choose_levels(const TileGrid& grid, const glm::vec3& gaze_eye) {
    if (!level_map_) {
        std::fill(levels_.begin(), levels_.end(), std::uint8_t{kFullLevel});
        return;
    }
    const auto samples = [&](const std::vector<std::uint8_t>& levels) {
        std::uint32_t total = 0;
        for (int y = 0; y < grid.tiles.y; ++y) {
            for (int x = 0; x < grid.tiles.x; ++x) total += kLevelCounts[levels[y * most_tiles_.x + x]];
        }
        return total;
    };
    capped_ = levels_;
    level_map_->update(grid, gaze_eye, capped_.data(), most_tiles_.x);
    if (options_.max_samples > 0) {
        AcuityLaw law = *law_;
        const auto least = static_cast<std::uint32_t>(grid.tiles.x * grid.tiles.y * kLevelCounts[1]);
        while (samples(capped_) > std::max(options_.max_samples, least) && law.e2_deg > 1e-3) {
            law.e2_deg *= 0.97;
            capped_ = levels_;
            LevelMap(display_, eye_, law, options_.hysteresis).update(grid, gaze_eye, capped_.data(), most_tiles_.x);
        }
    }
    levels_.swap(capped_);
}

void TileSampler::lay_out_tiles(const TileGrid& grid, SamplePlan& plan) {
    // Guard tiles begin as dense as the tile they guard.
    for (int y = 0; y < plan.tiles_y; ++y) {
        const std::uint8_t* from = &levels_[std::clamp(y - 1, 0, grid.tiles.y - 1) * most_tiles_.x];
        std::uint8_t* to = &plan.level[static_cast<std::size_t>(y) * plan.tiles_x];
        std::copy_n(from, grid.tiles.x, to + 1);
        to[0] = to[1];
        to[plan.tiles_x - 1] = to[plan.tiles_x - 2];
    }
}

void TileSampler::find_partial_tiles(const TileGrid& grid, SamplePlan& plan) {
    partial_tiles_.clear();
    partial_of_.assign(plan.level.size(), -1);
    const auto add = [&](int tile, const TilePixels& visible) {
        partial_of_[tile] = static_cast<std::int32_t>(partial_tiles_.size());
        partial_tiles_.push_back({tile, visible});
    };
    for (int x = 0; x < plan.tiles_x; ++x) add(x, {});
    for (int y = 0; y < grid.tiles.y; ++y) {
        const int first = (y + 1) * plan.tiles_x;
        visible_.cover_row(grid, y, any_visible_, all_visible_);
        add(first, {});
        for (int x = 0; x < grid.tiles.x; ++x) {
            if (all_visible_[x] == 0xFFFF) continue;
            const int tile = first + 1 + x;
            if (any_visible_[x] == 0) {
                plan.level[tile] = 0;
                continue;
            }
            const glm::ivec2 origin = tile_origin_px(plan, tile);
            add(tile, visible_.tile(origin.x, origin.y));
        }
        add(first + plan.tiles_x - 1, {});
    }
    for (int x = 0; x < plan.tiles_x; ++x) add((plan.tiles_y - 1) * plan.tiles_x + x, {});

    for (PartialTile& partial : partial_tiles_) add_needed_beyond_window(plan, partial);
    for (const PartialTile& partial : partial_tiles_) {
        const bool nothing =
            std::all_of(partial.traced.begin(), partial.traced.end(), [](auto row) { return row == 0; });
        if (nothing) plan.level[partial.tile] = 0;
    }
}

void TileSampler::add_needed_beyond_window(const SamplePlan& plan, PartialTile& partial) const {
    const glm::ivec2 origin = tile_origin_px(plan, partial.tile);
    const glm::ivec2 end = origin + kTileEdge_px;
    if (in_window(plan, origin.x, origin.y) && in_window(plan, end.x - 1, end.y - 1)) return;
    const int cell = cell_of(plan, partial.tile % plan.tiles_x, partial.tile / plan.tiles_x);
    const auto& by_rank = order_.positions(1, cell);
    for (int rank = 0; rank < kLevelCounts[plan.level[partial.tile]]; ++rank) {
        const SamplePosition in_tile = by_rank[rank];
        const SamplePosition sample{static_cast<std::int16_t>(origin.x + in_tile.x_px),
                                    static_cast<std::int16_t>(origin.y + in_tile.y_px)};
        if (!in_window(plan, sample.x_px, sample.y_px) && needed_inside(plan, partial.tile, rank, sample))
            insert(partial.traced, in_tile);
    }
}

/// Whether a pixel inside the window may interpolate the sample: one of a tile nearby, by that tile's level.
bool TileSampler::needed_inside(const SamplePlan& plan, int tile, int rank, SamplePosition sample) const {
    const glm::ivec2 at(tile % plan.tiles_x, tile / plan.tiles_x);
    const int cell = cell_of(plan, at.x, at.y);
    // Guard tiles have no pixels inside.
    const glm::ivec2 first = glm::max(at - 1, glm::ivec2(1));
    const glm::ivec2 last = glm::min(at + 1, glm::ivec2(plan.tiles_x - 2, plan.tiles_y - 2));
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const int level = plan.level[y * plan.tiles_x + x];
            if (level == 0 || level == kFullLevel || rank >= kLevelCounts[level]) continue;
            const SampleReach::Box& box = reach_.box(level, cell, rank);
            const glm::ivec2 origin = plan.origin_px + kTileEdge_px * glm::ivec2(x, y);
            const int left = std::max({sample.x_px + box.left, origin.x, 0});
            const int right = std::min({sample.x_px + box.right, origin.x + kTileEdge_px - 1, plan.width_px - 1});
            const int top = std::max({sample.y_px + box.top, origin.y, 0});
            const int bottom = std::min({sample.y_px + box.bottom, origin.y + kTileEdge_px - 1, plan.height_px - 1});
            if (left <= right && top <= bottom) return true;
        }
    }
    return false;
}

void TileSampler::write_positions(SamplePlan& plan) const {
    plan.position.resize(plan.address_count());
    for (int tile = 0; tile < plan.tiles_x * plan.tiles_y; ++tile) {
        const int level = plan.level[tile];
        const auto& from = order_.positions(level, cell_of(plan, tile % plan.tiles_x, tile / plan.tiles_x));
        SamplePosition* to = plan.position.data() + plan.offset[tile];
        const glm::ivec2 origin = tile_origin_px(plan, tile);
        const auto x = static_cast<std::int16_t>(origin.x);
        const auto y = static_cast<std::int16_t>(origin.y);
        for (int i = 0; i < kLevelCounts[level]; ++i) {
            to[i].x_px = static_cast<std::int16_t>(from[i].x_px + x);
            to[i].y_px = static_cast<std::int16_t>(from[i].y_px + y);
        }
    }
}

void TileSampler::write_trace_order(SamplePlan& plan) const {
    plan.trace_order.resize(plan.address_count());
    plan.untraced.clear();
    plan.traced_in_window = 0;
    std::uint32_t* next = plan.trace_order.data();
    for (const glm::ivec2& at : morton_tiles_) {
        if (at.x >= plan.tiles_x || at.y >= plan.tiles_y) continue;
        const int tile = at.y * plan.tiles_x + at.x;
        const int level = plan.level[tile];
        const int cell = cell_of(plan, at.x, at.y);
        const std::uint32_t offset = plan.offset[tile];
        const auto order = order_.trace_order(level, cell);
        plan.incomplete[tile] = 0;
        if (partial_of_[tile] < 0) {
            for (const std::uint8_t address : order) *next++ = offset + address;
            plan.traced_in_window += kLevelCounts[level];
            continue;
        }
        const TilePixels& traced = partial_tiles_[partial_of_[tile]].traced;
        const auto& positions = order_.positions(level, cell);
        for (const std::uint8_t address : order) {
            if (has(traced, positions[address])) {
                *next++ = offset + address;
                const SamplePosition& p = plan.position[offset + address];
                if (in_window(plan, p.x_px, p.y_px)) ++plan.traced_in_window;
            } else {
                plan.untraced.push_back(offset + address);
                plan.incomplete[tile] = 1;
            }
        }
    }
    plan.trace_order.resize(static_cast<std::size_t>(next - plan.trace_order.data()));
}

bool is_traced(const SamplePlan& plan, const RankTile& rank_tile, int x_px, int y_px) {
    const glm::ivec2 tile = (glm::ivec2(x_px, y_px) - plan.origin_px) / kTileEdge_px;
    const int rank = rank_tile.at((x_px + plan.phase_px.x) & (RankTile::kEdge_px - 1),
                                  (y_px + plan.phase_px.y) & (RankTile::kEdge_px - 1));
    return rank < kLevelCounts[plan.level[tile.y * plan.tiles_x + tile.x]];
}

}  // namespace macula
