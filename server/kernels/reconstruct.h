#pragma once

#include "protocol/gl/kernel_language.h"
#include "server/kernels/blend.h"

KERNEL_BEGIN

// From samples to pixels. A pixel interpolates three samples by the table of its tile's level. Where one of them
// does not exist, because the neighbour tile is sparser or the sample was not traced, it takes the next sparser
// level, whose samples the denser ones hold too.
//
// The plan, its samples and tables are read through functions that each side defines before this text for its
// type ReconstructSource (formats: masks/sample_plan.h, masks/tile_tables.h):
//
//   int tile_level(source, int tile)
//   int tile_count(source, int tile)                     samples of that level, 0..256
//   int tile_offset(source, int tile)                    address of the tile's first sample
//   uvec2 interpolation(source, int table, int pixel)    bytes a, b, c, weight_b | weight_c
//   uint palette_entry(source, int table, int index)     bytes neighbour, rank, pixel
//   uint sample_color(source, int address)               RGBA8
//   float sample_inverse_depth(source, int address)      1/m; 0: nothing hit; -1: not traced
//
// `table` is 16 level + 4 cell row + cell column.

const int kTileSide = 16;
const int kFullCount = 256;

/// What all tiles of a plan have in common. std430 layout.
struct ReconstructView {
    ivec2 size_px;
    ivec2 origin_px;   ///< of tile (0, 0)
    ivec2 tiles;       ///< columns and rows, guard ring included
    ivec2 first_cell;  ///< column and row of tile (0, 0)'s cell in the rank tile
};

/// Address of the sample that a palette entry of the tile names; -1: it does not exist or was not traced.
KERNEL int find_sample(KERNEL_IN(ReconstructSource) source, int tiles_x, int tile, uint entry) {
    int neighbour = int(entry & 255U);
    int owner = tile + (neighbour / 3 - 1) * tiles_x + neighbour % 3 - 1;
    int count = tile_count(source, owner);
    int rank = int((entry >> 8) & 255U);
    if (rank >= count) return -1;
    int address = tile_offset(source, owner) + (count == kFullCount ? int(entry >> 16) : rank);
    return sample_inverse_depth(source, address) < 0.0F ? -1 : address;
}

/// Leaves out missing samples (address -1): weight 0, the others' weights scaled to sum to 256 and the largest put
/// first. False: all of the weight is missing.
KERNEL bool leave_out_missing(KERNEL_INOUT(ivec3) address, KERNEL_INOUT(ivec3) weight) {
    if (address.x < 0) weight.x = 0;
    if (address.y < 0) weight.y = 0;
    if (address.z < 0) weight.z = 0;
    int total = weight.x + weight.y + weight.z;
    if (total == 0) return false;
    if (weight.y > weight.x) {
        weight = ivec3(weight.y, weight.x, weight.z);
        address = ivec3(address.y, address.x, address.z);
    }
    if (weight.z > weight.x) {
        weight = ivec3(weight.z, weight.y, weight.x);
        address = ivec3(address.z, address.y, address.x);
    }
    weight.y = (256 * weight.y + total / 2) / total;
    weight.z = (256 * weight.z + total / 2) / total;
    weight.x = 256 - weight.y - weight.z;
    if (address.y < 0) address.y = address.x;
    if (address.z < 0) address.z = address.x;
    return true;
}

/// Address of the tile's traced sample nearest to a pixel, the lowest rank of several; -1: none was traced.
KERNEL int nearest_sample(KERNEL_IN(ReconstructSource) source, int tile, int table, ivec2 pixel) {
    int nearest = -1;
    int shortest = 2 * kTileSide * kTileSide;
    int count = tile_count(source, tile);
    int offset = tile_offset(source, tile);
    for (int rank = 0; rank < count; ++rank) {
        if (sample_inverse_depth(source, offset + rank) < 0.0F) continue;
        // The tile's own samples head the palette of its level.
        int site = int(palette_entry(source, table, rank) >> 16);
        ivec2 away = ivec2(site % kTileSide, site / kTileSide) - pixel;
        int distance = away.x * away.x + away.y * away.y;
        if (distance < shortest) {
            shortest = distance;
            nearest = offset + rank;
        }
    }
    return nearest;
}

/// One pixel of a tile that is not in the guard ring; `pixel` is its place in the tile.
KERNEL void reconstruct_pixel(KERNEL_IN(ReconstructSource) source, KERNEL_IN(ReconstructView) view, ivec2 tile_place,
                              ivec2 pixel, KERNEL_OUT(uint) color, KERNEL_OUT(float) inverse_depth) {
    color = kOpaqueBlack;
    inverse_depth = 0.0F;
    int tile = tile_place.y * view.tiles.x + tile_place.x;
    int count = tile_count(source, tile);
    int pixel_index = pixel.y * kTileSide + pixel.x;
    if (count == 0) return;

    ivec3 address = ivec3(-1, -1, -1);
    ivec3 weight = ivec3(256, 0, 0);
    if (count == kFullCount) {
        int own = tile_offset(source, tile) + pixel_index;
        if (sample_inverse_depth(source, own) < 0.0F) return;
        address = ivec3(own, own, own);
    } else {
        int cell = 4 * ((view.first_cell.y + tile_place.y) % 4) + (view.first_cell.x + tile_place.x) % 4;
        int level = tile_level(source, tile) + 1;
        bool complete = false;
        while (!complete && level > 1) {
            level = level - 1;
            int table = 16 * level + cell;
            uvec2 entry = interpolation(source, table, pixel_index);
            weight.y = int(entry.x >> 24);
            weight.z = int(entry.y);
            weight.x = 256 - weight.y - weight.z;
            address.x = find_sample(source, view.tiles.x, tile, palette_entry(source, table, int(entry.x & 255U)));
            address.y =
                find_sample(source, view.tiles.x, tile, palette_entry(source, table, int((entry.x >> 8) & 255U)));
            address.z =
                find_sample(source, view.tiles.x, tile, palette_entry(source, table, int((entry.x >> 16) & 255U)));
            complete = address.x >= 0 && address.y >= 0 && address.z >= 0;
        }
        if (!complete && !leave_out_missing(address, weight)) {
            int nearest = nearest_sample(source, tile, 16 * tile_level(source, tile) + cell, pixel);
            if (nearest < 0) return;
            address = ivec3(nearest, nearest, nearest);
            weight = ivec3(256, 0, 0);
        }
    }
    color = blend_color(sample_color(source, address.x), sample_color(source, address.y),
                        sample_color(source, address.z), uint(weight.x), uint(weight.y), uint(weight.z));
    inverse_depth =
        blend_inverse_depth(sample_inverse_depth(source, address.x), sample_inverse_depth(source, address.y),
                            sample_inverse_depth(source, address.z), uint(weight.y), uint(weight.z));
}

KERNEL_END
