// One invocation per pixel of the window: its samples, if they are nearby.
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 2) writeonly buffer Unfinished { uint unfinished; };  // not 0: some pixel's are not

void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(place, view.window_px))) return;
    int pixel = place.y * view.window_px.x + place.x;
    uint color = kOpaqueBlack;
    float inverse_depth = 0.0;
    if (!hidden_pixel(pixel)) {
        NearestSource source = NearestSource(0);
        NearestSamples held = find_nearby(source, place + view.guard_px, view.wanted);
        if (held.count == 0) unfinished = 1U;
        blend_nearest(source, held, color, inverse_depth);
    }
    write_pixel(pixel, color, inverse_depth);
}
