#pragma once

#include "server/kernels/texture.h"

// How much of a texture a ray stands for, and how it is read: from the width of the ray's cone where it hits to two
// axes in texture coordinates (anisotropic ray cones: Akenine-Moller et al. 2021, "Improved Shader and Texture Level of
// Detail Using Ray Cones"), and from these to a level of prefiltered texels and a few taps along the longer axis
// (Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", for the ellipse; OpenGL's
// EXT_texture_filter_anisotropic for the taps).

KERNEL_BEGIN

/// Most taps along the longer axis of a footprint; beyond it the level gets coarser instead. On a floor of checks 4 are
/// as good as 8, 2 lose .4 dB and 1 loses 2 (shimmer_bench).
const int kMaxTaps = 4;

/// Least cosine of incidence that a footprint is stretched by.
const float kMinFootprintCosine = 0.01F;

/// What a ray covers, in untransformed texture coordinates: the images of two diameters of the ray's circular cross
/// section that are perpendicular on the surface. Zero: a point, which reads the texture as it is.
struct UvFootprint {
    vec2 across;  ///< of the diameter perpendicular to the plane of incidence
    vec2 along;   ///< of the one in it, stretched by the slant
};

/// How a texture is read under a footprint: the mean of `count` taps at `level`, the first one at
/// `coordinates + first` and each `step` after the one before, in transformed coordinates.
struct TapPlan {
    int count;
    float level;  ///< at least 0, which is the texture itself
    vec2 first;
    vec2 step;
};

/// Footprint on a triangle with the edges `edge1`, `edge2` from its first corner, whose texture coordinates change
/// by `uv_edge1`, `uv_edge2` along them. `width` is the diameter of the ray's cross section at the hit, in the unit of
/// the edges; `direction` is the ray's, unit. A triangle without area has no footprint.
KERNEL UvFootprint uv_footprint(float width, vec3 direction, vec3 edge1, vec3 edge2, vec2 uv_edge1, vec2 uv_edge2) {
    vec3 area = cross(edge1, edge2);
    float area_sq = dot(area, area);
    float inverse_area = area_sq > 1.0e-36F ? 1.0F / sqrt(area_sq) : 0.0F;
    vec3 normal = area * inverse_area;
    float cosine = dot(normal, direction);
    vec3 slide = direction - normal * cosine;
    // Where the ray meets the surface at a right angle, any direction will do.
    slide = dot(slide, slide) > 1.0e-8F ? slide : edge1;
    vec3 along = slide * (width / sqrt(max(dot(slide, slide), 1.0e-36F)));
    vec3 across = cross(normal, along);
    along = along * (1.0F / max(abs(cosine), kMinFootprintCosine));
    // Barycentric coordinates are linear: these are their gradients in the triangle's plane.
    vec3 gradient1 = cross(edge2, normal) * inverse_area;
    vec3 gradient2 = cross(normal, edge1) * inverse_area;
    UvFootprint footprint;
    footprint.across = uv_edge1 * dot(across, gradient1) + uv_edge2 * dot(across, gradient2);
    footprint.along = uv_edge1 * dot(along, gradient1) + uv_edge2 * dot(along, gradient2);
    return footprint;
}

/// Linear part of the texture's transform, in texels; so bounded that its square's square is finite.
KERNEL vec2 texels_of_uv(Texture t, vec2 uv) {
    float x = (t.uv_scale_rotation.x * uv.x + t.uv_scale_rotation.z * uv.y) * float(t.size_px.x);
    float y = (t.uv_scale_rotation.y * uv.x + t.uv_scale_rotation.w * uv.y) * float(t.size_px.y);
    return vec2(clamp(x, -1.0e8F, 1.0e8F), clamp(y, -1.0e8F, 1.0e8F));
}

/// Taps that stand for the ellipse whose image of a circle has the footprint's axes. Its shorter axis decides the
/// level, unless the longer one is more than kMaxTaps times as long. Where the ellipse is smaller than a texel, the
/// texture is magnified: one tap at level 0.
KERNEL TapPlan plan_taps(Texture t, KERNEL_IN(UvFootprint) footprint) {
    vec2 a = texels_of_uv(t, footprint.across);
    vec2 b = texels_of_uv(t, footprint.along);
    // Principal axes of the ellipse: eigenvectors of (a b) (a b)^T, whose eigenvalues are their squares.
    float xx = a.x * a.x + b.x * b.x;
    float xy = a.x * a.y + b.x * b.y;
    float yy = a.y * a.y + b.y * b.y;
    float mean = 0.5F * (xx + yy);
    float skew = 0.5F * (xx - yy);
    float spread = sqrt(skew * skew + xy * xy);
    TapPlan plan;
    plan.count = 1;
    plan.level = 0.0F;
    plan.first = vec2(0.0F);
    plan.step = vec2(0.0F);
    float major_sq = mean + spread;
    if (!(major_sq > 1.0F)) return plan;
    float major = sqrt(major_sq);
    float minor = sqrt(max(mean - spread, 1.0F));
    plan.count = int(min(major / minor + 0.5F, float(kMaxTaps)));
    float tap = major / float(plan.count);
    plan.level = log2(max(tap, minor));
    if (plan.count == 1) return plan;
    vec2 axis = skew > 0.0F ? vec2(skew + spread, xy) : vec2(xy, spread - skew);
    float scale = tap / sqrt(max(dot(axis, axis), 1.0e-30F));
    plan.step = vec2(axis.x * scale / float(t.size_px.x), axis.y * scale / float(t.size_px.y));
    plan.first = plan.step * (-0.5F * float(plan.count - 1));
    return plan;
}

KERNEL_END
