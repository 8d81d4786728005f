// The picture that a compute program writes (GlPicture, GlHiddenPixels in server/render/gl_picture.h), at the same
// bindings in all programs that include this text.
layout(std430, binding = 5) readonly buffer HiddenPixels { uint hidden_words[]; };  // four pixels each
layout(std430, binding = 6) writeonly buffer PixelColors { uint pixel_colors[]; };
layout(std430, binding = 7) writeonly buffer PixelInverseDepths { float pixel_inverse_depths[]; };

/// `pixel` is y * width + x.
bool hidden_pixel(int pixel) {
    return ((hidden_words[pixel >> 2] >> uint(8 * (pixel & 3))) & 255U) != 0U;
}
void write_pixel(int pixel, uint color, float inverse_depth) {
    pixel_colors[pixel] = color;
    pixel_inverse_depths[pixel] = inverse_depth;
}
