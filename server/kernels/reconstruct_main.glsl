layout(std430, binding = 5) readonly buffer View { ReconstructView view; };
layout(std430, binding = 6) writeonly buffer PixelColors { uint pixel_colors[]; };
layout(std430, binding = 7) writeonly buffer PixelInverseDepths { float pixel_inverse_depths[]; };

// A workgroup is a tile; the dispatch leaves the guard ring out.
void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy) + 1;
    ivec2 pixel = ivec2(gl_LocalInvocationID.xy);
    ivec2 place = view.origin_px + kTileSide * tile + pixel;
    if (place.x < 0 || place.y < 0 || place.x >= view.size_px.x || place.y >= view.size_px.y) return;
    uint color;
    float inverse_depth;
    reconstruct_pixel(ReconstructSource(0), view, tile, pixel, color, inverse_depth);
    int index = place.y * view.size_px.x + place.x;
    pixel_colors[index] = color;
    pixel_inverse_depths[index] = inverse_depth;
}
