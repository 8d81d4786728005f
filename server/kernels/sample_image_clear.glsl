// One invocation per pixel: no sample there.
void main() {
    int pixel = int(gl_GlobalInvocationID.x);
    if (pixel < view.size_px.x * view.size_px.y) inverse_depths[pixel] = -1.0;
}
