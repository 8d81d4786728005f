// What both programs of the compositor see. Both eyes of a picture lie side by side, those of the history one after the
// other; gl_WorkGroupID.z is the eye.
layout(local_size_x = 16, local_size_y = 8) in;

struct EyeParameters {
    ViewWarp warp;
    ivec4 sampling;  // phase x and y, tiles in a row, first tile of this eye
};
layout(std430, binding = 0) readonly buffer Parameters {
    EyeParameters eyes[2];
    ivec4 size;        // width and height of an eye, edge of the rank tile, whether there is a history
    TaaWeights weights;
    int moves;         // whether Slots, ShownDepth and Warps hold something
    int exact;         // bit of each eye: whether ranks tell which pixels were traced
};
layout(std430, binding = 1) readonly buffer Color { uint color[]; };           // accumulation: new; showing: stable
layout(std430, binding = 2) readonly buffer Depth { float depth[]; };
layout(std430, binding = 3) readonly buffer Hidden { uint hidden[]; };         // four pixels a word, eye after eye
layout(std430, binding = 4) readonly buffer DepthBefore { float depth_before[]; };
layout(std430, binding = 5) readonly buffer History { uvec2 history[]; };
layout(std430, binding = 6) writeonly buffer HistoryOut { uvec2 history_out[]; };
layout(std430, binding = 7) writeonly buffer ColorOut { uint color_out[]; };
layout(std430, binding = 8) readonly buffer Ranks { uint ranks[]; };           // four pixels a word
layout(std430, binding = 9) readonly buffer Counts { uint counts[]; };         // samples of each tile
layout(std430, binding = 10) readonly buffer Slots { uint slots[]; };          // now, before and shown, a byte each
layout(std430, binding = 11) readonly buffer ShownDepth { float shown_depth[]; };
layout(std430, binding = 12) readonly buffer Warps { ViewWarp warps[]; };      // by eye and slot

int eye_x() {
    return int(gl_WorkGroupID.z) * size.x;
}
int color_index(int x, int y) {
    return y * 2 * size.x + eye_x() + x;
}
int depth_index(float x, float y) {
    return eye_x() / kBlock_px + depth_block(x, y, size.x, size.y, 2 * size.x / kBlock_px);
}
int now_slot(int block) {
    return int(slots[block] & 255U);
}
int before_slot(int block) {
    return int((slots[block] >> 8) & 255U);
}
int shown_slot(int block) {
    return int((slots[block] >> 16) & 255U);
}
ViewWarp slot_warp(int slot) {
    return warps[int(gl_WorkGroupID.z) * kSlots + slot];
}
bool is_hidden(int x, int y) {
    int pixel = (int(gl_WorkGroupID.z) * size.y + y) * size.x + x;
    return ((hidden[pixel / 4] >> (8 * (pixel % 4))) & 255U) != 0U;
}
