#pragma once

#include "server/kernels/blend.h"
#include "server/kernels/small_division.h"

KERNEL_BEGIN

// Push-pull: scattered samples to a picture through a pyramid of weighted averages, after Gortler, Grzeszczuk, Szeliski
// and Cohen, "The Lumigraph" (SIGGRAPH 1996). The pull makes coarser and coarser pictures, each pixel
// the average of those of the finer one under it, weighted by how much they know; weights add up and saturate. The
// push goes back: a pixel keeps as much of itself as it knows, and takes the rest from the coarser picture,
// interpolated.
//
// Pixel i of the coarser level lies over pixel 2i of the finer one. Both ways use the linear B-spline (1/2, 1, 1/2)
// in x and in y, of which Gortler et al. speak: at a weight of one a sample then counts as one coarse pixel. On a
// rendered eye of the Vive at 27 % of its samples it gives 32.1 dB; 2x2 boxes with a bilinear push 31.7 dB, and weights
// that need two or four samples to saturate 30.8 and 21.8 dB.
//
// A level keeps colour in 1/16 of a code value and weight in quarters, 0 to 4, rounded up so that no sample is lost. A
// pixel with a sample has weight 4. Finer weights change nothing: 32.1 dB with quarters, 256ths and floats. Once a
// level has been pushed to, all of its pixels count alike. So everything about colour is small integers.
//
// Inverse depth is averaged with the same weights on one surface only (kSurfaceRatio, blend.h). Between surfaces
// the pull takes the nearer one and the push the farther one: what dilates in the coarser picture is eroded on the way
// back, so that edges stay about where they are. Of the same eye's visible pixels .20 % reproject more than half a
// pixel wrong when the head steps 2 cm aside, as many as with the nearest sample's depth, which is a staircase on every
// slope (mean error .00065 per metre against .00042); .37 % where everything is averaged.

const uint kFullWeight = 4U;
const uint kChannelScale = 16U;

// The colour of a level's pixel is multiplied by its weight after the pull, and the colour itself after the push. The
// coarsest level, of one pixel, needs no push.

/// Weight of a pixel from the sum over the finer ones of kernel (4, 2 or 1) times weight.
KERNEL uint pulled_weight(uint total) {
    return min((total + 3U) / 4U, kFullWeight);
}

/// Channel of a pixel, not multiplied, from the sum over the finer ones of kernel * weight * channel, and that of
/// kernel * weight.
KERNEL uint pulled_channel(uint sum, uint total) {
    uint divisor = max(total, 1U);
    return divide_small(sum + divisor / 2U, divisor);
}

/// Inverse depth of a pixel from the same sum of it, and from the nearest and the farthest of the finer ones.
KERNEL float pulled_inverse_depth(float sum, uint total, float nearest, float farthest) {
    KERNEL_PRECISE float mean = sum / float(int(max(total, 1U)));
    return nearest <= kSurfaceRatio * farthest ? clamp(mean, farthest, nearest) : nearest;
}

/// Channel of a pixel: `sum` is that of four coarse pixels (of which some may be the same), `own` times its weight.
KERNEL uint pushed_channel(uint sum, uint own, uint weight) {
    return (sum * (kFullWeight - weight) + 4U * own + 8U) / 16U;
}

/// The same for inverse depth, whose `own` is not multiplied.
KERNEL float pushed_inverse_depth(float sum, float nearest, float farthest, float own, uint weight) {
    float pushed = nearest <= kSurfaceRatio * farthest ? clamp(sum * 0.25F, farthest, nearest) : farthest;
    float share = float(int(weight)) * 0.25F;
    KERNEL_PRECISE float mixed = pushed + (own - pushed) * share;
    float near = max(pushed, own);
    float far = min(pushed, own);
    float between = near <= kSurfaceRatio * far ? mixed : far;
    return weight == 0U ? pushed : (weight == kFullWeight ? own : between);
}

/// Code value of a channel from the sum of four coarse pixels.
KERNEL uint shown_channel(uint sum) {
    return (sum + 2U * kChannelScale) / (4U * kChannelScale);
}

KERNEL_END
