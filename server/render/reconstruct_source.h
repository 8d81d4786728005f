#pragma once

// The reconstruction kernel compiled as C++: what it reads, and the kernel.

#include <array>
#include <cstdint>

#include "masks/sample_plan.h"
#include "masks/tile_tables.h"
#include "protocol/gl/kernel_language.h"
#include "server/render/tracer.h"

namespace macula::kernels {

/// One eye's plan with its samples and the tables they are interpolated by.
struct ReconstructSource {
    const SamplePlan& plan;
    const Samples& samples;
    const TileTables& tables;
};

inline int tile_level(const ReconstructSource& source, int tile) {
    return source.plan.level[static_cast<std::size_t>(tile)];
}
inline int tile_count(const ReconstructSource& source, int tile) {
    return kLevelCounts[source.plan.level[static_cast<std::size_t>(tile)]];
}
inline int tile_offset(const ReconstructSource& source, int tile) {
    return static_cast<int>(source.plan.offset[static_cast<std::size_t>(tile)]);
}
inline const CellTable& cell_table(const ReconstructSource& source, int table) {
    return source.tables.cell(table / 16, table % 4, table / 4 % 4);
}
inline uvec2 interpolation(const CellTable& cell, int pixel) {
    const auto p = static_cast<std::size_t>(pixel);
    return {static_cast<uint>(cell.a[p]) | static_cast<uint>(cell.b[p]) << 8 | static_cast<uint>(cell.c[p]) << 16 |
                static_cast<uint>(cell.weight_b[p]) << 24,
            cell.weight_c[p]};
}
inline uvec2 interpolation(const ReconstructSource& source, int table, int pixel) {
    return interpolation(cell_table(source, table), pixel);
}
inline uint palette_entry(const CellTable& cell, int index) {
    const PaletteEntry& entry = cell.palette[static_cast<std::size_t>(index)];
    return static_cast<uint>(entry.neighbour) | static_cast<uint>(entry.rank) << 8 |
           static_cast<uint>(entry.pixel) << 16;
}
inline uint palette_entry(const ReconstructSource& source, int table, int index) {
    return palette_entry(cell_table(source, table), index);
}
inline uint sample_color(const ReconstructSource& source, int address) {
    return source.samples.color[static_cast<std::size_t>(address)];
}
inline float sample_inverse_depth(const ReconstructSource& source, int address) {
    return source.samples.inverse_depth_per_m[static_cast<std::size_t>(address)];
}

}  // namespace macula::kernels

#include "server/kernels/reconstruct.h"

namespace macula {

inline kernels::ReconstructView reconstruct_view(const SamplePlan& plan) {
    const glm::ivec2 first_cell =
        ((plan.origin_px + plan.phase_px + RankTile::kEdge_px) % RankTile::kEdge_px) / kTileEdge_px;
    return {{plan.width_px, plan.height_px}, plan.origin_px, {plan.tiles_x, plan.tiles_y}, first_cell};
}

}  // namespace macula
