// One invocation per pixel of the window: its samples, wherever they are.
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(place, view.window_px))) return;
    int pixel = place.y * view.window_px.x + place.x;
    if (hidden_pixel(pixel)) return;
    NearestSource source = NearestSource(0);
    ivec2 at = place + view.guard_px;
    if (find_nearby(source, at, view.wanted).count > 0) return;
    uint color;
    float inverse_depth;
    blend_nearest(source, find_by_columns(source, view.size_px.x, at, view.wanted), color, inverse_depth);
    write_pixel(pixel, color, inverse_depth);
}
