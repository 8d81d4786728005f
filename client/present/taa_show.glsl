vec4 color_at(int index) {
    return unpack_color(color[index]);
}

void main() {
    int x = int(gl_GlobalInvocationID.x);
    int y = int(gl_GlobalInvocationID.y);
    int eye = int(gl_WorkGroupID.z);
    if (x >= size.x || y >= size.y) return;

    float px = float(x) + 0.5;
    float py = float(y) + 0.5;
    // Which surface lands here is only known there: look, correct, look again.
    Landing landing = land(eyes[eye].warp, px, py, 0.0);
    for (int i = 0; i < 2; ++i) {
        float there = depth[depth_index(landing.x, landing.y)];
        landing = land(eyes[eye].warp, px, py, inverse_depth_here(eyes[eye].warp, px, py, there));
    }
    Footprint taps = footprint(landing.x, landing.y, size.x, size.y);
    int at = color_index(taps.x, taps.y);
    vec4 seen = bilinear(color_at(at), color_at(at + 1), color_at(at + 2 * size.x), color_at(at + 2 * size.x + 1),
                         taps.right, taps.lower);
    float visible = is_hidden(x, y) ? 0.0 : inside(landing, size.x, size.y);
    color_out[color_index(x, y)] = pack_color(seen * visible);
}
