# Bilinear reconstruction of grid plans.
macula_library(macula_grid_reconstruct
    SOURCES grid_cpu_reconstructor.cpp grid_gl_reconstructor.cpp
    LINK macula_masks
    PRIVATE_LINK macula_kernels macula_gl macula_parallel macula_sample_image)
# The GL program does not fuse products and sums where KERNEL_PRECISE asks it not to.
set_source_files_properties(grid_cpu_reconstructor.cpp PROPERTIES COMPILE_OPTIONS -ffp-contract=off)
macula_kernel_text(macula_grid_reconstruct
    server/kernels/blend.h server/kernels/grid.h server/kernels/grid_buffers.glsl server/kernels/grid_main.glsl
    server/kernels/picture_buffers.glsl)
