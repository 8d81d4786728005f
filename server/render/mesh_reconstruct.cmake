# Pictures of mesh plans: by the mesh's table, and by drawing its triangles.
macula_library(macula_mesh_reconstruct
    SOURCES table_reference.cpp table_cpu.cpp table_gl.cpp raster_mesh.cpp raster_cpu.cpp raster_gl.cpp
    LINK macula_mesh_sampler macula_sample_image
    PRIVATE_LINK macula_kernels macula_gl macula_parallel)
# Reference, fast path and GL agree to the bit: none may fuse a product and a sum that the others do not.
set_source_files_properties(table_reference.cpp table_cpu.cpp PROPERTIES COMPILE_OPTIONS -ffp-contract=off)
macula_kernel_text(macula_mesh_reconstruct
    server/kernels/picture_buffers.glsl server/kernels/blend.h
    server/kernels/table_buffers.glsl server/kernels/table.h server/kernels/table_main.glsl
    server/kernels/raster_vertex.glsl server/kernels/raster_fragment.glsl)
