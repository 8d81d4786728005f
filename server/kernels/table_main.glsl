layout(std430, binding = 3) readonly buffer View { TableView view; };

// One invocation per pixel.
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= view.size_px.x || pixel.y >= view.size_px.y) return;
    int index = pixel.y * view.size_px.x + pixel.x;
    uint color = kOpaqueBlack;
    float inverse_depth = 0.0;
    if (!hidden_pixel(index)) table_pixel(TableSource(0), view, pixel, color, inverse_depth);
    write_pixel(index, color, inverse_depth);
}
