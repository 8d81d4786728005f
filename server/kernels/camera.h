#pragma once

#include "protocol/gl/kernel_language.h"

KERNEL_BEGIN

/// Tangents of an image position; that of a pixel's centre is its column and row + 0.5 (CONVENTIONS.md).
/// `edges` are the frustum's tangents: left, right, bottom, top.
KERNEL vec2 tangents_of_pixel(vec4 edges, vec2 size_px, vec2 position_px) {
    return vec2(edges.x + position_px.x / size_px.x * (edges.y - edges.x),
                edges.w - position_px.y / size_px.y * (edges.w - edges.z));
}

/// World-space direction of the ray through an image position; the columns of `world_from_eye` are the eye's axes.
/// Its length along the eye's -Z axis is 1, so that the distance parameter of a hit is its depth in metres.
KERNEL vec3 eye_ray_direction(mat3 world_from_eye, vec4 edges, vec2 size_px, vec2 position_px) {
    vec2 tangents = tangents_of_pixel(edges, size_px, position_px);
    return world_from_eye * vec3(tangents.x, tangents.y, -1.0F);
}

KERNEL_END
