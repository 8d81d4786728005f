# Samples on any pixels to pictures: push-pull, cells and nearest.
macula_library(macula_scattered_reconstruct
    SOURCES scattered_reconstructors.cpp push_pull_pyramid.cpp push_pull_gl.cpp nearest_columns.cpp nearest_offsets.cpp
            nearest_search.cpp nearest_gl.cpp
    LINK macula_sample_image
    PRIVATE_LINK macula_kernels macula_gl macula_parallel)
# They agree with GL to the bit, where it computes what is `precise` as it is written.
set_source_files_properties(push_pull_pyramid.cpp nearest_search.cpp PROPERTIES COMPILE_OPTIONS -ffp-contract=off)
macula_kernel_text(macula_scattered_reconstruct
    server/kernels/blend.h server/kernels/small_division.h server/kernels/picture_buffers.glsl
    server/kernels/push_pull.h server/kernels/push_pull_buffers.glsl server/kernels/push_pull_pull.glsl
    server/kernels/push_pull_push.glsl server/kernels/push_pull_show.glsl
    server/kernels/nearest_samples.h server/kernels/nearest_buffers.glsl server/kernels/nearest_main.glsl
    server/kernels/nearest_by_columns.h server/kernels/nearest_columns_buffers.glsl
    server/kernels/nearest_columns.glsl server/kernels/nearest_far_main.glsl)
