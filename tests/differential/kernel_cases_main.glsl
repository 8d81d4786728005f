layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Cases { KernelCase cases[]; };
layout(std430, binding = 1) writeonly buffer Results { KernelResult results[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(cases.length())) results[i] = run_case(cases[i]);
}
