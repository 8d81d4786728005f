#pragma once

#include "protocol/gl/kernel_language.h"
#include "server/kernels/blend.h"

KERNEL_BEGIN

// From samples to pixels by the table of a mesh (masks/mesh/mesh_table.h), which says once and for all which three
// sites each pixel of the mask interpolates. The samples lie at their pixels in an image with a guard band
// (server/render/sample_image.h). No pixel needs to ask whether a sample exists: those of a visible pixel are traced.
//
// The table and the image are read through functions that each side defines before this text for its type TableSource:
//
//   uvec2 mesh_pixel(source, int index)            bytes ax, ay, bx, by | cx, cy, weight_b, weight_c; index in the mask
//   uint image_color(source, int index)            RGBA8
//   float image_inverse_depth(source, int index)   1/m; 0: nothing hit

/// What all pixels of a plan have in common. std430 layout.
struct TableView {
    ivec2 size_px;
    ivec2 mesh_origin_px;  ///< pixel of the mask at the window's top left pixel
    int mesh_width_px;
    int guard_px;  ///< of the image, on each side
};

/// A byte of a word, -128..127; `first_bit` is 0, 8, 16 or 24.
KERNEL int signed_byte(uint word, uint first_bit) {
    return int(word << (24U - first_bit)) >> 24;
}

/// A visible pixel of the window.
KERNEL void table_pixel(KERNEL_IN(TableSource) source, KERNEL_IN(TableView) view, ivec2 pixel, KERNEL_OUT(uint) color,
                        KERNEL_OUT(float) inverse_depth) {
    ivec2 in_mask = view.mesh_origin_px + pixel;
    uvec2 entry = mesh_pixel(source, in_mask.y * view.mesh_width_px + in_mask.x);
    int row = view.size_px.x + 2 * view.guard_px;
    int own = (pixel.y + view.guard_px) * row + pixel.x + view.guard_px;
    int a = own + signed_byte(entry.x, 8U) * row + signed_byte(entry.x, 0U);
    int b = own + signed_byte(entry.x, 24U) * row + signed_byte(entry.x, 16U);
    int c = own + signed_byte(entry.y, 8U) * row + signed_byte(entry.y, 0U);
    uint weight_b = (entry.y >> 16) & 255U;
    uint weight_c = entry.y >> 24;
    color = blend_color(image_color(source, a), image_color(source, b), image_color(source, c),
                        256U - weight_b - weight_c, weight_b, weight_c);
    inverse_depth = blend_inverse_depth(image_inverse_depth(source, a), image_inverse_depth(source, b),
                                        image_inverse_depth(source, c), weight_b, weight_c);
}

KERNEL_END
