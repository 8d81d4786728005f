// What lies between the corners. Inverse depth is affine in the image over a plane, so that interpolating it in screen
// space is perspective-correct depth. Between surfaces too it is interpolated, as colour is.
layout(location = 0) in vec4 color;
layout(location = 1) in float inverse_depth;
layout(location = 0) out vec4 pixel_color;
layout(location = 1) out float pixel_inverse_depth;

void main() {
    pixel_color = color;
    pixel_inverse_depth = max(inverse_depth, 0.0);  // rounding may fall below nothing hit
}
