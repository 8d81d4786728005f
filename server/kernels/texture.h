#pragma once

#include "protocol/gl/kernel_language.h"

// Texture lookup in two pure steps, so that each side reads its texels in its own way: where the four texels lie,
// and how they mix. What a ray's width means for a texture is in texture_footprint.h.

KERNEL_BEGIN

const int kWrapRepeat = 0;
const int kWrapMirroredRepeat = 1;
const int kWrapClampToEdge = 2;

/// How a material looks up an image.
struct Texture {
    vec4 uv_scale_rotation;  ///< columns of the 2x2 matrix of KHR_texture_transform
    vec2 uv_offset;
    ivec2 size_px;
    ivec2 wrap;   ///< kWrap* for u and v
    int nearest;  ///< 1: the texel that holds the position; 0: bilinear
};

/// Texels around a position: columns x.x and x.y, rows y.x and y.y; `weight` is that of the second column and row.
struct TexelFootprint {
    ivec2 x;
    ivec2 y;
    vec2 weight;
};

/// Coordinate in 0..1 that the sampler's wrap mode reads for any coordinate.
KERNEL float wrap_coordinate(float u, int wrap) {
    float repeated = u - floor(u);
    float folded = abs(u - 2.0F * floor(u * 0.5F + 0.5F));
    float clamped = clamp(u, 0.0F, 1.0F);
    return wrap == kWrapRepeat ? repeated : (wrap == kWrapMirroredRepeat ? folded : clamped);
}

/// Column or row of an index in -1..size: the far side where the image repeats; otherwise the edge, which is also
/// its own mirror image.
KERNEL int wrap_texel(int i, int size, int wrap) {
    int beyond = i < 0 ? size - 1 : (i >= size ? 0 : i);
    return wrap == kWrapRepeat ? beyond : clamp(i, 0, size - 1);
}

/// Coordinates after the texture's transform (KHR_texture_transform).
KERNEL vec2 transform_uv(Texture t, vec2 uv) {
    return vec2(t.uv_scale_rotation.x * uv.x + t.uv_scale_rotation.z * uv.y + t.uv_offset.x,
                t.uv_scale_rotation.y * uv.x + t.uv_scale_rotation.w * uv.y + t.uv_offset.y);
}

/// Transformed coordinates as the wrap modes read them.
KERNEL vec2 wrap_coordinates(vec2 transformed, ivec2 wrap) {
    return vec2(wrap_coordinate(transformed.x, wrap.x), wrap_coordinate(transformed.y, wrap.y));
}

/// Texels of a level of `size_px` around wrapped coordinates; (0, 0) is the top left corner of the image.
KERNEL TexelFootprint level_footprint(ivec2 size_px, ivec2 wrap, bool nearest, vec2 wrapped) {
    float shift = nearest ? 0.0F : 0.5F;
    float px = wrapped.x * float(size_px.x) - shift;
    float py = wrapped.y * float(size_px.y) - shift;
    float left = floor(px);
    float top = floor(py);
    int x = int(left);
    int y = int(top);
    TexelFootprint footprint;
    footprint.weight = nearest ? vec2(0.0F) : vec2(px - left, py - top);
    footprint.x = ivec2(wrap_texel(x, size_px.x, wrap.x), wrap_texel(x + 1, size_px.x, wrap.x));
    footprint.y = ivec2(wrap_texel(y, size_px.y, wrap.y), wrap_texel(y + 1, size_px.y, wrap.y));
    return footprint;
}

/// Texels that the texture itself reads at untransformed coordinates.
KERNEL TexelFootprint texel_footprint(Texture t, vec2 uv) {
    return level_footprint(t.size_px, t.wrap, t.nearest == 1, wrap_coordinates(transform_uv(t, uv), t.wrap));
}

/// Mixes the four texels of a footprint; the first index is the column's.
KERNEL vec4 mix_texels(TexelFootprint f, vec4 t00, vec4 t10, vec4 t01, vec4 t11) {
    return mix(mix(t00, t10, f.weight.x), mix(t01, t11, f.weight.x), f.weight.y);
}

KERNEL_END
