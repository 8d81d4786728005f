#pragma once

#include "protocol/gl/kernel_language.h"
#include "server/kernels/blend.h"

KERNEL_BEGIN

// From the samples of a grid plan (masks/grid_layout.h) to pixels: bilinear interpolation between the four samples
// around a pixel's centre. Of rectangular grids a pixel shows the finest that is there, and where that one fades, the
// next one beneath it.
//
// What is read goes through functions that each side defines before this text for its type GridSource:
//
//   uint grid_column(source, int grid, int x)            GridPlace, packed, of a pixel column among a grid's
//   uint grid_row(source, int grid, int y)
//   uint sample_color(source, int address)               RGBA8
//   float sample_inverse_depth(source, int address)      1/m; 0: nothing hit; -1: not traced
//
// Weights are integers in 1/65536, and so are colours: both processors come to the same ones. That of a log-polar grid
// depends on where floats put a pixel, to 1/256 of the distance of samples; where the two processors round to different
// sides, colours differ by 1.

const int kGridWeight = 65536;

/// What all pixels of a grid plan have in common. std430 layout.
struct GridView {
    ivec4 offset;   ///< of each rectangular grid: address of its first sample
    ivec4 columns;  ///< and samples in a row
    ivec2 size_px;
    int grids;          ///< rectangular ones; 0: log-polar
    float columns_log;  ///< 1 / log2 of the largest radius in pixels
    ivec2 polar_count;  ///< columns and rows of the log-polar grid
    vec2 polar_phase;
    vec2 centre_px;
    vec2 unused;
};

/// Four samples and their weights, which sum to 65536.
struct GridCell {
    ivec4 address;
    ivec4 weight;
};

/// Weights of the samples before and after a place, in both directions in 1/256.
KERNEL ivec4 bilinear_weights(int x, int y) {
    return ivec4((256 - x) * (256 - y), x * (256 - y), (256 - x) * y, x * y);
}

/// One channel of four colours, weighted and rounded, at its place.
KERNEL uint blend_channel(uvec4 color, ivec4 weight, int shift) {
    int sum = int((color.x >> shift) & 255U) * weight.x + int((color.y >> shift) & 255U) * weight.y +
              int((color.z >> shift) & 255U) * weight.z + int((color.w >> shift) & 255U) * weight.w;
    return (uint(sum + kGridWeight / 2) >> 16) << shift;
}

/// RGBA8 of four opaque colours.
KERNEL uint blend_four_colors(uvec4 color, ivec4 weight) {
    return kOpaqueBlack | blend_channel(color, weight, 0) | blend_channel(color, weight, 8) |
           blend_channel(color, weight, 16);
}

/// Inverse depth of four samples by the rule of blend_inverse_depth(): between surfaces, that of the first of those
/// with the largest weight. Samples without weight repeat one that has some.
KERNEL float blend_four_depths(vec4 depth, ivec4 weight) {
    float own = weight.y > weight.x ? depth.y : depth.x;
    int most = max(weight.x, weight.y);
    own = weight.z > most ? depth.z : own;
    most = max(most, weight.z);
    own = weight.w > most ? depth.w : own;
    float nearest = max(max(depth.x, depth.y), max(depth.z, depth.w));
    float farthest = min(min(depth.x, depth.y), min(depth.z, depth.w));
    KERNEL_PRECISE float sum = float(weight.x) * (depth.x - own) + float(weight.y) * (depth.y - own) +
                               float(weight.z) * (depth.z - own) + float(weight.w) * (depth.w - own);
    KERNEL_PRECISE float blended = own + sum * 1.52587890625e-5F;
    return nearest <= kSurfaceRatio * farthest ? blended : own;
}

/// The one with the largest weight of four samples, the first of several.
KERNEL int heaviest_of(ivec4 weight) {
    int heaviest = 0;
    if (weight.y > weight.x) heaviest = 1;
    if (weight.z > weight[heaviest]) heaviest = 2;
    if (weight.w > weight[heaviest]) heaviest = 3;
    return heaviest;
}

/// Leaves out samples that were not traced: weight 0, the others' weights scaled to sum to 65536, and the depth of one
/// that was. False: none of those with weight was.
KERNEL bool leave_out_untraced(KERNEL_INOUT(vec4) depth, KERNEL_INOUT(ivec4) weight) {
    for (int i = 0; i < 4; ++i)
        if (depth[i] < 0.0F) weight[i] = 0;
    int total = weight.x + weight.y + weight.z + weight.w;
    if (total == 0) return false;
    int heaviest = heaviest_of(weight);
    if (total < kGridWeight) {
        for (int i = 0; i < 4; ++i) weight[i] = int((uint(weight[i]) << 16) / uint(total));
        weight[heaviest] += kGridWeight - (weight.x + weight.y + weight.z + weight.w);
    }
    for (int i = 0; i < 4; ++i)
        if (depth[i] < 0.0F) depth[i] = depth[heaviest];
    return true;
}

/// Colour and inverse depth of a cell. False: nothing of it was traced.
KERNEL bool interpolate_cell(KERNEL_IN(GridSource) source, GridCell cell, KERNEL_OUT(uint) color,
                             KERNEL_OUT(float) inverse_depth) {
    vec4 depth = vec4(sample_inverse_depth(source, cell.address.x), sample_inverse_depth(source, cell.address.y),
                      sample_inverse_depth(source, cell.address.z), sample_inverse_depth(source, cell.address.w));
    color = kOpaqueBlack;
    inverse_depth = 0.0F;
    if (min(min(depth.x, depth.y), min(depth.z, depth.w)) < 0.0F && !leave_out_untraced(depth, cell.weight))
        return false;
    color = blend_four_colors(uvec4(sample_color(source, cell.address.x), sample_color(source, cell.address.y),
                                    sample_color(source, cell.address.z), sample_color(source, cell.address.w)),
                              cell.weight);
    inverse_depth = blend_four_depths(depth, cell.weight);
    return true;
}

/// The samples of a rectangular grid around a pixel; a direction whose weight is all on one sample reads no other.
/// `in_row` is the grid's number of samples in a row.
KERNEL GridCell rectangular_cell(int offset, int in_row, uint column, uint row) {
    int x = int(column & 255U);
    int y = int(row & 255U);
    int first = offset + int(row >> 17) * in_row + int(column >> 17);
    int right = x > 0 ? 1 : 0;
    int below = y > 0 ? in_row : 0;
    GridCell cell;
    cell.address = ivec4(first, first + right, first + below, first + below + right);
    cell.weight = bilinear_weights(x, y);
    return cell;
}

/// A pixel of rectangular grids: each takes the part that the finer ones leave.
KERNEL bool rectangular_pixel(KERNEL_IN(GridSource) source, KERNEL_IN(GridView) view, ivec2 pixel,
                              KERNEL_OUT(uint) color, KERNEL_OUT(float) inverse_depth) {
    color = kOpaqueBlack;
    inverse_depth = 0.0F;
    uvec4 colors = uvec4(0U, 0U, 0U, 0U);
    vec4 depths = vec4(0.0F, 0.0F, 0.0F, 0.0F);
    ivec4 weights = ivec4(0, 0, 0, 0);
    int found = 0;
    int left = kGridWeight;
    for (int grid = 0; grid < view.grids && left > 0; ++grid) {
        uint column = grid_column(source, grid, pixel.x);
        uint row = grid_row(source, grid, pixel.y);
        int shown = int(min((column >> 8) & 511U, (row >> 8) & 511U));
        if (shown == 0) continue;
        if (!interpolate_cell(source, rectangular_cell(view.offset[grid], view.columns[grid], column, row), color,
                              inverse_depth))
            continue;
        weights[found] = left * shown / 256;
        colors[found] = color;
        depths[found] = inverse_depth;
        left -= weights[found];
        found += 1;
    }
    if (found == 0) return false;
    if (found == 1) return true;
    weights[found - 1] += left;
    for (int i = found; i < 4; ++i) depths[i] = depths[0];
    color = blend_four_colors(colors, weights);
    inverse_depth = blend_four_depths(depths, weights);
    return true;
}

/// Binary logarithm of a positive number: exponent, and the series of 2 artanh((m - 1) / (m + 1)) / ln 2 for a mantissa
/// in sqrt(1/2)..sqrt(2), to 4e-8.
KERNEL float series_log2(float x) {
    uint bits = floatBitsToUint(x);
    int exponent = int(bits - 0x3F3504F3U) >> 23;
    float mantissa = uintBitsToFloat(bits - (uint(exponent) << 23));
    float s = (mantissa - 1.0F) / (mantissa + 1.0F);
    float s2 = s * s;
    return float(exponent) + s * (2.885390082F + s2 * (0.961796694F + s2 * (0.577078016F + s2 * 0.412198583F)));
}

/// Angle of a direction in turns, 0..1, from right to below. The series of arctan for angles up to 22.5 degrees, and
/// tan(a - 45 degrees) = (tan a - 1) / (tan a + 1) for those up to 45, to 2e-8 turns.
KERNEL float turns_of(vec2 away) {
    float x = abs(away.x);
    float y = abs(away.y);
    float lesser = min(x, y);
    float larger = max(x, y);
    bool steep = lesser > 0.41421356F * larger;
    float t = (steep ? lesser - larger : lesser) / max(steep ? lesser + larger : larger, 1e-20F);
    float t2 = t * t;
    float series =
        1.0F + t2 * (-0.33333333F +
                     t2 * (0.2F + t2 * (-0.14285714F + t2 * (0.11111111F + t2 * (-0.090909091F + t2 * 0.076923077F)))));
    float turns = (steep ? 0.125F : 0.0F) + 0.15915494F * t * series;
    turns = y > x ? 0.25F - turns : turns;
    turns = away.x < 0.0F ? 0.5F - turns : turns;
    return away.y < 0.0F ? 1.0F - turns : turns;
}

/// Column and row of the log-polar grid at a pixel's centre, in 1/256 of their distance; the row may be any of those
/// that are whole turns apart.
KERNEL ivec2 log_polar_place(KERNEL_IN(GridView) view, vec2 away_px) {
    float square = max(away_px.x * away_px.x + away_px.y * away_px.y, 1.0F);
    float part = 0.5F * series_log2(square) * view.columns_log;
    float column = part * part * part * part * float(view.polar_count.x - 1) - view.polar_phase.x;
    float row = turns_of(away_px) * float(view.polar_count.y) - view.polar_phase.y;
    column = clamp(column, 0.0F, float(view.polar_count.x - 1));
    return ivec2(int(floor(column * 256.0F + 0.5F)), int(floor(row * 256.0F + 0.5F)));
}

/// The samples of the log-polar grid around a place; rows go round.
KERNEL GridCell log_polar_cell(KERNEL_IN(GridView) view, ivec2 place) {
    int x = place.x & 255;
    int y = place.y & 255;
    int row = place.y >> 8;
    row = row < 0 ? row + view.polar_count.y : row;
    row = row >= view.polar_count.y ? row - view.polar_count.y : row;
    int next_row = row + 1 == view.polar_count.y ? 0 : row + 1;
    int first = row * view.polar_count.x + (place.x >> 8);
    int below = y > 0 ? (next_row - row) * view.polar_count.x : 0;
    int right = x > 0 ? 1 : 0;
    GridCell cell;
    cell.address = ivec4(first, first + right, first + below, first + below + right);
    cell.weight = bilinear_weights(x, y);
    return cell;
}

/// One pixel of the window that the lens shows; black at depth 0 if nothing around it was traced.
KERNEL void grid_pixel(KERNEL_IN(GridSource) source, KERNEL_IN(GridView) view, ivec2 pixel, KERNEL_OUT(uint) color,
                       KERNEL_OUT(float) inverse_depth) {
    if (view.grids > 0) {
        if (!rectangular_pixel(source, view, pixel, color, inverse_depth)) {
            color = kOpaqueBlack;
            inverse_depth = 0.0F;
        }
    } else {
        vec2 centre = vec2(float(pixel.x) + 0.5F, float(pixel.y) + 0.5F);
        interpolate_cell(source, log_polar_cell(view, log_polar_place(view, centre - view.centre_px)), color,
                         inverse_depth);
    }
}

KERNEL_END
