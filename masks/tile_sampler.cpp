#include "masks/tile_sampler.h"

#include <algorithm>
#include <span>
#include <utility>

namespace macula {
namespace {

/// A stretch at which every tile but that of the gaze is at the sparsest level.
constexpr double kLeastStretch = 1e-4;

/// Rays that a tracer takes at a time.
constexpr int kPacket = 16;

/// Pixels from `first` to `last`, both included; empty if any of last is less.
struct PixelBox {
    glm::ivec2 first;
    glm::ivec2 last;

    [[nodiscard]] bool contains(const glm::ivec2& p) const {
        return p.x >= first.x && p.y >= first.y && p.x <= last.x && p.y <= last.y;
    }
    [[nodiscard]] PixelBox intersection(const PixelBox& other) const {
        return {glm::max(first, other.first), glm::min(last, other.last)};
    }
};

/// The window, seen from the top left pixel of a tile.
PixelBox window_from(const SamplePlan& plan, const glm::ivec2& tile) {
    const glm::ivec2 origin_px = plan.origin_px + kTileEdge_px * tile;
    return {-origin_px, glm::ivec2(plan.width_px, plan.height_px) - 1 - origin_px};
}

/// Cell of the rank tile that a tile of the plan lies on, 4 y + x.
int cell_of(const SamplePlan& plan, const glm::ivec2& tile) {
    // A tile column begins at 16 (t - 1) - phase mod 16, which the shift by the phase takes to whole cells.
    const int cell_x = (plan.phase_px.x / kTileEdge_px + tile.x - 1) & (RankTile::kCells - 1);
    const int cell_y = (plan.phase_px.y / kTileEdge_px + tile.y - 1) & (RankTile::kCells - 1);
    return cell_y * RankTile::kCells + cell_x;
}

bool has(const TilePixels& pixels, SamplePosition in_tile) {
    return (pixels[in_tile.y_px] >> in_tile.x_px & 1U) != 0;
}

void insert(TilePixels& pixels, SamplePosition in_tile) {
    pixels[in_tile.y_px] = static_cast<std::uint16_t>(pixels[in_tile.y_px] | 1U << in_tile.x_px);
}

// The two loops over all samples stand alone so that the compiler vectorises them.

void shift_positions(const SamplePosition* in_tile, int count, const glm::ivec2& origin_px, SamplePosition* to) {
    const auto x = static_cast<std::int16_t>(origin_px.x);
    const auto y = static_cast<std::int16_t>(origin_px.y);
    for (int i = 0; i < count; ++i) {
        to[i].x_px = static_cast<std::int16_t>(in_tile[i].x_px + x);
        to[i].y_px = static_cast<std::int16_t>(in_tile[i].y_px + y);
    }
}

void shift_addresses(std::span<const std::uint8_t> in_tile, std::uint32_t offset, std::uint32_t* to) {
    for (std::size_t i = 0; i < in_tile.size(); ++i) to[i] = offset + in_tile[i];
}

}  // namespace

TileSampler::TileSampler(const Display& display, Eye eye, std::optional<AcuityLaw> law,
                         std::shared_ptr<const TileTables> tables, const TileSamplerOptions& options)
    : display_(display),
      law_(law),
      tables_(std::move(tables)),
      options_(options),
      order_(tables_->rank_tile()),
      reach_(*tables_),
      hidden_(std::make_shared<const std::vector<std::uint8_t>>(hidden_pixels(display, eye))),
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
    plan.hidden = hidden_;
    plan.phase_px = request.phase_px;
    plan.origin_px = grid.origin_px - kTileEdge_px;
    plan.tiles_x = grid.tiles.x + 2;
    plan.tiles_y = grid.tiles.y + 2;
    const auto tiles = static_cast<std::size_t>(plan.tiles_x) * plan.tiles_y;
    plan.level.resize(tiles);
    plan.offset.resize(tiles + 1);
    plan.incomplete.resize(tiles);

    visible_.cover(grid, cover_);
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

    // What the fields of another kind of sampler may hold.
    plan.place.clear();
    plan.spacing.clear();
    plan.mesh.reset();
    plan.grids = {};
}

void TileSampler::choose_levels(const TileGrid& grid, const glm::vec3& gaze_eye) {
    if (!level_map_) {
        std::fill(levels_.begin(), levels_.end(), std::uint8_t{kFullLevel});
        return;
    }
    candidate_ = levels_;
    level_map_->update(grid, gaze_eye, candidate_.data(), most_tiles_.x);
    if (options_.max_samples > 0) {
        double stretch = law_->stretch;
        while (visible_samples(grid, candidate_) > options_.max_samples && stretch > kLeastStretch) {
            stretch *= 0.97;
            level_map_->set_stretch(stretch);
            candidate_ = levels_;
            level_map_->update(grid, gaze_eye, candidate_.data(), most_tiles_.x);
        }
        level_map_->set_stretch(law_->stretch);
    }
    levels_.swap(candidate_);
}

/// Upper bound of the rays inside the window.
std::uint32_t TileSampler::visible_samples(const TileGrid& grid, const std::vector<std::uint8_t>& levels) const {
    std::uint32_t total = 0;
    for (int y = 0; y < grid.tiles.y; ++y) {
        for (int x = 0; x < grid.tiles.x; ++x) {
            if (cover_[y * grid.tiles.x + x] != Cover::none) total += kLevelCounts[levels[y * most_tiles_.x + x]];
        }
    }
    return total;
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
        add(first, {});
        for (int x = 0; x < grid.tiles.x; ++x) {
            const Cover cover = cover_[y * grid.tiles.x + x];
            if (cover == Cover::all) continue;
            const int tile = first + 1 + x;
            if (cover == Cover::none) {
                plan.level[tile] = 0;
                continue;
            }
            const glm::ivec2 origin_px = grid.origin_px + kTileEdge_px * glm::ivec2(x, y);
            add(tile, visible_.tile(origin_px.x, origin_px.y));
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

/// Adds the samples that pixels inside the window may interpolate: those of the tile itself and of its neighbours,
/// each by its own level. The bounding box of such pixels stands for the pixels.
void TileSampler::add_needed_beyond_window(const SamplePlan& plan, PartialTile& partial) const {
    const glm::ivec2 at(partial.tile % plan.tiles_x, partial.tile / plan.tiles_x);
    const PixelBox window = window_from(plan, at);
    if (window.contains({0, 0}) && window.contains(glm::ivec2(kTileEdge_px - 1))) return;
    const int count = kLevelCounts[plan.level[partial.tile]];
    const int cell = cell_of(plan, at);
    const auto& by_rank = order_.positions(1, cell);
    // Guard tiles have no pixels inside.
    const glm::ivec2 first = glm::max(at - 1, glm::ivec2(1));
    const glm::ivec2 last = glm::min(at + 1, glm::ivec2(plan.tiles_x - 2, plan.tiles_y - 2));
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const int level = plan.level[y * plan.tiles_x + x];
            if (level == 0 || level == kFullLevel) continue;  // these interpolate nothing
            const glm::ivec2 corner = kTileEdge_px * (glm::ivec2(x, y) - at);
            const PixelBox users = window.intersection({corner, corner + kTileEdge_px - 1});
            for (int rank = 0; rank < std::min<int>(count, kLevelCounts[level]); ++rank) {
                const SampleReach::Box& reach = reach_.box(level, cell, rank);
                const glm::ivec2 sample(by_rank[rank].x_px, by_rank[rank].y_px);
                const bool used = sample.x + reach.left <= users.last.x && sample.x + reach.right >= users.first.x &&
                                  sample.y + reach.top <= users.last.y && sample.y + reach.bottom >= users.first.y;
                if (used && !window.contains(sample)) insert(partial.traced, by_rank[rank]);
            }
        }
    }
}

void TileSampler::write_positions(SamplePlan& plan) const {
    plan.position.resize(plan.address_count());
    for (int y = 0; y < plan.tiles_y; ++y) {
        for (int x = 0; x < plan.tiles_x; ++x) {
            const int tile = y * plan.tiles_x + x;
            const int level = plan.level[tile];
            const auto& in_tile = order_.positions(level, cell_of(plan, {x, y}));
            shift_positions(in_tile.data(), kLevelCounts[level], plan.origin_px + kTileEdge_px * glm::ivec2(x, y),
                            plan.position.data() + plan.offset[tile]);
        }
    }
}

/// Tiles of whole packets come first and stay aligned to packets, so that those of a full tile are 4x4 blocks; the
/// others follow, where sparse tiles share packets with their Morton neighbours.
void TileSampler::write_trace_order(SamplePlan& plan) const {
    plan.trace_order.resize(plan.address_count());
    plan.untraced.clear();
    plan.traced_in_window = 0;
    std::fill(plan.incomplete.begin(), plan.incomplete.end(), std::uint8_t{0});
    std::uint32_t* next = plan.trace_order.data();
    for (const bool whole_packets : {true, false}) {
        for (const glm::ivec2& at : morton_tiles_) {
            if (at.x >= plan.tiles_x || at.y >= plan.tiles_y) continue;
            const int tile = at.y * plan.tiles_x + at.x;
            const int count = kLevelCounts[plan.level[tile]];
            const bool partial = partial_of_[tile] >= 0;
            if (whole_packets != (!partial && count % kPacket == 0)) continue;
            if (partial) {
                next = write_partial_tile(plan, at, next);
                continue;
            }
            shift_addresses(order_.trace_order(plan.level[tile], cell_of(plan, at)), plan.offset[tile], next);
            next += count;
            plan.traced_in_window += static_cast<std::uint32_t>(count);
        }
    }
    plan.trace_order.resize(static_cast<std::size_t>(next - plan.trace_order.data()));
}

std::uint32_t* TileSampler::write_partial_tile(SamplePlan& plan, const glm::ivec2& at, std::uint32_t* next) const {
    const int tile = at.y * plan.tiles_x + at.x;
    const int level = plan.level[tile];
    const int cell = cell_of(plan, at);
    const TilePixels& traced = partial_tiles_[partial_of_[tile]].traced;
    const PixelBox window = window_from(plan, at);
    for (const std::uint8_t in_tile : order_.trace_order(level, cell)) {
        const SamplePosition position = order_.positions(level, cell)[in_tile];
        const std::uint32_t address = plan.offset[tile] + in_tile;
        if (has(traced, position)) {
            *next++ = address;
            if (window.contains({position.x_px, position.y_px})) ++plan.traced_in_window;
        } else {
            plan.untraced.push_back(address);
            plan.incomplete[tile] = 1;
        }
    }
    return next;
}

bool is_traced(const SamplePlan& plan, const RankTile& rank_tile, int x_px, int y_px) {
    const glm::ivec2 tile = (glm::ivec2(x_px, y_px) - plan.origin_px) / kTileEdge_px;
    const int rank = rank_tile.at((x_px + plan.phase_px.x) & (RankTile::kEdge_px - 1),
                                  (y_px + plan.phase_px.y) & (RankTile::kEdge_px - 1));
    return rank < kLevelCounts[plan.level[tile.y * plan.tiles_x + tile.x]];
}

}  // namespace macula
