#pragma once

// Per-pixel arithmetic of temporal anti-aliasing and late reprojection, in the subset of protocol/gl/KERNELS.md.
// Fetching is left to the two sides: rows of SIMD lanes in C++, invocations in GLSL.

#include "protocol/gl/kernel_language.h"

KERNEL_BEGIN

/// Where pixels of one view lie in another, as homography plus parallax: with x, y the pixel's coordinates and w its
/// inverse depth, the sums h.x x + h.y y + h.z + h.w w of the three rows are X, Y, S; the pixel lies at (X / S, Y / S)
/// and has inverse depth w / S there.
struct ViewWarp {
    vec4 x;
    vec4 y;
    vec4 s;
};

/// Where a pixel lies in another view.
struct Landing {
    float x;
    float y;
    float inverse_depth;
    float px_per_inverse_depth;  ///< how far it would move if it were nearer by 1/m: the larger of both directions
    float in_front;              ///< 1, or 0 if it lies behind that view
};

KERNEL Landing land(KERNEL_IN(ViewWarp) warp, float x, float y, float inverse_depth) {
    Landing landing;
    float s = warp.s.x * x + warp.s.y * y + warp.s.z + warp.s.w * inverse_depth;
    landing.in_front = s > 1e-3F ? 1.0F : 0.0F;
    float reciprocal = 1.0F / max(s, 1e-3F);
    landing.x = (warp.x.x * x + warp.x.y * y + warp.x.z + warp.x.w * inverse_depth) * reciprocal;
    landing.y = (warp.y.x * x + warp.y.y * y + warp.y.z + warp.y.w * inverse_depth) * reciprocal;
    landing.inverse_depth = inverse_depth * reciprocal;
    landing.px_per_inverse_depth = max(abs(warp.x.w - landing.x * warp.s.w), abs(warp.y.w - landing.y * warp.s.w));
    return landing;
}

/// Inverse depth that a pixel must have to land where the other view sees `there`.
KERNEL float inverse_depth_here(KERNEL_IN(ViewWarp) warp, float x, float y, float there) {
    return there * (warp.s.x * x + warp.s.y * y + warp.s.z) / max(1.0F - there * warp.s.w, 0.1F);
}

/// Edge of the blocks of pixels that share a depth.
const int kBlock_px = 4;

/// Index of the block that holds a place; outside the picture, of the nearest one. `stride` is blocks in a row.
KERNEL int depth_block(float x, float y, int width, int height, int stride) {
    int column = int(min(max(x, 0.0F), float(width - 1))) / kBlock_px;
    int row = int(min(max(y, 0.0F), float(height - 1))) / kBlock_px;
    return row * stride + column;
}

/// The four texels around a place and the weights of the right and the lower ones; at the edge the outermost texels
/// are repeated.
struct Footprint {
    int x;
    int y;
    float right;
    float lower;
};

KERNEL Footprint footprint(float x, float y, int width, int height) {
    Footprint taps;
    float tx = min(max(x - 0.5F, 0.0F), float(width - 1));
    float ty = min(max(y - 0.5F, 0.0F), float(height - 1));
    taps.x = min(int(tx), width - 2);
    taps.y = min(int(ty), height - 2);
    taps.right = tx - float(taps.x);
    taps.lower = ty - float(taps.y);
    return taps;
}

/// 1 inside the picture, 0 outside: what came from there was never seen.
KERNEL float inside(KERNEL_IN(Landing) landing, int width, int height) {
    float nearest_edge = min(min(landing.x, float(width) - landing.x), min(landing.y, float(height) - landing.y));
    return nearest_edge >= 0.0F ? landing.in_front : 0.0F;
}

KERNEL vec4 unpack_color(uint rgba) {
    return vec4(float(int(rgba & 255U)), float(int((rgba >> 8) & 255U)), float(int((rgba >> 16) & 255U)), 255.0F);
}

/// Nearest whole number of a value that is not negative.
KERNEL uint rounded(float value) {
    float half_more = value + 0.5F;
    return uint(int(half_more));
}

/// Channels 0..255.
KERNEL uint pack_color(vec4 color) {
    return rounded(color.x) | (rounded(color.y) << 8) | (rounded(color.z) << 16) | 0xFF000000U;
}

KERNEL vec4 bilinear(vec4 upper_left, vec4 upper_right, vec4 lower_left, vec4 lower_right, float right, float lower) {
    vec4 upper = upper_left + (upper_right - upper_left) * right;
    vec4 bottom = lower_left + (lower_right - lower_left) * right;
    return upper + (bottom - upper) * lower;
}

// A texel of the history is a colour, 0..255, and its precision, 0..1, each in 16 bits: with 8, a weight of .02 would
// round most changes to nothing. Two words, as .x and .y of a uvec2: red and green, blue and precision.
const float kColorCode = 257.0F;
const float kPrecisionCode = 65535.0F;

KERNEL vec4 unpack_history(uint red_green, uint blue_precision) {
    return vec4(float(int(red_green & 65535U)) * (1.0F / kColorCode), float(int(red_green >> 16)) * (1.0F / kColorCode),
                float(int(blue_precision & 65535U)) * (1.0F / kColorCode),
                float(int(blue_precision >> 16)) * (1.0F / kPrecisionCode));
}

KERNEL uint pack_red_green(vec4 history) {
    return rounded(history.x * kColorCode) | (rounded(history.y * kColorCode) << 16);
}

KERNEL uint pack_blue_precision(vec4 history) {
    return rounded(history.z * kColorCode) | (rounded(history.w * kPrecisionCode) << 16);
}

/// Colour times precision, and precision.
KERNEL vec4 weighed_history(vec4 history) {
    return vec4(history.x * history.w, history.y * history.w, history.z * history.w, history.w);
}

/// The history between four texels: the mean of their colours, each as much as it is known. What has no precision, as
/// pixels that the lens hides, is black and must not be seen in its neighbours when the head turns.
KERNEL vec4 history_between(vec4 upper_left, vec4 upper_right, vec4 lower_left, vec4 lower_right, float right,
                            float lower) {
    vec4 sum = bilinear(weighed_history(upper_left), weighed_history(upper_right), weighed_history(lower_left),
                        weighed_history(lower_right), right, lower);
    float scale = 1.0F / max(sum.w, 1e-6F);
    return vec4(sum.x * scale, sum.y * scale, sum.z * scale, sum.w);
}

/// How temporal accumulation weighs what it has. Colours are 0..255, precisions 0..1; 1 is that of the best history.
struct TaaWeights {
    float traced;        ///< precision of a pixel that was traced in this frame: with 1 it weighs one half or more
    float interpolated;  ///< precision of a pixel that was interpolated
    float limit;         ///< largest precision of the history; 0 for no history
    float moving_loss;   ///< share of its precision that the history loses when it is resampled half-way
    float disparity_px;  ///< depths whose landings differ by more contradict each other
    int knows_motion;    ///< 0: what moves by itself is accumulated as if it stood still
};

/// Precision of a pixel of the new frame: rank order in its tile, the tile's count of samples (PROTOCOL.md), whether
/// the ranks below the count are those that were traced, and whether the lens hides the pixel. Where it is only known
/// how many were traced, each pixel is worth what they are on average.
KERNEL float new_precision(KERNEL_IN(TaaWeights) weights, int rank, int count, bool exact, bool hidden) {
    float traced_share = float(count) / 256.0F;
    if (exact) traced_share = rank < count ? 1.0F : 0.0F;
    float seen = weights.traced * traced_share + weights.interpolated * (1.0F - traced_share);
    return hidden ? 0.0F : seen;
}

/// How much of the history is to be believed: nothing where the surface that was seen there is another one. Two inverse
/// depths contradict each other only as far as they lead to different places, so nothing is rejected while the
/// eye does not move.
KERNEL float history_trust(KERNEL_IN(TaaWeights) weights, KERNEL_IN(Landing) landing, KERNEL_IN(Footprint) taps,
                           float seen_inverse_depth, int width, int height) {
    float disparity_px = abs(landing.inverse_depth - seen_inverse_depth) * landing.px_per_inverse_depth;
    float trust = disparity_px <= weights.disparity_px ? inside(landing, width, height) : 0.0F;
    // The farther between texels, the more the history is blurred.
    float blur = 4.0F * max(taps.right * (1.0F - taps.right), taps.lower * (1.0F - taps.lower));
    return trust * (1.0F - weights.moving_loss * blur);
}

// Motion of its own. Each block has a *slot*: 0 where what is seen there is still, otherwise the number of a moving
// object in the frame, and the pixels of each slot have a warp of their own. In a block of the frame before, kGoneSlot
// stands for an object that the new frame does not show.
const int kSlots = 256;
const int kGoneSlot = 255;

/// Landings of a moving and of another surface that differ by more are different places. Unlike depths, places of
/// objects have no error that would have to be allowed for.
const float kSamePlace_px = 0.25F;

/// 1 where what was seen at a pixel's landing (x, y) may be the surface that is looked for although its slot, `seen`,
/// is another: by that object's motion the pixel would have come from the same place, `as_seen`. 0 is a contradiction.
KERNEL float same_place(int seen, float x, float y, KERNEL_IN(Landing) as_seen) {
    float difference_px = max(abs(x - as_seen.x), abs(y - as_seen.y));
    return seen != kGoneSlot && difference_px <= kSamePlace_px ? 1.0F : 0.0F;
}

// Late reprojection among moving objects. Which surface is seen at a pixel of what is shown is only known where it
// comes from. The still one is looked for first, then the object that may have come to lie there (`shown`): it is seen
// if its own motion leads back into it and it is not behind what is still. What lay behind an object before it moved on
// was never seen: there, the object's motion leads beyond its edge, and what is seen beside it stands in.

/// Whether an object at inverse depth `here` is seen before what the still landing found in a block of slot `there`.
KERNEL bool in_sight(float here, int there, float still_here) {
    return there != 0 || here >= still_here;
}

/// Mean of what is new and what was known, weighted by precision (the static case of a Kalman filter). Colours do not
/// decide what is known: a surface whose light changes fades to its new colour as its pixels are seen again. A new
/// pixel of precision 0 is one that the lens never shows: it is taken as it is, and not believed later.
KERNEL vec4 accumulate(KERNEL_IN(TaaWeights) weights, vec4 now, vec4 history, float trust) {
    float known = now.w > 0.0F ? history.w * trust : 0.0F;
    float share = now.w > 0.0F ? now.w / (now.w + known) : 1.0F;
    vec4 result = history + (now - history) * share;
    result.w = min(now.w + known, weights.limit);
    return result;
}

KERNEL_END
