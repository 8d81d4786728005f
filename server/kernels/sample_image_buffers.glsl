// What the programs that fill a GlSampleImage read and write.
layout(local_size_x = 256) in;

struct SampleImageView {
    ivec2 size_px;  // guard bands included
    int guard_px;
    int addresses;
};

layout(std430, binding = 0) readonly buffer Positions { int positions[]; };  // int16 x, y
layout(std430, binding = 1) readonly buffer SampleColors { uint sample_colors[]; };
layout(std430, binding = 2) readonly buffer SampleInverseDepths { float sample_inverse_depths[]; };
layout(std430, binding = 3) readonly buffer View { SampleImageView view; };
layout(std430, binding = 4) writeonly buffer Colors { uint colors[]; };
layout(std430, binding = 5) writeonly buffer InverseDepths { float inverse_depths[]; };
