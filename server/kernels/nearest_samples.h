#pragma once

#include "server/kernels/blend.h"
#include "server/kernels/small_division.h"

KERNEL_BEGIN

// The samples nearest to a pixel, by Euclidean distance, and the pixel made of them. Of samples at the same distance
// those in the nearer column come first, then the left, then the upper one.
//
// Most pixels find theirs by trying the pixels around them in the order of distance, which ends with the exact result.
// Where the samples are too far for that, see nearest_by_columns.h. At 27 % a pixel without a sample tries 4.6 pixels
// to find one sample and 28 to find four; lists of the samples in bins of 8x8 pixels would mean to measure the
// distances of 104 in the nine bins around it.
//
// The sample image is read through functions that each side defines before this text for its type NearestSource:
//
//   ivec2 nearby(source, int i)       offset of the pixel to be tried next; (0, 0) first
//   bool has_sample(source, ivec2 pixel)
//   uint nearest_color(source, ivec2 pixel)
//   float nearest_inverse_depth(source, ivec2 pixel)

// All pixels within a radius of 16, the guard band of the sample image being wider: at the least density of a mask,
// 1.6 %, 13 samples.
const int kNearbyRadius_px = 16;
const int kNearbyCount = 797;

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

/// Weight of a sample in 1/256 of that of the nearest one: the inverse square of its distance. Squares count as 2^22 at
/// most.
KERNEL uint nearest_weight(int least_sq, int distance_sq) {
    uint least = uint(min(least_sq, 4194304));
    uint square = uint(min(distance_sq, 4194304));
    return (256U * least + square / 2U) / square;
}

/// The same for squares up to 256, of samples nearby.
KERNEL uint nearby_weight(int least_sq, int distance_sq) {
    return divide_small(256U * uint(least_sq) + uint(distance_sq) / 2U, uint(distance_sq));
}

/// Sums over the samples of a pixel, from the second on; the first has weight 256.
struct NearestSums {
    uvec3 color;
    uint weight;
    float inverse_depth;  ///< of differences to the first
    float nearest;
    float farthest;
};

KERNEL NearestSums first_sums(uint color, float inverse_depth) {
    NearestSums sums;
    sums.color = uvec3(color & 255U, (color >> 8) & 255U, (color >> 16) & 255U) * 256U;
    sums.weight = 256U;
    sums.inverse_depth = 0.0F;
    sums.nearest = inverse_depth;
    sums.farthest = inverse_depth;
    return sums;
}

KERNEL void add_sample(KERNEL_INOUT(NearestSums) sums, float first_inverse_depth, uint weight, uint color,
                       float inverse_depth) {
    sums.color = sums.color + uvec3(color & 255U, (color >> 8) & 255U, (color >> 16) & 255U) * weight;
    sums.weight = sums.weight + weight;
    KERNEL_PRECISE float moved = sums.inverse_depth + float(int(weight)) * (inverse_depth - first_inverse_depth);
    sums.inverse_depth = moved;
    sums.nearest = max(sums.nearest, inverse_depth);
    sums.farthest = min(sums.farthest, inverse_depth);
}

KERNEL uint mean_color(KERNEL_IN(NearestSums) sums) {
    uint rounding = sums.weight / 2U;
    return divide_small(sums.color.x + rounding, sums.weight) |
           divide_small(sums.color.y + rounding, sums.weight) << 8 |
           divide_small(sums.color.z + rounding, sums.weight) << 16 | kOpaqueBlack;
}

/// Averaged on one surface only (kSurfaceRatio, blend.h), and else that of the nearest sample.
KERNEL float mean_inverse_depth(KERNEL_IN(NearestSums) sums, float first_inverse_depth) {
    KERNEL_PRECISE float mean = first_inverse_depth + sums.inverse_depth / float(int(sums.weight));
    return sums.nearest <= kSurfaceRatio * sums.farthest ? clamp(mean, sums.farthest, sums.nearest)
                                                         : first_inverse_depth;
}

/// A pixel made of its nearest samples: a sample at the pixel itself is it. No samples: black at depth 0.
KERNEL void blend_nearest(KERNEL_IN(NearestSource) source, KERNEL_IN(NearestSamples) held, KERNEL_OUT(uint) color,
                          KERNEL_OUT(float) inverse_depth) {
    color = kOpaqueBlack;
    inverse_depth = 0.0F;
    if (held.count == 0) return;
    color = nearest_color(source, held.place[0]);
    inverse_depth = nearest_inverse_depth(source, held.place[0]);
    if (held.count == 1 || held.distance_sq[0] == 0) return;

    NearestSums sums = first_sums(color, inverse_depth);
    for (int i = 1; i < held.count; ++i)
        add_sample(sums, inverse_depth, nearest_weight(held.distance_sq[0], held.distance_sq[i]),
                   nearest_color(source, held.place[i]), nearest_inverse_depth(source, held.place[i]));
    color = mean_color(sums);
    inverse_depth = mean_inverse_depth(sums, inverse_depth);
}

KERNEL_END
