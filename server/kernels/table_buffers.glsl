// What the kernel of mesh tables reads, on the GL side. Bindings 5 to 7 are those of picture_buffers.glsl.
layout(local_size_x = 16, local_size_y = 16) in;

layout(std430, binding = 0) readonly buffer MeshPixels { uvec2 mesh_pixels[]; };
layout(std430, binding = 1) readonly buffer ImageColors { uint image_colors[]; };
layout(std430, binding = 2) readonly buffer ImageInverseDepths { float image_inverse_depths[]; };

struct TableSource {
    int unused;
};

uvec2 mesh_pixel(TableSource source, int index) {
    return mesh_pixels[index];
}
uint image_color(TableSource source, int index) {
    return image_colors[index];
}
float image_inverse_depth(TableSource source, int index) {
    return image_inverse_depths[index];
}
