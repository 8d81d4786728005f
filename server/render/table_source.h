#pragma once

// The kernel of mesh tables compiled as C++: what it reads, and the kernel.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "masks/mesh/mesh_table.h"
#include "masks/sample_plan.h"
#include "protocol/gl/kernel_language.h"
#include "server/render/sample_image.h"

namespace macula::kernels {

/// One eye's samples at their pixels, and the table of its mesh.
struct TableSource {
    const MeshTable& table;
    const SampleImage& image;
};

inline uvec2 mesh_pixel(const TableSource& source, int index) {
    const auto words =
        std::bit_cast<std::array<std::uint32_t, 2>>(source.table.pixels()[static_cast<std::size_t>(index)]);
    return {words[0], words[1]};
}
inline uint image_color(const TableSource& source, int index) {
    return source.image.color[static_cast<std::size_t>(index)];
}
inline float image_inverse_depth(const TableSource& source, int index) {
    return source.image.inverse_depth_per_m[static_cast<std::size_t>(index)];
}

}  // namespace macula::kernels

#include "server/kernels/table.h"

namespace macula {

inline kernels::TableView table_view(const SamplePlan& plan) {
    return {.size_px = {plan.width_px, plan.height_px},
            .mesh_origin_px = plan.mesh_origin_px,
            .mesh_width_px = plan.mesh->mesh().width_px,
            .guard_px = guard_px(plan)};
}

}  // namespace macula
