// One invocation per address: puts the sample at its pixel.
void main() {
    int address = int(gl_GlobalInvocationID.x);
    if (address >= view.addresses || sample_inverse_depths[address] < 0.0) return;
    ivec2 place = ivec2(bitfieldExtract(positions[address], 0, 16), bitfieldExtract(positions[address], 16, 16));
    int pixel = (place.y + view.guard_px) * view.size_px.x + place.x + view.guard_px;
    colors[pixel] = sample_colors[address];
    inverse_depths[pixel] = sample_inverse_depths[address];
}
