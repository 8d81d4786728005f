vec4 color_at(int index) {
    return unpack_color(color[index]);
}

/// Where a pixel of what is shown lies in the frame, among objects that move. `still` is its landing if what is seen
/// there is still, `there` the inverse depth that led to it.
Landing find_moved(KERNEL_IN(ViewWarp) still_warp, float px, float py, KERNEL_IN(Landing) still, float there) {
    int slot_there = now_slot(depth_index(still.x, still.y));
    int candidate = shown_slot(depth_index(px, py));
    if (candidate != 0) {
        ViewWarp warp = slot_warp(candidate);
        Landing moved = land(warp, px, py, shown_depth[depth_index(px, py)]);
        float here = inverse_depth_here(warp, px, py, depth[depth_index(moved.x, moved.y)]);
        moved = land(warp, px, py, here);
        bool seen = now_slot(depth_index(moved.x, moved.y)) == candidate;
        if (seen && in_sight(here, slot_there, inverse_depth_here(still_warp, px, py, there))) return moved;
    }
    if (slot_there == 0) return still;
    ViewWarp warp = slot_warp(slot_there);
    return land(warp, px, py, inverse_depth_here(warp, px, py, there));
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
    float there = 0.0;
    for (int i = 0; i < 2; ++i) {
        there = depth[depth_index(landing.x, landing.y)];
        landing = land(eyes[eye].warp, px, py, inverse_depth_here(eyes[eye].warp, px, py, there));
    }
    if (moves != 0) landing = find_moved(eyes[eye].warp, px, py, landing, there);
    Footprint taps = footprint(landing.x, landing.y, size.x, size.y);
    int at = color_index(taps.x, taps.y);
    vec4 seen = bilinear(color_at(at), color_at(at + 1), color_at(at + 2 * size.x), color_at(at + 2 * size.x + 1),
                         taps.right, taps.lower);
    float visible = is_hidden(x, y) ? 0.0 : inside(landing, size.x, size.y);
    color_out[color_index(x, y)] = pack_color(seen * visible);
}
