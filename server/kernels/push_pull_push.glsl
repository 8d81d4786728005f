// One invocation per pixel of the finer level, which is not the sample image.
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, view.fine_size))) return;
    uvec3 sums;
    float depth_sum;
    float nearest;
    float farthest;
    sum_coarse(at, sums, depth_sum, nearest, farthest);
    int index = view.fine_offset + at.y * view.fine_size.x + at.x;
    uvec4 own = unpack_color(level_colors[index]);
    level_colors[index] =
        pack_color(uvec4(pushed_channel(sums.x, own.x, own.w), pushed_channel(sums.y, own.y, own.w),
                         pushed_channel(sums.z, own.z, own.w), kFullWeight));
    level_inverse_depths[index] =
        pushed_inverse_depth(depth_sum, nearest, farthest, level_inverse_depths[index], own.w);
}
