# What reconstructions share: their names, the samples put at their pixels, and a picture in GL memory.
macula_library(macula_sample_image
    SOURCES reconstruction.cpp sample_image.cpp gl_sample_image.cpp gl_picture.cpp
    LINK macula_masks
    PRIVATE_LINK macula_gl macula_parallel)
macula_kernel_text(macula_sample_image
    server/kernels/sample_image_buffers.glsl server/kernels/sample_image_clear.glsl
    server/kernels/sample_image_scatter.glsl)
