// What the programs of cells and nearest read. One has an invocation per pixel of the window and expects the samples
// nearby; two others run where that was not so for some pixel.
struct NearestView {
    ivec2 size_px;  // of the sample image, guard bands included
    ivec2 window_px;
    int guard_px;
    int wanted;
};

layout(std430, binding = 0) readonly buffer SampleColors { uint sample_colors[]; };
layout(std430, binding = 1) readonly buffer SampleInverseDepths { float sample_inverse_depths[]; };
layout(std430, binding = 4) readonly buffer Nearby { int nearby_offsets[]; };  // int16 x, y
layout(std430, binding = 3) readonly buffer View { NearestView view; };

struct NearestSource {
    int unused;
};

int pixel_index(ivec2 pixel) {
    return pixel.y * view.size_px.x + pixel.x;
}
ivec2 nearby(NearestSource source, int i) {
    return ivec2(bitfieldExtract(nearby_offsets[i], 0, 16), bitfieldExtract(nearby_offsets[i], 16, 16));
}
bool has_sample(NearestSource source, ivec2 pixel) {
    return sample_inverse_depths[pixel_index(pixel)] >= 0.0;
}
uint nearest_color(NearestSource source, ivec2 pixel) {
    return sample_colors[pixel_index(pixel)];
}
float nearest_inverse_depth(NearestSource source, ivec2 pixel) {
    return sample_inverse_depths[pixel_index(pixel)];
}
