// One invocation per column of the sample image: down it and up again.
layout(local_size_x = 64) in;

void main() {
    int x = int(gl_GlobalInvocationID.x);
    if (x >= view.size_px.x) return;
    int above_px = kNoSample;
    for (int y = 0; y < view.size_px.y; ++y) {
        int pixel = pixel_index(ivec2(x, y));
        above_px = sample_inverse_depths[pixel] >= 0.0 ? 0 : min(above_px + 1, kNoSample);
        columns[pixel] = uint(above_px);
    }
    int below_px = kNoSample;
    for (int y = view.size_px.y - 1; y >= 0; --y) {
        int pixel = pixel_index(ivec2(x, y));
        columns[pixel] = columns[pixel] | uint(below_px) << 16;
        below_px = sample_inverse_depths[pixel] >= 0.0 ? 1 : min(below_px + 1, kNoSample);
    }
}
