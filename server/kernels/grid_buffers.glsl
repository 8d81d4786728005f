// What the grid kernel reads, on the GL side. One invocation per pixel.
layout(local_size_x = 16, local_size_y = 16) in;

layout(std430, binding = 0) readonly buffer Columns { uint grid_columns[]; };  // a window's width for each grid
layout(std430, binding = 1) readonly buffer Rows { uint grid_rows[]; };        // a window's height for each grid
layout(std430, binding = 2) readonly buffer Colors { uint sample_colors[]; };
layout(std430, binding = 3) readonly buffer InverseDepths { float sample_inverse_depths[]; };

struct GridSource {
    ivec2 size_px;
};

uint grid_column(GridSource source, int grid, int x) {
    return grid_columns[grid * source.size_px.x + x];
}
uint grid_row(GridSource source, int grid, int y) {
    return grid_rows[grid * source.size_px.y + y];
}
uint sample_color(GridSource source, int address) {
    return sample_colors[address];
}
float sample_inverse_depth(GridSource source, int address) {
    return sample_inverse_depths[address];
}
