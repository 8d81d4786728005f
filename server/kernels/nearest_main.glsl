// One invocation per pixel of the window.
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(place, view.window_px))) return;
    int pixel = place.y * view.window_px.x + place.x;
    uint color = kOpaqueBlack;
    float inverse_depth = 0.0;
    if (!hidden_pixel(pixel)) {
        NearestSource source = NearestSource(0);
        ivec2 at = place + view.guard_px;
        NearestSamples held = find_nearby(source, at, view.wanted);
        if (held.count == 0) held = find_by_columns(source, view.size_px.x, at, view.wanted);
        blend_nearest(source, held, color, inverse_depth);
    }
    write_pixel(pixel, color, inverse_depth);
}
