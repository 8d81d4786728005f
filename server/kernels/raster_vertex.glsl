// The triangles of a mesh, moved to the gaze. A vertex takes the colour and inverse depth of its sample from the image
// that the samples were scattered to.
layout(std430, binding = 0) readonly buffer Vertices { uvec2 vertices[]; };  // int16: place x, y | site x, y
layout(std430, binding = 1) readonly buffer ImageColors { uint image_colors[]; };
layout(std430, binding = 2) readonly buffer ImageInverseDepths { float image_inverse_depths[]; };

struct RasterView {
    ivec2 image_px;     // guard bands included; also the viewport
    ivec2 mask_corner;  // pixel of the mask at the image's top left pixel
};
layout(std430, binding = 3) readonly buffer View { RasterView view; };

layout(location = 0) out vec4 color;
layout(location = 1) out float inverse_depth;

ivec2 signed_halves(uint word) {
    return ivec2(bitfieldExtract(int(word), 0, 16), bitfieldExtract(int(word), 16, 16));
}

void main() {
    uvec2 vertex = vertices[gl_VertexID];
    // Pixel centres: rasterisers snap to 1/256 of a pixel or finer, and so meet them exactly.
    vec2 place = vec2(signed_halves(vertex.x) - view.mask_corner) + 0.5;
    gl_Position = vec4(2.0 * place / vec2(view.image_px) - 1.0, 0.0, 1.0);
    // Triangles that cover no pixel of the window may have corners outside the image.
    ivec2 site = clamp(signed_halves(vertex.y) - view.mask_corner, ivec2(0), view.image_px - 1);
    int pixel = site.y * view.image_px.x + site.x;
    color = unpackUnorm4x8(image_colors[pixel]);
    inverse_depth = image_inverse_depths[pixel];
}
