// What the three programs of push-pull read and write. A program works between two neighbouring levels of the pyramid,
// of which the finest is the sample image. All others lie in one buffer.
layout(local_size_x = 8, local_size_y = 8) in;

struct PushPullView {
    ivec2 fine_size;
    ivec2 coarse_size;
    int fine_offset;  // of the level's first pixel; -1: the sample image
    int coarse_offset;
    int guard_px;
    int unused;
    ivec2 window_size;
};

layout(std430, binding = 0) readonly buffer SampleColors { uint sample_colors[]; };
layout(std430, binding = 1) readonly buffer SampleInverseDepths { float sample_inverse_depths[]; };
layout(std430, binding = 2) buffer LevelColors { uvec2 level_colors[]; };  // 16 bits each: red, green, blue, weight
layout(std430, binding = 3) buffer LevelInverseDepths { float level_inverse_depths[]; };
layout(std430, binding = 4) readonly buffer View { PushPullView view; };

const float kFarthest = 0.0;
const float kNearest = 1.0e30;

uvec4 unpack_color(uvec2 texel) {
    return uvec4(texel.x & 65535U, texel.x >> 16, texel.y & 65535U, texel.y >> 16);
}
uvec2 pack_color(uvec4 color) {
    return uvec2(color.x | color.y << 16, color.z | color.w << 16);
}

// Sums of four pixels of the coarser level, once pushed to, that a pixel of the finer one lies between. Columns first,
// as in C++.
void sum_coarse(ivec2 at, out uvec3 color, out float inverse_depth, out float nearest, out float farthest) {
    ivec2 first = at / 2;
    ivec2 last = min((at + 1) / 2, view.coarse_size - 1);
    int a = view.coarse_offset + first.y * view.coarse_size.x + first.x;
    int b = view.coarse_offset + last.y * view.coarse_size.x + first.x;
    int c = view.coarse_offset + first.y * view.coarse_size.x + last.x;
    int d = view.coarse_offset + last.y * view.coarse_size.x + last.x;
    color = unpack_color(level_colors[a]).xyz + unpack_color(level_colors[b]).xyz +
            unpack_color(level_colors[c]).xyz + unpack_color(level_colors[d]).xyz;
    vec4 depths = vec4(level_inverse_depths[a], level_inverse_depths[b], level_inverse_depths[c],
                       level_inverse_depths[d]);
    precise float left = depths.x + depths.y;
    precise float right = depths.z + depths.w;
    precise float sum = left + right;
    inverse_depth = sum;
    nearest = max(max(depths.x, depths.y), max(depths.z, depths.w));
    farthest = min(min(depths.x, depths.y), min(depths.z, depths.w));
}
