// What the reconstruction kernel reads, on the GL side. One invocation per pixel and no barriers: each looks its three
// samples up by itself. With a tile's samples gathered in shared memory first, software GL took 88..141 ms an eye where
// this takes 66..74 (1512x1680, Mesa 22.3).
layout(local_size_x = 16, local_size_y = 16) in;

layout(std430, binding = 0) readonly buffer Interpolations { uvec2 interpolations[]; };  // 256 a table
layout(std430, binding = 1) readonly buffer Palettes { uint palettes[]; };               // 256 a table
layout(std430, binding = 2) readonly buffer Tiles { uvec2 tiles[]; };                    // offset; count << 8 | level
layout(std430, binding = 3) readonly buffer Colors { uint sample_colors[]; };
layout(std430, binding = 4) readonly buffer InverseDepths { float sample_inverse_depths[]; };

struct ReconstructSource {
    int unused;
};

int tile_level(ReconstructSource source, int tile) {
    return int(tiles[tile].y & 255U);
}
int tile_count(ReconstructSource source, int tile) {
    return int(tiles[tile].y >> 8);
}
int tile_offset(ReconstructSource source, int tile) {
    return int(tiles[tile].x);
}
uvec2 interpolation(ReconstructSource source, int table, int pixel) {
    return interpolations[256 * table + pixel];
}
uint palette_entry(ReconstructSource source, int table, int index) {
    return palettes[256 * table + index];
}
uint sample_color(ReconstructSource source, int address) {
    return sample_colors[address];
}
float sample_inverse_depth(ReconstructSource source, int address) {
    return sample_inverse_depths[address];
}
