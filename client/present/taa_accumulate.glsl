vec4 history_at(int index) {
    return unpack_history(history[index].x, history[index].y);
}

void main() {
    int x = int(gl_GlobalInvocationID.x);
    int y = int(gl_GlobalInvocationID.y);
    int eye = int(gl_WorkGroupID.z);
    if (x >= size.x || y >= size.y) return;

    ivec4 sampling = eyes[eye].sampling;
    int tile = sampling.w + (y + sampling.y % 16) / 16 * sampling.z + (x + sampling.x % 16) / 16;
    int count = int(counts[tile]);
    int rank_index = (y + sampling.y) % size.z * size.z + (x + sampling.x) % size.z;
    int rank = int((ranks[rank_index / 4] >> (8 * (rank_index % 4))) & 255U);

    vec4 now = unpack_color(color[color_index(x, y)]);
    now.w = new_precision(weights, rank, count, (exact >> eye & 1) != 0, is_hidden(x, y));

    float px = float(x) + 0.5;
    float py = float(y) + 0.5;
    int slot = 0;
    if (moves != 0) slot = now_slot(depth_index(px, py));
    ViewWarp warp = eyes[eye].warp;
    if (slot != 0) warp = slot_warp(slot);
    float here = depth[depth_index(px, py)];
    Landing landing = land(warp, px, py, here);
    Footprint taps = footprint(landing.x, landing.y, size.x, size.y);
    float trust = float(size.w) * history_trust(weights, landing, taps, depth_before[depth_index(landing.x, landing.y)],
                                                size.x, size.y);
    if (moves != 0) {
        int seen = before_slot(depth_index(landing.x, landing.y));
        if (seen != slot) trust *= same_place(seen, landing.x, landing.y, land(slot_warp(seen), px, py, here));
    }
    int at = (eye * size.y + taps.y) * size.x + taps.x;
    vec4 known = history_between(history_at(at), history_at(at + 1), history_at(at + size.x), history_at(at + size.x + 1),
                          taps.right, taps.lower);
    vec4 result = accumulate(weights, now, known, trust);
    history_out[(eye * size.y + y) * size.x + x] = uvec2(pack_red_green(result), pack_blue_precision(result));
    color_out[color_index(x, y)] = pack_color(result);
}
