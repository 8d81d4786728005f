#pragma once

#include "server/kernels/light.h"

// Lights with an extent. `sample_light` with a place `xi` in the unit square gives one point of the light, with the
// irradiance that it brings in the whole light's name: the mean of irradiance * cosine over xi is the light's. A place
// in the square becomes a point of the light by maps that keep areas, so that strata stay strata.

KERNEL_BEGIN

/// A rectangle, or any parallelogram, that shines with the same radiance in all directions of the side that
/// cross(half_u, half_v) points to.
struct RectangleLight {
    vec3 center;
    vec3 half_u;    ///< from the centre to the middle of an edge
    vec3 half_v;    ///< and of its neighbour
    vec3 radiance;  ///< W / (m2 sr), per channel
};

/// Point of the unit disc for a place in the unit square (Shirley and Chiu 1997, "A low distortion map between disk
/// and square"): squares become circles, areas keep their ratios. No angle is over 45 degrees, where the polynomials
/// for sine and cosine are within 4e-7.
KERNEL vec2 disc_from_square(vec2 xi) {
    float a = 2.0F * xi.x - 1.0F;
    float b = 2.0F * xi.y - 1.0F;
    bool wide = abs(a) > abs(b);
    float radius = wide ? a : b;
    float other = wide ? b : a;
    float angle = other / (abs(radius) > 1.0e-9F ? radius : 1.0F) * (0.25F * 3.14159265F);
    float x2 = angle * angle;
    float sine = angle * (1.0F + x2 * (-0.16666655F + x2 * (0.0083321609F - x2 * 0.00019515296F)));
    float cosine = 1.0F + x2 * (-0.5F + x2 * (0.041666638F + x2 * (-0.0013888397F + x2 * 0.000024433157F)));
    return wide ? vec2(radius * cosine, radius * sine) : vec2(radius * sine, radius * cosine);
}

/// One unit vector at right angles to a unit vector (Duff et al. 2017, "Building an orthonormal basis, revisited").
KERNEL vec3 tangent_of(vec3 n) {
    float s = n.z < 0.0F ? -1.0F : 1.0F;
    float a = -1.0F / (s + n.z);
    return vec3(1.0F + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

/// One point of a punctual light with a radius, or of a sun with one. Its rays fill the cone that the sphere subtends
/// evenly by solid angle, so that only what is between the point and the light makes a difference between samples. A
/// sphere of radius R whose radiance makes a radiant intensity I brings I / d^2 to a surface that faces it, as a point
/// light does; range, cone and a radius of 0 are KHR_lights_punctual's. A point within the sphere sees half a sky.
KERNEL LightSample sample_light(KERNEL_IN(Light) light, vec3 point, vec2 xi) {
    LightSample center = sample_light(light, point);
    float distance_sq = max(dot(center.to_light, center.to_light), 1.0e-12F);
    float sine_sq = min(light.radius * light.radius / mix(1.0F, distance_sq, light.position.w), 1.0F);
    vec2 disc = disc_from_square(xi);
    float share = dot(disc, disc);
    // 1 - cos is spread evenly over 0..1 - cos of the whole cone; its small values are kept from cancelling.
    float versine_of_cone = sine_sq / (1.0F + sqrt(1.0F - sine_sq));
    float versine = share * versine_of_cone;
    float cosine = 1.0F - versine;
    // disc * this has the length of the sine, which is sqrt(versine * (2 - versine)).
    float sine_per_disc = sqrt(versine_of_cone * (2.0F - versine));
    vec3 tangent = tangent_of(center.direction);
    vec3 bitangent = cross(center.direction, tangent);
    LightSample result;
    result.direction =
        center.direction * cosine + tangent * (disc.x * sine_per_disc) + bitangent * (disc.y * sine_per_disc);
    // To where the ray meets the sphere: d cos - sqrt(R^2 - d^2 sin^2).
    float distance = sqrt(distance_sq);
    float half_chord = sqrt(max(sine_sq - versine * (2.0F - versine), 0.0F));
    float reach = mix(1.0F, distance * max(cosine - half_chord, 0.0F), light.position.w);
    result.to_light = result.direction * reach;
    float per_point_light = sine_sq > 1.0e-12F ? 2.0F * versine_of_cone / sine_sq : 1.0F;
    result.irradiance = center.irradiance * per_point_light;
    return result;
}

/// One point of a rectangle, by area: irradiance is radiance * area * cosine at the light / distance^2. Near the light
/// samples differ much. The unshadowed irradiance of a square with N samples of `stratified_place` has an error (root
/// mean square over offsets) of, at a distance of
///     half a side:  76 % with N = 1,  18 % with 4,  1.6 % with 64
///     one side:     32 %              7 %           .6 %
///     two sides:    10 %              2.3 %         .15 %
KERNEL LightSample sample_light(KERNEL_IN(RectangleLight) light, vec3 point, vec2 xi) {
    vec3 across = cross(light.half_u, light.half_v) * 4.0F;  // normal times area
    LightSample result;
    result.to_light = light.center + light.half_u * (2.0F * xi.x - 1.0F) + light.half_v * (2.0F * xi.y - 1.0F) - point;
    float distance_sq = max(dot(result.to_light, result.to_light), 1.0e-12F);
    float scale = 1.0F / sqrt(distance_sq);
    result.direction = result.to_light * scale;
    result.irradiance = light.radiance * (max(-dot(across, result.direction), 0.0F) * scale * scale);
    return result;
}

// Few samples make noise, and what the noise does over time is worth more than how much there is of it. Simulated:
// penumbrae 8 to 64 pixels wide of a square light, straight edges at four angles, 4 samples a pixel; the root mean
// square over widths and edges, as a share of the light:
//                                              one frame   3 x 3 pixels   still head   panning   panning, accumulated
//   no offset (bands)                              .098         .068          0          .052        .0034
//   new offset each frame                          .119         .040         .170        .138        .0103
//   offset by pixel, 2 x 2 jittered strata         .161         .028          0          .105        .0127
//   offset by pixel, `light_offset`                .119         .034          0          .075        .0081
//   offset by surface point, the same 4 x 4        .119         .034          0          .079        .0051
// "still" and "panning" are the change of a surface point's light from frame to frame, the surface moving by .37 pixels
// a frame in the latter; "accumulated" takes a tenth of each new frame. Bands are steadiest, but the eye follows them;
// an offset that sticks to the surface needs a grid on it that is as fine as pixels at any distance, and pops when
// the head comes closer. So the offset depends on the pixel alone.

/// Place in the unit square of sample `i` of `side * side`: the sample has its own stratum of the side * side squares
/// and also its own of as many columns and rows (canonical multi-jittered points, Kensler 2013), so that shadow edges
/// at any angle meet evenly spread samples. `offset` moves all samples around the square; the mean over offsets is over
/// the whole square. One sample at offset 0 is the light's centre.
KERNEL vec2 stratified_place(int i, int side, vec2 offset) {
    int row_index = i / side;
    float column = float(i % side);
    float row = float(row_index);
    float scale = 1.0F / float(side);
    vec2 canonical = vec2(column + (row + 0.5F) * scale, row + (column + 0.5F) * scale) * scale;
    return fract(canonical + offset);
}

/// Offset of a pixel's samples, one of 16 that every 4 x 4 pixels hold: the order of Bayer 1973, whose neighbours
/// differ much, along a lattice of 16 points.
KERNEL vec2 light_offset(int column, int row) {
    int both = column ^ row;
    int order = (both & 1) * 8 + (row & 1) * 4 + ((both >> 1) & 1) * 2 + ((row >> 1) & 1);
    return vec2(float(order) + 0.5F, float((7 * order) & 15) + 0.5F) * (1.0F / 16.0F);
}

KERNEL_END
