layout(std430, binding = 2) buffer Columns { uint columns[]; };  // 16 bits each: rows up and down to the next sample

int above(NearestSource source, ivec2 pixel) {
    return int(columns[pixel_index(pixel)] & 65535U);
}
int below(NearestSource source, ivec2 pixel) {
    return int(columns[pixel_index(pixel)] >> 16);
}
