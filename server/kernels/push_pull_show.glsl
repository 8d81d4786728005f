// One invocation per pixel of the window: its sample, or what is pushed to it.
void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(place, view.window_size))) return;
    int pixel = place.y * view.window_size.x + place.x;
    ivec2 at = place + view.guard_px;
    int from = at.y * view.fine_size.x + at.x;
    if (hidden_pixel(pixel)) {
        write_pixel(pixel, kOpaqueBlack, 0.0);
    } else if (sample_inverse_depths[from] >= 0.0) {
        write_pixel(pixel, sample_colors[from], sample_inverse_depths[from]);
    } else {
        uvec3 sums;
        float depth_sum;
        float nearest;
        float farthest;
        sum_coarse(at, sums, depth_sum, nearest, farthest);
        write_pixel(pixel, shown_channel(sums.x) | shown_channel(sums.y) << 8 | shown_channel(sums.z) << 16 | kOpaqueBlack,
                    pushed_inverse_depth(depth_sum, nearest, farthest, 0.0, 0U));
    }
}
