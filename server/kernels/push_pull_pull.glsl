// One invocation per pixel of the coarser level.
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, view.coarse_size))) return;
    uvec4 sums = uvec4(0U);
    float depth_sum = 0.0;
    float nearest = kFarthest;
    float farthest = kNearest;
    for (int dx = -1; dx <= 1; ++dx) {
        precise float column_sum = 0.0;
        for (int dy = -1; dy <= 1; ++dy) {
            ivec2 from = 2 * at + ivec2(dx, dy);
            if (any(lessThan(from, ivec2(0))) || any(greaterThanEqual(from, view.fine_size))) continue;
            int index = from.y * view.fine_size.x + from.x;
            uvec4 color;
            float depth;
            if (view.fine_offset < 0) {
                depth = sample_inverse_depths[index];
                uint sampled = sample_colors[index];
                uint scale = depth < 0.0 ? 0U : kChannelScale * kFullWeight;
                color = uvec4((sampled & 255U) * scale, ((sampled >> 8) & 255U) * scale,
                              ((sampled >> 16) & 255U) * scale, depth < 0.0 ? 0U : kFullWeight);
            } else {
                depth = level_inverse_depths[view.fine_offset + index];
                color = unpack_color(level_colors[view.fine_offset + index]);
            }
            if (color.w == 0U) continue;
            uint row_kernel = dy == 0 ? 2U : 1U;
            sums += color * (dx == 0 ? 2U * row_kernel : row_kernel);
            column_sum = column_sum + float(color.w * row_kernel) * depth;
            nearest = max(nearest, depth);
            farthest = min(farthest, depth);
        }
        precise float weighted = dx == 0 ? 2.0 * column_sum : column_sum;
        precise float sum = depth_sum + weighted;
        depth_sum = sum;
    }
    uint weight = pulled_weight(sums.w);
    // The coarsest level is finished: nothing is pushed to it.
    uint multiplier = view.coarse_size == ivec2(1) ? 1U : weight;
    int index = view.coarse_offset + at.y * view.coarse_size.x + at.x;
    level_colors[index] =
        pack_color(uvec4(pulled_channel(sums.x, sums.w) * multiplier, pulled_channel(sums.y, sums.w) * multiplier,
                         pulled_channel(sums.z, sums.w) * multiplier, weight));
    level_inverse_depths[index] =
        sums.w == 0U ? 0.0 : pulled_inverse_depth(depth_sum, sums.w, nearest, farthest);
}
