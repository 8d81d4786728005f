# Tile plans to pictures: the kernel as C++ and on a GL context.
macula_library(macula_reconstruct
    SOURCES reference_reconstructor.cpp cpu_reconstructor.cpp gl_reconstructor.cpp
    LINK macula_masks
    PRIVATE_LINK macula_kernels macula_gl macula_parallel macula_sample_image)
# The reference and the fast path agree to the bit: neither may fuse a product and a sum that the other does not.
set_source_files_properties(reference_reconstructor.cpp cpu_reconstructor.cpp PROPERTIES COMPILE_OPTIONS -ffp-contract=off)
macula_kernel_text(macula_reconstruct
    server/kernels/reconstruct_buffers.glsl server/kernels/picture_buffers.glsl server/kernels/blend.h
    server/kernels/reconstruct.h server/kernels/reconstruct_main.glsl)
