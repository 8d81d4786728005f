#pragma once

#include "server/kernels/blend.h"
#include "server/kernels/small_division.h"

KERNEL_BEGIN

// The samples nearest to a pixel, by Euclidean distance, and the pixel made of them.
//
// Most pixels find theirs by trying the pixels around them in the order of distance. Where the samples are too far
// for that, the search walks from column to column, away from the pixel, and in each from sample to sample, away from
// its row: every pixel knows how far the next sample of its column is, upwards and downwards. Nothing nearer than the
// worst sample that is held can lie in a column as far away as that, nor behind a sample that is farther; so it ends
// with the exact result too.
//
// Of samples at the same distance those in the nearer column come first, then the left, then the upper one.
//
// The sample image is read through functions that each side defines before this text for its type NearestSource:
//
//   ivec2 nearby(source, int i)       offset of the pixel to be tried next; (0, 0) first
//   bool has_sample(source, ivec2 pixel)
//   int above(source, ivec2 pixel)    rows up to the next sample of the column, 0: the pixel has one; kNoSample
//   int below(source, ivec2 pixel)    rows down to the next sample below the pixel, 1 or more; kNoSample
//   uint nearest_color(source, ivec2 pixel)
//   float nearest_inverse_depth(source, ivec2 pixel)

// All pixels within a radius of 16, the guard band of the sample image being wider: at the least density of a mask,
// 1.6 %, 13 samples.
const int kNearbyRadius_px = 16;
const int kNearbyCount = 797;
const int kNoSample = 65535;

/// Neighbours that a pixel of the reconstruction `nearest` is made of (Fujita and Harada, "Foveated Real-Time Ray
/// Tracing for Virtual Reality Headset", 2014, filter the k nearest). Weights are the inverse squares of the distances
/// (Shepard, "A two-dimensional interpolation function for irregularly-spaced data", 1968). A rendered eye of the Vive
/// at 27 % of its samples comes to 32.5, 32.6, 32.4 dB with three neighbours and the inverse first, second and third
/// power of distance; 32.4, 32.7, 32.5 dB with four; 32.0, 32.6, 32.5 dB with six; 31.5, 32.4, 32.5 dB with eight;
/// cells: 30.3 dB.
const int kMostNeighbours = 4;

/// Sorted, nearest first.
struct NearestSamples {
    int count;
    int distance_sq[4];
    ivec2 place[4];
};

KERNEL bool worth_holding(KERNEL_IN(NearestSamples) held, int wanted, int distance_sq) {
    return held.count < wanted || distance_sq < held.distance_sq[wanted - 1];
}

/// Puts a sample behind those that are as near; drops the farthest where there are enough.
KERNEL void hold(KERNEL_INOUT(NearestSamples) held, int wanted, int distance_sq, ivec2 place) {
    int slot = held.count < wanted ? held.count : wanted - 1;
    held.count = slot + 1;
    while (slot > 0 && held.distance_sq[slot - 1] > distance_sq) {
        held.distance_sq[slot] = held.distance_sq[slot - 1];
        held.place[slot] = held.place[slot - 1];
        slot = slot - 1;
    }
    held.distance_sq[slot] = distance_sq;
    held.place[slot] = place;
}

/// The samples of one column that are near enough, from row `at.y` on upwards and downwards.
KERNEL void hold_column(KERNEL_IN(NearestSource) source, ivec2 at, int column, int wanted,
                        KERNEL_INOUT(NearestSamples) held) {
    int across_sq = (column - at.x) * (column - at.x);
    int step = above(source, ivec2(column, at.y));
    int row = at.y - step;
    bool more = step != kNoSample;
    while (more && worth_holding(held, wanted, across_sq + (at.y - row) * (at.y - row))) {
        hold(held, wanted, across_sq + (at.y - row) * (at.y - row), ivec2(column, row));
        step = row > 0 ? above(source, ivec2(column, row - 1)) : kNoSample;
        more = step != kNoSample;
        row = row - 1 - step;
    }
    step = below(source, ivec2(column, at.y));
    row = at.y + step;
    more = step != kNoSample;
    while (more && worth_holding(held, wanted, across_sq + (row - at.y) * (row - at.y))) {
        hold(held, wanted, across_sq + (row - at.y) * (row - at.y), ivec2(column, row));
        step = below(source, ivec2(column, row));
        more = step != kNoSample;
        row = row + step;
    }
}

/// The `wanted` (1 to kMostNeighbours) nearest samples if they are nearby, the first alone if the pixel has one; count
/// 0: they are not.
KERNEL NearestSamples find_nearby(KERNEL_IN(NearestSource) source, ivec2 at, int wanted) {
    ivec4 tries = ivec4(0, 0, 0, 0);
    int count = 0;
    int enough = has_sample(source, at) ? 1 : wanted;
    for (int i = 0; i < kNearbyCount && count < enough; ++i) {
        if (!has_sample(source, at + nearby(source, i))) continue;
        // Instead of an array, which GL keeps in memory where it is indexed by a variable.
        tries.x = count == 0 ? i : tries.x;
        tries.y = count == 1 ? i : tries.y;
        tries.z = count == 2 ? i : tries.z;
        tries.w = count == 3 ? i : tries.w;
        count = count + 1;
    }
    NearestSamples held;
    held.count = count < enough ? 0 : count;
    for (int s = 0; s < 4; ++s) {
        ivec2 offset = nearby(source, tries[s]);
        held.distance_sq[s] = offset.x * offset.x + offset.y * offset.y;
        held.place[s] = at + offset;
    }
    return held;
}

/// The `wanted` (1 to kMostNeighbours) nearest samples of an image `width` pixels wide; fewer where it has fewer.
KERNEL NearestSamples find_by_columns(KERNEL_IN(NearestSource) source, int width, ivec2 at, int wanted) {
    NearestSamples held;
    held.count = 0;
    int across = 0;
    while (worth_holding(held, wanted, across * across) && (at.x - across >= 0 || at.x + across < width)) {
        if (at.x - across >= 0) hold_column(source, at, at.x - across, wanted, held);
        if (across > 0 && at.x + across < width) hold_column(source, at, at.x + across, wanted, held);
        across = across + 1;
    }
    return held;
}

/// Weight of a sample in 1/256 of that of the nearest one: the inverse square of its distance. Squares count as 2^22 at
/// most.
KERNEL uint nearest_weight(int least_sq, int distance_sq) {
    uint least = uint(min(least_sq, 4194304));
    uint square = uint(min(distance_sq, 4194304));
    return (256U * least + square / 2U) / square;
}

/// A pixel made of its nearest samples: a sample at the pixel itself is it. Inverse depth is averaged on one surface
/// only (kSurfaceRatio, blend.h), and else that of the nearest. No samples: black at depth 0.
KERNEL void blend_nearest(KERNEL_IN(NearestSource) source, KERNEL_IN(NearestSamples) held, KERNEL_OUT(uint) color,
                          KERNEL_OUT(float) inverse_depth) {
    color = kOpaqueBlack;
    inverse_depth = 0.0F;
    if (held.count == 0) return;
    color = nearest_color(source, held.place[0]);
    inverse_depth = nearest_inverse_depth(source, held.place[0]);
    if (held.count == 1 || held.distance_sq[0] == 0) return;

    uvec3 sum = uvec3(color & 255U, (color >> 8) & 255U, (color >> 16) & 255U) * 256U;
    uint total = 256U;
    float own = inverse_depth;
    float near = own;
    float far = own;
    KERNEL_PRECISE float moved = 0.0F;
    for (int i = 1; i < held.count; ++i) {
        uint weight = nearest_weight(held.distance_sq[0], held.distance_sq[i]);
        uint other = nearest_color(source, held.place[i]);
        float depth = nearest_inverse_depth(source, held.place[i]);
        sum = sum + uvec3(other & 255U, (other >> 8) & 255U, (other >> 16) & 255U) * weight;
        total = total + weight;
        near = max(near, depth);
        far = min(far, depth);
        moved = moved + float(int(weight)) * (depth - own);
    }
    uint rounding = total / 2U;
    color = divide_small(sum.x + rounding, total) | divide_small(sum.y + rounding, total) << 8 |
            divide_small(sum.z + rounding, total) << 16 | kOpaqueBlack;
    KERNEL_PRECISE float blended = own + moved / float(int(total));
    if (near <= kSurfaceRatio * far) inverse_depth = clamp(blended, far, near);
}

KERNEL_END
