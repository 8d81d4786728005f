layout(std430, binding = 4) readonly buffer View { GridView view; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= view.size_px.x || pixel.y >= view.size_px.y) return;
    int index = pixel.y * view.size_px.x + pixel.x;
    uint color = kOpaqueBlack;
    float inverse_depth = 0.0F;
    if (!hidden_pixel(index)) grid_pixel(GridSource(view.size_px), view, pixel, color, inverse_depth);
    write_pixel(index, color, inverse_depth);
}
