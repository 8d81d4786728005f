layout(std430, binding = 8) readonly buffer View { ReconstructView view; };

// A workgroup is a tile; the dispatch leaves the guard ring out.
void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy) + 1;
    ivec2 pixel = ivec2(gl_LocalInvocationID.xy);
    ivec2 place = view.origin_px + kTileSide * tile + pixel;
    if (place.x < 0 || place.y < 0 || place.x >= view.size_px.x || place.y >= view.size_px.y) return;
    int index = place.y * view.size_px.x + place.x;
    uint color = kOpaqueBlack;
    float inverse_depth = 0.0F;
    if (!hidden_pixel(index)) reconstruct_pixel(ReconstructSource(0), view, tile, pixel, color, inverse_depth);
    write_pixel(index, color, inverse_depth);
}
