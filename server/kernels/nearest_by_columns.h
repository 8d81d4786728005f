#pragma once

#include "server/kernels/nearest_samples.h"

KERNEL_BEGIN

// The samples nearest to a pixel where they are far from it: the search walks from column to column, away from the
// pixel, and in each from sample to sample, away from its row. Every pixel knows how far the next sample of its column
// is, upwards and downwards. Nothing nearer than the worst sample that is held can lie in a column as far away as that,
// nor behind a sample that is farther; so it ends with the exact result, having looked at the samples inside that
// circle and two more in each column.
//
// Beside the functions of nearest_samples.h each side defines
//
//   int above(source, ivec2 pixel)    rows up to the next sample of the column, 0: the pixel has one; kNoSample
//   int below(source, ivec2 pixel)    rows down to the next sample below the pixel, 1 or more; kNoSample

const int kNoSample = 65535;

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

KERNEL_END
